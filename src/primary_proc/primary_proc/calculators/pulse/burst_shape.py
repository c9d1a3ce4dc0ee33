# SPDX-License-Identifier: Apache-2.0
"""Shape of the burst that the rotating antenna gives: two-way amplitude over its pulses."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from radar_common.antenna_pattern import PATTERNS

FloatArray = npt.NDArray[np.float64]

# Where a Gaussian burst is 42 dB below its peak, under the noise of any target that can be measured.
_FARTHEST = 2.2


def pulses_in_burst(pattern: str, beamwidth: float, step: float) -> float:
    """Design number of pulses N_0 (Kuzmin 1967, 1.27) from the beamwidth that a data sheet gives.

    Args:
        pattern: name in `PATTERNS`.
        beamwidth: one-way half-power (3 dB) width, rad.
        step: azimuth step between pulses, rad.

    Returns:
        N_0 = 2 phi / step.
    """
    return beamwidth / PATTERNS[pattern].half_power / step


def burst_shape(
    pattern: str, pulses: float, offset: npt.ArrayLike = 0.0, *, book: bool = True
) -> FloatArray:
    """Two-way amplitude on the positions of a burst.

    Args:
        pattern: name in `PATTERNS`.
        pulses: N_0.
        offset: displacement of the target from the middle position, in steps, any shape.
        book: whether to take the N_0 positions of the book; otherwise an odd number that holds the whole pattern.

    Returns:
        g, shape (*offset.shape, positions).
    """
    beam = PATTERNS[pattern]
    reach = min(beam.extent, _FARTHEST)
    count = round(pulses) if book else 2 * int(np.ceil(reach * pulses / 2.0)) + 1
    steps = np.arange(count) - (count - 1) / 2.0
    return beam((steps - np.asarray(offset)[..., None]) / (pulses / 2.0))
