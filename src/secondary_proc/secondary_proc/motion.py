# SPDX-License-Identifier: Apache-2.0
"""Uniform motion with white random acceleration, for many tracks at once.

State (x, y, vx, vy). Source: Bar-Shalom, Li, Kirubarajan 2001, (6.2.2-4) for the process noise; the prediction is
written with as few calls as possible: for some tracks at once numpy costs by the call, not by the number.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]

_MANOEUVRE_SECONDS = 4.0
_EYE = np.eye(4)
_DRIFT = np.eye(4, k=2)
_NOISE_OF_SPEED = np.diag([0.0, 0.0, 1.0, 1.0])
_NOISE_BETWEEN = (np.eye(4, k=2) + np.eye(4, k=-2)) / 2.0
_NOISE_OF_PLACE = np.diag([1.0, 1.0, 0.0, 0.0]) / 3.0


def _position_terms() -> FloatArray:
    terms = np.zeros((16, 3, 2, 2))
    for i in (0, 1):
        for j in (0, 1):
            terms[4 * i + j, 0, i, j] = 1.0
            terms[4 * i + j + 2, 1, i, j] += 1.0
            terms[4 * (i + 2) + j, 1, i, j] += 1.0
            terms[4 * (i + 2) + j + 2, 2, i, j] = 1.0
    return terms.reshape(16, 12)


POSITION_TERMS = _position_terms().T.copy()
"""Takes covariances, shape (16, n), to the coefficients of time's powers in the predicted position's: four constant
terms (xx, xy, yx, yy), four linear, four quadratic, shape (12, n)."""
_VARIANCE_TERMS = POSITION_TERMS.reshape(3, 4, 16)[:, [0, 3]].sum(axis=1).T


def noise_density(acceleration: float) -> float:
    """White noise that spreads positions as accelerations of some seconds do.

    Args:
        acceleration: standard deviation, m/s^2.

    Returns:
        Power spectral density of the acceleration, m^2/s^3, whatever the antenna's period.
    """
    return acceleration**2 * _MANOEUVRE_SECONDS


def predict_state(state: FloatArray, seconds: FloatArray) -> FloatArray:
    """Move states along their velocity.

    Args:
        state: (x, y, vx, vy), metres and m/s, shape (n, 4).
        seconds: time to move by, shape (n,).

    Returns:
        States, shape (n, 4).
    """
    moved = state.copy()
    moved[:, :2] += seconds[:, None] * state[:, 2:]
    return moved


def predict_covariance(
    covariance: FloatArray, seconds: FloatArray, noise_density: FloatArray | float
) -> FloatArray:
    """Covariance of predicted states.

    Args:
        covariance: of (x, y, vx, vy), shape (n, 4, 4).
        seconds: time to predict over, shape (n,).
        noise_density: power spectral density of the acceleration per axis, m^2/s^3, one for all or shape (n,).

    Returns:
        Covariances, shape (n, 4, 4).
    """
    transition = _EYE + seconds[:, None, None] * _DRIFT
    moved = transition @ covariance @ transition.transpose(0, 2, 1)
    if isinstance(noise_density, np.ndarray):
        noise_density = noise_density[:, None, None]
    moved += noise_density * unit_noise(seconds)
    return moved


def unit_noise(seconds: FloatArray) -> FloatArray:
    """Covariance that white acceleration of unit density adds.

    Args:
        seconds: time that it acts, shape (n,).

    Returns:
        Covariances, shape (n, 4, 4).
    """
    dt = seconds[:, None, None]
    noise = dt * _NOISE_OF_PLACE
    noise += _NOISE_BETWEEN
    noise *= dt
    noise += _NOISE_OF_SPEED
    noise *= np.abs(dt)
    return noise


def predict_position_covariance(
    covariance: FloatArray, seconds: FloatArray, noise_density: FloatArray | float
) -> FloatArray:
    """Only the position's part of `predict_covariance`, which is all that a gate needs.

    Args:
        covariance: of (x, y, vx, vy), shape (n, 4, 4).
        seconds: time to predict over, shape (n,).
        noise_density: power spectral density of the acceleration per axis, m^2/s^3, one for all or shape (n,).

    Returns:
        Covariances of (x, y), shape (n, 2, 2).
    """
    constant, linear, square = (POSITION_TERMS @ covariance.reshape(-1, 16).T).reshape(3, 2, 2, -1)
    moved = constant + seconds * (linear + seconds * square)
    spread = np.abs(seconds) ** 3 * (noise_density / 3.0)
    moved[0, 0] += spread
    moved[1, 1] += spread
    return moved.transpose(2, 0, 1)


def predict_position_variance(
    covariance: FloatArray, seconds: FloatArray, noise_density: float
) -> FloatArray:
    """Trace of `predict_position_covariance`.

    Args:
        covariance: of (x, y, vx, vy), shape (n, 4, 4).
        seconds: time to predict over, shape (n,).
        noise_density: power spectral density of the acceleration per axis, m^2/s^3.

    Returns:
        Variances of x and y together, shape (n,).
    """
    constant, linear, square = (covariance.reshape(-1, 16) @ _VARIANCE_TERMS).T
    cube = np.abs(seconds) * (noise_density / 1.5)
    return constant + seconds * (linear + seconds * (square + cube))


def two_point_state(
    first: FloatArray,
    first_covariance: FloatArray,
    second: FloatArray,
    second_covariance: FloatArray,
    seconds: FloatArray,
    noise_density: FloatArray | float,
) -> tuple[FloatArray, FloatArray]:
    """State at the second of two plots: its position, and the velocity between both.

    Source: Kuzmin 1967, (4.51a)-(4.54a) for n = 2.

    Args:
        first: positions of the earlier plots, metres, shape (n, 2).
        first_covariance: of their errors, shape (n, 2, 2).
        second: positions of the later plots, metres, shape (n, 2).
        second_covariance: of their errors, shape (n, 2, 2).
        seconds: time between them, positive, shape (n,).
        noise_density: power spectral density of the acceleration per axis, m^2/s^3, one for all or shape (n,).

    Returns:
        (state, covariance): shapes (n, 4) and (n, 4, 4).
    """
    dt = seconds[:, None]
    state = np.concatenate([second, (second - first) / dt], axis=1)
    covariance = np.empty((len(first), 4, 4))
    covariance[:, :2, :2] = second_covariance
    covariance[:, :2, 2:] = covariance[:, 2:, :2] = second_covariance / dt[:, :, None]
    covariance[:, 2:, 2:] = (first_covariance + second_covariance) / dt[:, :, None] ** 2
    # The mean velocity between the plots lags behind the present one by the noise of the interval.
    for axis in (2, 3):
        covariance[:, axis, axis] += noise_density * seconds / 3.0
    return state, covariance


def inverse_2x2(matrices: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Inverse and determinant of symmetric positive definite 2 x 2 matrices.

    Args:
        matrices: shape (n, 2, 2).

    Returns:
        (inverse, determinant): shapes (n, 2, 2) and (n,).
    """
    xx, yy, xy = matrices[:, 0, 0], matrices[:, 1, 1], matrices[:, 0, 1]
    determinant = xx * yy - xy**2
    inverse = np.empty_like(matrices)
    inverse[:, 0, 0] = yy / determinant
    inverse[:, 1, 1] = xx / determinant
    inverse[:, 0, 1] = inverse[:, 1, 0] = -xy / determinant
    return inverse, determinant


def quadratic_form(vectors: FloatArray, matrices: FloatArray) -> FloatArray:
    """V' M v of symmetric 2 x 2 matrices.

    Args:
        vectors: shape (n, 2).
        matrices: shape (n, 2, 2).

    Returns:
        Shape (n,).
    """
    x, y = vectors[:, 0], vectors[:, 1]
    return x * x * matrices[:, 0, 0] + 2.0 * x * y * matrices[:, 0, 1] + y * y * matrices[:, 1, 1]


def normalised_square(
    difference: FloatArray, covariance: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Mahalanobis distance in two dimensions.

    Args:
        difference: shape (n, 2).
        covariance: of the difference, shape (n, 2, 2).

    Returns:
        (distance squared, determinant of the covariance), shape (n,).
    """
    x, y = difference.T
    xx, xy, yy = covariance[:, 0, 0], covariance[:, 0, 1], covariance[:, 1, 1]
    determinant = xx * yy - xy * xy
    return (x * (x * yy - 2.0 * y * xy) + y * y * xx) / determinant, determinant


def trace(matrices: FloatArray) -> FloatArray:
    """Trace of 2 x 2 matrices.

    Args:
        matrices: shape (n, 2, 2).

    Returns:
        Shape (n,).
    """
    return matrices[:, 0, 0] + matrices[:, 1, 1]
