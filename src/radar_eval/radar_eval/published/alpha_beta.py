# SPDX-License-Identifier: Apache-2.0
"""Growing alpha-beta coefficients and the least-squares line that they equal (Kuzmin 1967, § 4.4-4.5)."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import numpy.typing as npt

from radar_eval.published.result import Row, to_digits
from radar_eval.published.sequential_gains import sequential_gains
from secondary_proc.calculators.alpha_beta_gains import growing_coefficients
from secondary_proc.motion import predict_covariance, two_point_state
from secondary_proc.smoothing.alpha_beta import AlphaBetaSmoother
from secondary_proc.smoothing.interface import Measured

FloatArray = npt.NDArray[np.float64]

_ALPHA: tuple[float, ...] = (1.0, 0.8333, 0.7, 0.6, 0.5238, 0.4643, 0.4167, 0.3778, 0.3455)
_BETA = (1.0, 0.5, 0.3, 0.2, 0.1429, 0.1071, 0.0833, 0.0667, 0.0545)
_VELOCITY_WEIGHTS: tuple[float, ...] = (-1 / 2, 0.0, 1 / 2)
_SMOOTHED_WEIGHTS = (-1 / 6, 1 / 3, 5 / 6)
_PREDICTED_WEIGHTS = (-2 / 3, 1 / 3, 4 / 3)
_PREDICTED_STD = {2: 2.2361, 3: 1.5275, 4: 1.2247, 5: 1.0488, 6: 0.9309, 8: 0.7792, 10: 0.6831}
_ROUNDING = 1e-9


def alpha_beta() -> Iterator[Row]:
    """Compute coefficients, weights and errors.

    Yields:
        The table of figure 4.10, the weights of n = 3 (figure 4.6) and 6, the error of the prediction (4.65); the
        other sequential filters.
    """
    alpha, beta = growing_coefficients(np.arange(2, 11))
    for name, ours, published in (("alpha", alpha, _ALPHA), ("beta", beta, _BETA)):
        for n, (value, printed) in enumerate(zip(ours, published, strict=True), start=2):
            tolerance = max(to_digits(printed), 5.01e-5)
            yield Row(f"{name}_{n}, figure 4.10", printed, printed, float(value), tolerance)
    smoothed, velocity, _ = _smooth(3)
    for name, ours, published in (
        ("velocity", velocity, _VELOCITY_WEIGHTS),
        ("last point", smoothed, _SMOOTHED_WEIGHTS),
        ("next point", smoothed + velocity, _PREDICTED_WEIGHTS),
    ):
        for i, (value, printed) in enumerate(zip(ours, published, strict=True), start=1):
            label = f"weight of plot {i} of 3 in the {name}, figure 4.6"
            yield Row(label, printed, printed, float(value), _ROUNDING)
    n = 6
    smoothed, velocity, _ = _smooth(n)
    for i in range(1, n + 1):
        printed = (6 * i - 2 * n - 2) / (n * (n + 1))
        label = f"weight of plot {i} of {n} in the last point (4.54a)"
        yield Row(label, printed, printed, float(smoothed[i - 1]), _ROUNDING)
        printed = (12 * i - 6 - 6 * n) / (n * (n**2 - 1))
        label = f"weight of plot {i} of {n} in the velocity (4.52a)"
        yield Row(label, printed, printed, float(velocity[i - 1]), _ROUNDING)
    for n, printed in _PREDICTED_STD.items():
        label = f"error of the next point over that of a plot after {n} plots (4.65)"
        yield Row(label, printed, printed, _smooth(n)[2], to_digits(printed))
    yield from sequential_gains()


def _smooth(n: int) -> tuple[FloatArray, FloatArray, float]:
    """Weights of n unit plots in position and velocity, and the error of the next point, by the tracker's filter."""
    # One track a plot: in track i only plot i is not zero, so its end is the weight of that plot.
    plots = np.eye(n)
    unit = np.broadcast_to(np.eye(2), (n, 2, 2))
    second, turn, quiet = np.ones(n), np.ones(n), np.zeros(n)

    def place(index: int) -> FloatArray:
        return np.stack([plots[:, index], np.zeros(n)], axis=1)

    state, covariance = two_point_state(place(0), unit, place(1), unit, second, quiet)
    smoother = AlphaBetaSmoother(0.0, 0.0)
    memory = np.zeros(n, smoother.memory)
    for index in range(2, n):
        smoothed = smoother.update(
            Measured(
                state=state,
                covariance=covariance,
                memory=memory,
                hits=np.full(n, index + 1),
                seconds=turn,
                position=place(index),
                position_covariance=unit,
                azimuth=np.full(n, np.pi / 2),
            )
        )
        state, covariance, memory = smoothed.state, smoothed.covariance, smoothed.memory
    ahead = predict_covariance(covariance, turn, quiet)
    return state[:, 0], state[:, 2], float(np.sqrt(ahead[0, 0, 0]))
