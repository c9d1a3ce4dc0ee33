# SPDX-License-Identifier: Apache-2.0
"""Two maxima of the signal along azimuth with a valley between them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from primary_proc.estimators.envelopes import Envelopes

FloatArray = npt.NDArray[np.float64]

_SMOOTHING = 0.25
_APART = 0.55
_LEAST = 2.0


@dataclass(frozen=True, slots=True)
class Valleys:
    """Where signals fall between two maxima.

    Attributes:
        deep: whether the signal has such a valley; the rest says nothing where it has not, shape (n,).
        bottom: pulse of the valley, shape (n,).
        before: pulse of the maximum before it, shape (n,).
        after: pulse of the maximum after it, shape (n,).
    """

    deep: npt.NDArray[np.bool_]
    bottom: npt.NDArray[np.int64]
    before: npt.NDArray[np.int64]
    after: npt.NDArray[np.int64]


def signal_valleys(
    envelopes: Envelopes,
    ring: npt.NDArray[np.integer],
    start: npt.NDArray[np.int64],
    end: npt.NDArray[np.int64],
    pulses: float,
    ratio: float,
) -> Valleys:
    """Look for the deepest valley.

    The power is averaged over a quarter of N_0 first, so that noise on a flat top is no valley.

    Args:
        envelopes: the stored signal.
        ring: range cell to look at, shape (n,).
        start: first pulse, shape (n,).
        end: last pulse, shape (n,).
        pulses: N_0.
        ratio: of the weaker maximum's power to that in the valley, at least.

    Returns:
        The valleys.
    """
    middle = (start + end) // 2
    reach = int((end - start).max()) // 2 + 1
    power = envelopes.around(ring, middle, reach) ** 2 / 2.0
    offset = np.arange(-reach, reach + 1)
    inside = np.abs(offset) <= ((end - start + 1) // 2)[:, None]
    width = max(round(_SMOOTHING * pulses), 1)
    summed = np.cumsum(np.pad(np.where(inside, power, 0.0), ((0, 0), (width, 0))), axis=1)
    smooth = (summed[:, width:] - summed[:, :-width]) / width
    left = np.maximum.accumulate(smooth, axis=1)
    right = np.maximum.accumulate(smooth[:, ::-1], axis=1)[:, ::-1]
    lower = np.minimum(left, right)
    depth = np.where(inside, lower / np.maximum(smooth, 1.0), 0.0)
    bottom = depth.argmax(axis=1)
    rows = np.arange(len(ring))
    column = np.arange(smooth.shape[1])
    before = np.where(column <= bottom[:, None], smooth, 0.0).argmax(axis=1)
    after = np.where(column >= bottom[:, None], smooth, 0.0).argmax(axis=1)
    deep = (depth[rows, bottom] >= ratio) & (after - before >= max(_APART * pulses, _LEAST))
    # The sum of `width` pulses up to a column has its middle half as much before it.
    shift = middle - reach - (width - 1) // 2
    return Valleys(deep, bottom + shift, before + shift, after + shift)
