# SPDX-License-Identifier: Apache-2.0
"""Angles as deviations from one reference direction per target, so that linear algebra may be done with them.

Hypotheses of one target lie near each other; on the tangent of the circle at a direction among them a mean is a mean,
also across north.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from bearing_tracker.fusion.belief import Belief
from radar_common.frames import wrap_pi

FloatArray = npt.NDArray[np.float64]
BoolArray = npt.NDArray[np.bool_]


def wrapped(values: FloatArray, angles: BoolArray) -> FloatArray:
    """Bring angles to [-pi, pi) and leave everything else.

    Args:
        values: shape (..., k).
        angles: which components are angles, shape (k,).

    Returns:
        Shape as values.
    """
    if not angles.any():
        return values
    if angles.all():
        return wrap_pi(values)
    result = values.copy(order="K")
    result[..., angles] = wrap_pi(values[..., angles])
    return result


def best(belief: Belief) -> npt.NDArray[np.intp]:
    """Find the most probable hypothesis.

    Args:
        belief: in n targets.

    Returns:
        Its number, shape (n,).
    """
    return belief.log_probability.argmax(axis=1)


def directions(belief: Belief, angles: BoolArray) -> FloatArray:
    """Directions among the hypotheses: those of the most probable one.

    Args:
        belief: in n targets.
        angles: which components of the state are angles, shape (nx,).

    Returns:
        Radians where the state is an angle, else zero, shape (n, nx).
    """
    return np.where(angles, belief.mean[np.arange(len(belief)), best(belief)], 0.0)
