# SPDX-License-Identifier: Apache-2.0
"""The model (26) of Detkov 2022: a line of sight that swings about an axis while the target comes nearer.

(26) prints Phi_21 = -mu sin(mu T) and Gamma_22 = sqrt(mu^2 - alpha^2): one half of the matrices takes mu for the
frequency of the damped swing, the other half for that of the undamped one. Here mu is the damped frequency throughout:
Phi_21 = -(mu^2 + alpha^2) / mu sin(mu T), Gamma_22 = mu. The process is then stationary with the covariance
D [[1, -alpha], [-alpha, alpha^2 + mu^2]] and the autocorrelation D exp(-alpha |t|) cos(mu t), exactly.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from bearing_tracker.fusion.interface import Motion

FloatArray = npt.NDArray[np.float64]


def guidance_motion(
    seconds: npt.ArrayLike,
    frequency: npt.ArrayLike,
    decay: npt.ArrayLike,
    deviation: npt.ArrayLike,
    axis: npt.ArrayLike | None = None,
) -> Motion:
    """Move (angle, rate) on. Each argument is one number or one per target.

    Args:
        seconds: length of the step.
        frequency: mu, rad/s, of the swing.
        decay: alpha, 1/s; see decay_of_approach.
        deviation: sqrt(D), radians, rms angle from the axis.
        axis: azimuth about which the line of sight swings, radians; None where angles are plain numbers.

    Returns:
        The motion of a state of shape (n, 2).

    Raises:
        ValueError: a frequency is not positive, or a time, a decay or a deviation is negative.
    """
    step, mu, alpha, sigma = np.broadcast_arrays(
        *(np.asarray(v, dtype=np.float64) for v in (seconds, frequency, decay, deviation))
    )
    if not (mu > 0.0).all() or any(not (v >= 0.0).all() for v in (step, alpha, sigma)):
        raise ValueError("the frequency must be positive; time, decay and deviation not negative")
    cosine, sine = np.cos(mu * step), np.sin(mu * step)
    transition = np.exp(-alpha * step)[..., None, None] * _square(
        cosine + alpha / mu * sine,
        sine / mu,
        -(mu**2 + alpha**2) / mu * sine,
        cosine - alpha / mu * sine,
    )
    grown = -np.expm1(-2.0 * alpha * step)
    noise = grown[..., None, None] * guidance_covariance(mu, alpha, sigma)
    if axis is None:
        return Motion(transition, noise)
    direction = np.asarray(axis, dtype=np.float64)
    return Motion(transition, noise, np.stack([direction, np.zeros_like(direction)], axis=-1))


def guidance_covariance(
    frequency: npt.ArrayLike, decay: npt.ArrayLike, deviation: npt.ArrayLike
) -> FloatArray:
    """Covariance of (angle, rate) that the motion keeps, for the start of a filter.

    Args:
        frequency: mu, rad/s.
        decay: alpha, 1/s.
        deviation: sqrt(D), radians.

    Returns:
        D [[1, -alpha], [-alpha, alpha^2 + mu^2]], shape (..., 2, 2).
    """
    mu, alpha, sigma = np.broadcast_arrays(
        *(np.asarray(v, dtype=np.float64) for v in (frequency, decay, deviation))
    )
    return (sigma**2)[..., None, None] * _square(
        np.ones_like(alpha), -alpha, -alpha, alpha**2 + mu**2
    )


def decay_of_approach(
    distance: npt.ArrayLike, closing_speed: npt.ArrayLike, unknown: float
) -> FloatArray:
    """The decay alpha = 2 V / D where range and closing speed are known.

    The paper calls 1 / alpha the time to go but defines it as D / (2 V), half of it; the definition is followed.

    Args:
        distance: D, metres; NaN where not known.
        closing_speed: V, m/s, positive towards the sensor; NaN where not known.
        unknown: alpha, 1/s, where one of them is not known or the target does not come nearer.

    Returns:
        alpha, 1/s, of the common shape.
    """
    metres, speed = np.broadcast_arrays(
        np.asarray(distance, dtype=np.float64), np.asarray(closing_speed, dtype=np.float64)
    )
    known = (metres > 0.0) & (speed > 0.0)
    safe = np.where(known, metres, 1.0)
    return np.where(known, 2.0 * np.where(known, speed, 0.0) / safe, unknown)


def _square(a: FloatArray, b: FloatArray, c: FloatArray, d: FloatArray) -> FloatArray:
    return np.stack([np.stack([a, b], axis=-1), np.stack([c, d], axis=-1)], axis=-2)
