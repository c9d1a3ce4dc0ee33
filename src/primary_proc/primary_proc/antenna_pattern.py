# SPDX-License-Identifier: Apache-2.0
"""Shape of the burst that the rotating antenna gives: two-way amplitude pattern over the pulses of a burst.

The angle is normalised to the pattern's half width phi, so that the design number of pulses is N_0 = 2 phi / step
(Kuzmin 1967, (1.27)). For sinc2 phi is the first null, for the Gaussian the 1/e point of the one-way power.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]


def sinc2(angle: npt.ArrayLike) -> FloatArray:
    """Pattern of a uniformly lit aperture, main lobe only.

    Args:
        angle: alpha = azimuth from the beam's axis over phi, any shape.

    Returns:
        Two-way amplitude, 1 on the axis, same shape.
    """
    return np.where(np.abs(angle) < 1.0, np.square(np.sinc(np.asarray(angle))), 0.0)


def gaussian(angle: npt.ArrayLike) -> FloatArray:
    """Gaussian pattern (3.28).

    Args:
        angle: alpha = azimuth from the beam's axis over phi, any shape.

    Returns:
        Two-way amplitude, 1 on the axis, same shape.
    """
    return np.exp(-np.square(angle))


PATTERNS: dict[str, Callable[[npt.ArrayLike], FloatArray]] = {"sinc2": sinc2, "gaussian": gaussian}

# phi over the one-way half-power beamwidth: where the one-way power, which is g, falls to one half.
_HALF_WIDTH = {"sinc2": 1.0 / (2.0 * 0.44294647), "gaussian": 1.0 / (2.0 * np.sqrt(np.log(2.0)))}
_GAUSSIAN_REACH = 2.2


def pulses_in_burst(pattern: str, beamwidth: float, step: float) -> float:
    """Design number of pulses N_0 (1.27) from the beamwidth that a data sheet gives.

    Args:
        pattern: name in `PATTERNS`.
        beamwidth: one-way half-power (3 dB) width, rad.
        step: azimuth step between pulses, rad.

    Returns:
        N_0 = 2 phi / step.
    """
    return 2.0 * _HALF_WIDTH[pattern] * beamwidth / step


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
    reach = 1.0 if book or pattern != "gaussian" else _GAUSSIAN_REACH
    count = round(pulses) if book else 2 * int(np.ceil(reach * pulses / 2.0)) + 1
    steps = np.arange(count) - (count - 1) / 2.0
    return PATTERNS[pattern]((steps - np.asarray(offset)[..., None]) / (pulses / 2.0))
