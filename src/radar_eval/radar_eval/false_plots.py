# SPDX-License-Identifier: Apache-2.0
"""False plots to add to a recording, as a receiver's noise would: anywhere, at any time."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from radar_eval.antenna import Rotation
from radar_eval.errors import EvaluationError

FloatArray = npt.NDArray[np.float64]


def draw_false_plots(
    rotation: Rotation,
    start: float,
    stop: float,
    *,
    per_scan: float,
    nearest: float,
    farthest: float,
    generator: np.random.Generator,
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Draw false plots uniform in range and azimuth, their number Poisson in each scan.

    The times are a Poisson process; the azimuth is where the antenna looks at that time. So the plots are uniform in
    azimuth and none is seen at a time at which the antenna looked elsewhere.

    Args:
        rotation: of the antenna.
        start: seconds since the epoch.
        stop: seconds since the epoch.
        per_scan: mean number a turn.
        nearest: metres.
        farthest: metres.
        generator: source of randomness.

    Returns:
        (time, range, azimuth): seconds since the epoch in rising order, metres, radians, each shape (n,).

    Raises:
        EvaluationError: the number is negative, or the ranges do not rise.
    """
    if per_scan < 0.0:
        raise EvaluationError(f"the number of false plots cannot be negative, got {per_scan:g}")
    if not 0.0 <= nearest < farthest:
        raise EvaluationError(f"false plots need rising ranges, got {nearest:g} to {farthest:g} m")
    number = generator.poisson(per_scan * (stop - start) / rotation.period)
    time = np.sort(generator.uniform(start, stop, number))
    return time, generator.uniform(nearest, farthest, number), rotation.azimuth(time)
