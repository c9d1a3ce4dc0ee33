# SPDX-License-Identifier: Apache-2.0
"""The stored signal around bursts, cut where it would depend on how the stream was cut into messages."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from primary_proc.estimators.envelopes import Envelopes

FloatArray = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Windows:
    """Signal around the middle of bursts.

    Attributes:
        envelope: in units of the noise's sigma, shape (n, 2 reach + 1).
        known: where it was seen; elsewhere it counts as noise, same shape.
        centre: number of the pulse in the middle, shape (n,).
        middle: middle of the burst, less the detector's lag, after that pulse, shape (n,).
    """

    envelope: FloatArray
    known: npt.NDArray[np.bool_]
    centre: npt.NDArray[np.int64]
    middle: FloatArray


def burst_windows(
    bursts: npt.NDArray[np.void], envelopes: Envelopes, reach: int, lag: float, margin: int
) -> Windows:
    """Look at the signal around bursts again.

    Plots leave as soon as the merging gap after the burst's end has passed, so later pulses are not looked at even
    where they happen to be there; earlier ones are not either, to keep the window symmetric.

    Args:
        bursts: dtype BURST, shape (n,).
        envelopes: the stored signal.
        reach: pulses to either side of the middle.
        lag: of the middle between start and end behind the target, in pulses.
        margin: pulses after the end that are there for certain.

    Returns:
        The windows.
    """
    middle = (bursts["start"] + bursts["end"]) / 2.0 - lag
    centre = np.rint(middle).astype(np.int64)
    envelope = envelopes.around(bursts["ring"], centre, reach)
    pulse = centre[:, None] + np.arange(-reach, reach + 1)
    half = (bursts["end"] + margin - middle)[:, None]
    known = (np.abs(pulse - middle[:, None]) <= half) & (envelope > 0.0)
    return Windows(envelope, known, centre, middle - centre)
