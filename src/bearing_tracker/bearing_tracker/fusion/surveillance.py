# SPDX-License-Identifier: Apache-2.0
"""A plain model of the azimuth of surveillance targets: nearly constant rate, the less so the nearer they are."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from bearing_tracker.fusion.interface import Motion

_FLYBY = 3.0 * np.sqrt(3.0) / 8.0
"""Largest |d^2 azimuth / dt^2| of a straight flight past the sensor, in (speed / distance)^2."""


def surveillance_motion(
    seconds: npt.ArrayLike,
    distance: npt.ArrayLike,
    acceleration: float,
    correlation: float,
    speed: npt.ArrayLike = 0.0,
) -> Motion:
    """Move (azimuth, rate) on. Steps of any length fit together: two of 1 s are one of 2 s.

    The azimuth's acceleration is white noise with the strength of a lateral acceleration that lasts for a while, over
    the distance (Y. Bar-Shalom, X. R. Li, T. Kirubarajan, Estimation with Applications to Tracking and Navigation,
    2001, § 6.2.2). A target that flies straight also bends in azimuth, by up to 0.65 (speed / distance)^2.

    Args:
        seconds: length of the step, a number or shape (n,).
        distance: metres, a number or shape (n,); a guess where it is not known.
        acceleration: rms lateral acceleration, m/s^2.
        correlation: seconds that it lasts.
        speed: m/s, a number or shape (n,), of straight flights that the model is to follow.

    Returns:
        The motion of a state of shape (n, 2).

    Raises:
        ValueError: a distance is not positive, or a time, an acceleration or a speed is negative.
    """
    step, metres, fast = np.broadcast_arrays(
        *(np.asarray(v, dtype=np.float64) for v in (seconds, distance, speed))
    )
    if not (metres > 0.0).all() or not ((step >= 0.0) & (fast >= 0.0)).all():
        raise ValueError("distances must be positive, times and speeds not negative")
    if not (acceleration >= 0.0 and correlation >= 0.0):
        raise ValueError("the acceleration and how long it lasts must not be negative")
    bend = _FLYBY * (fast / metres) ** 2
    density = ((acceleration / metres) ** 2 + bend**2) * correlation
    transition, noise = np.zeros((2, *step.shape, 2, 2))
    transition[..., 0, 0] = transition[..., 1, 1] = 1.0
    transition[..., 0, 1] = step
    noise[..., 0, 0] = density * step**3 / 3.0
    noise[..., 0, 1] = noise[..., 1, 0] = density * step**2 / 2.0
    noise[..., 1, 1] = density * step
    return Motion(transition, noise)
