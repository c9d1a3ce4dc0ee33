# SPDX-License-Identifier: Apache-2.0
"""Optimal estimates from a fixed number of plots and their errors (Kuzmin 1967, § 4.4, figures 4.6, 4.8, 4.9)."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import numpy.typing as npt

from radar_eval.published.result import Row, to_digits
from secondary_proc.calculators import line_estimator as line
from secondary_proc.calculators import parabola_estimator as parabola
from secondary_proc.calculators.manoeuvre_detector import false_manoeuvre_probability
from secondary_proc.calculators.polynomial_estimator import estimate_variance, polynomial_weights
from secondary_proc.calculators.velocity_observations import (
    aided_position_variance,
    aided_position_weights,
    aided_velocity_variance,
    aided_velocity_weights,
)

FloatArray = npt.NDArray[np.float64]

_EXACT = 1e-9
_MOST = 11
# n: rms of velocity, last point, next point.
_LINE = {
    2: (1.4142, 1.0, 2.2361),
    3: (0.7071, 0.9129, 1.5275),
    4: (0.4472, 0.8367, 1.2247),
    5: (0.3162, 0.7746, 1.0488),
    6: (0.2390, 0.7237, 0.9309),
    8: (0.1543, 0.6455, 0.7792),
    10: (0.1101, 0.5878, 0.6831),
}
# n: variance of velocity, acceleration, last point, next point.
_PARABOLA = {
    3: (6.5, 6.0, 1.0, 19.0),
    4: (2.45, 1.0, 0.95, 7.75),
    5: (1.2429, 0.2857, 0.8857, 4.6),
    6: (0.7268, 0.1071, 0.8214, 3.2),
    8: (0.3155, 0.0238, 0.7083, 1.9464),
    10: (0.1655, 0.0076, 0.6182, 1.3833),
}
# n, c = 1: variance of last point, velocity, next point.
_AIDED = {
    2: (0.6, 0.4, 1.4),
    3: (0.5333, 0.2, 1.1333),
    4: (0.5, 0.1111, 0.9444),
    5: (0.4667, 0.0667, 0.8),
    6: (0.4326, 0.0426, 0.6879),
}
_FALLS = {2: (0.40, 5.0), 3: (0.36, 2.5), 4: (0.286, 1.8)}


def polynomial_estimation() -> Iterator[Row]:
    """Compute weights and errors.

    Yields:
        The weights by the likelihood equations against each closed form; errors of lines, parabolas and lines with
        observed velocity; the manoeuvre detector's factor and confidence.
    """
    yield from _special_cases()
    yield from _weights()
    yield from _errors()
    yield from _manoeuvres()
    yield from _aided_weights()
    yield from _aided_errors()


def _special_cases() -> Iterator[Row]:
    cases = {
        "velocity of 2 plots": (2, 1, 1.0, 1, (-1, 1)),
        "last point of 2 plots": (2, 1, 1.0, 0, (0, 1)),
        "next point of 2 plots": (2, 1, 2.0, 0, (-1, 2)),
        "parabola of 3 plots, first point": (3, 2, 0.0, 0, (1, 0, 0)),
        "parabola of 3 plots, velocity": (3, 2, 0.0, 1, (-1.5, 2, -0.5)),
        "parabola of 3 plots, acceleration": (3, 2, 0.0, 2, (1, -2, 1)),
        "parabola of 3 plots, last point": (3, 2, 2.0, 0, (0, 0, 1)),
        "parabola of 3 plots, next point": (3, 2, 3.0, 0, (1, -3, 3)),
    }
    for name, (plots, degree, at, derivative, published) in cases.items():
        ours = polynomial_weights(np.arange(plots), degree, at, derivative=derivative)
        for i, printed in enumerate(published):
            label = f"{name}, weight of plot {i + 1}, § 4.4.3"
            yield Row(label, printed, printed, float(ours[i]), _EXACT)


def _weights() -> Iterator[Row]:
    for n in range(2, _MOST + 1):
        times = np.arange(n)
        closed = {
            "first point (4.51a)": (line.line_position_weights(n, 1 - n), 1, 0, 0),
            "velocity (4.52a)": (line.line_velocity_weights(n), 1, 0, 1),
            "last point (4.54a)": (line.line_position_weights(n, 0), 1, n - 1, 0),
            "next point (4.55a)": (line.line_position_weights(n, 1), 1, n, 0),
            "fourth point ahead (4.53)": (line.line_position_weights(n, 4), 1, n + 3, 0),
        }
        if n > 2:
            closed |= {
                "first point (4.57a)": (parabola.parabola_first_weights(n), 2, 0, 0),
                "velocity (4.58a)": (parabola.parabola_velocity_weights(n), 2, 0, 1),
                "acceleration (4.59a)": (parabola.parabola_acceleration_weights(n), 2, 0, 2),
                "last point (4.60a)": (parabola.parabola_last_weights(n), 2, n - 1, 0),
                "next point (4.61a)": (parabola.parabola_next_weights(n), 2, n, 0),
            }
        for name, (weights, degree, at, derivative) in closed.items():
            exact = polynomial_weights(times, degree, at, derivative=derivative)
            label = f"n = {n}, {name}: largest difference from the likelihood equations"
            yield Row(label, 0.0, 0.0, float(np.abs(weights - exact).max()), _EXACT)
    # At times that are not equally spaced, for which the book gives sums.
    t = np.array([0.0, 0.9, 2.3, 3.1, 5.0])
    n, squares = len(t), (t**2).sum()
    divisor = t.sum() ** 2 - n * squares
    for name, sums, derivative in (
        ("first", (t.sum() * t - squares) / divisor, 0),
        ("velocity", (t.sum() - n * t) / divisor, 1),
    ):
        ours = polynomial_weights(t, 1, 0.0, derivative=derivative)
        label = f"(4.48), {name}, unequal times: largest difference from the likelihood equations"
        yield Row(label, 0.0, 0.0, float(np.abs(sums - ours).max()), _EXACT)


def _errors() -> Iterator[Row]:
    for n, values in _LINE.items():
        times = np.arange(n)
        for (name, at, derivative), expected in zip(
            (
                ("velocity (4.63)", 0, 1),
                ("last point (4.64)", n - 1, 0),
                ("next point (4.65)", n, 0),
            ),
            values,
            strict=True,
        ):
            weights = polynomial_weights(times, 1, at, derivative=derivative)
            label = f"line of {n} plots, rms error of the {name}, figure 4.8"
            ours = float(np.sqrt(estimate_variance(weights)))
            yield Row(label, None, expected, ours, 5.1e-5)
    for n in (2, 3, 5, 8):
        for ahead in (0, 2, 3):
            weights = polynomial_weights(np.arange(n), 1, n - 1 + ahead)
            label = f"line of {n} plots, variance {ahead} scans ahead (4.66)"
            expected = float(line.line_position_variance(n, ahead))
            yield Row(label, expected, expected, float(estimate_variance(weights)), _EXACT)
    for n, spreads in _PARABOLA.items():
        variances = (
            ("velocity (4.67)", parabola.parabola_velocity_variance, 0, 1),
            ("acceleration (4.68)", parabola.parabola_acceleration_variance, 0, 2),
            ("last point", parabola.parabola_last_variance, n - 1, 0),
            ("next point", parabola.parabola_next_variance, n, 0),
        )
        for (name, formula, at, derivative), expected in zip(variances, spreads, strict=True):
            label = f"parabola of {n} plots, variance of the {name}, figure 4.8"
            yield Row(label, None, expected, float(formula(n)), 5.1e-5)
            weights = polynomial_weights(np.arange(n), 2, at, derivative=derivative)
            label = f"parabola of {n} plots, variance of the {name}, by the likelihood equations"
            ours = float(estimate_variance(weights))
            yield Row(label, None, expected, ours, 5.1e-5)
    below = np.flatnonzero(line.line_position_variance(np.arange(2, 20), 1) < 1.0)
    label = "plots from which on a line predicts better than a plot measures ('5 to 6')"
    yield Row(label, 6, 6, float(below[0] + 2), 0.0)


def _manoeuvres() -> Iterator[Row]:
    for n, printed in {3: 6.0, 4: 1.0}.items():
        label = f"factor K of the manoeuvre detector, n = {n}"
        ours = float(parabola.parabola_acceleration_variance(n))
        yield Row(label, printed, printed, ours, _EXACT)
    for n, expected in {5: 0.2857, 6: 0.1071}.items():
        label = f"factor K of the manoeuvre detector, n = {n}"
        ours = float(parabola.parabola_acceleration_variance(n))
        yield Row(label, None, expected, ours, to_digits(expected))
    finding = (
        "0.68 is the probability that straight flight is not taken for a manoeuvre, in one coordinate and scan, not "
        "that a manoeuvre is found"
    )
    ours = 1.0 - float(false_manoeuvre_probability(1.0))
    yield Row("confidence of the manoeuvre detector", 0.68, 0.6827, ours, 5.1e-5, finding)


def _aided_weights() -> Iterator[Row]:
    for ratio in (0.0, 0.3, 1.0, 5.0):
        worst = {"(4.73)": 0.0, "(4.74)": 0.0, "(4.75)": 0.0, "(4.76)": 0.0}
        for n in range(2, _MOST + 1):
            for equation, at, derivative in (
                ("(4.73)", 0, 0), ("(4.74)", 0, 1), ("(4.75)", n - 1, 0), ("(4.76)", n, 0),
            ):  # fmt: skip
                ours = (
                    aided_velocity_weights(n, ratio)
                    if derivative
                    else aided_position_weights(n, ratio, at - n + 1)
                )
                whole = np.append(ours.position, np.full(n, ours.velocity))
                difference = np.abs(whole - _batch(n, ratio, at, derivative)).max()
                worst[equation] = max(worst[equation], float(difference))
        for equation, difference in worst.items():
            label = f"{equation}, c = {ratio:g}, n = 2 to 11: largest difference from least squares"
            yield Row(label, 0.0, 0.0, difference, _EXACT)


def _batch(n: int, ratio: float, at: float, derivative: int) -> FloatArray:
    """Weights of coordinates and velocities by weighted least squares of both."""
    design = np.zeros((2 * n, 2))
    design[:n, 0], design[:n, 1], design[n:, 1] = 1.0, np.arange(n), 1.0
    precision = np.append(np.ones(n), np.full(n, ratio))
    wanted = np.array([0.0, 1.0]) if derivative else np.array([1.0, at])
    scaled = design * precision[:, None]
    return np.asarray(scaled @ np.linalg.solve(design.T @ scaled, wanted))


def _aided_errors() -> Iterator[Row]:
    for n, values in _AIDED.items():
        computed = (
            aided_position_variance(n, 1.0),
            aided_velocity_variance(n, 1.0),
            aided_position_variance(n, 1.0, 1),
        )
        names = ("last point", "velocity (4.77)", "next point")
        for name, value, expected in zip(names, computed, values, strict=True):
            label = f"c = 1, n = {n}: variance of the {name}, figure 4.9"
            yield Row(label, None, expected, float(value), 5.1e-5)
    for n in (2, 3, 4):
        c = 1.0
        bracket = (
            (n + 1) * (2 * n - 1) / 2 + 6 * c * (5 * n - 1) / (n - 1) + 36 * c**2 / (n - 1) ** 2
        )
        printed = 4 * (n - 1) / (n * (n**2 - 1 + 12 * c) ** 2) * bracket
        weights = aided_position_weights(n, c, 0)
        ours = float(weights.position @ weights.position + n * weights.velocity**2 / c)
        finding = "(4.78) is misprinted: it needs (n - 1)^2 before the bracket and 3 c in it"
        label = f"c = 1, n = {n}: variance of the last point (4.78)"
        yield Row(label, round(printed, 4), _AIDED[n][0], ours, 5.1e-5, finding)
    for n, (coordinate, velocity) in _FALLS.items():
        fall = 1.0 - float(aided_position_variance(n, 1.0) / line.line_position_variance(n))
        label = f"c = 1, n = {n}: fall of the coordinate's variance ('30 to 40 %')"
        yield Row(label, None, coordinate, fall, 6e-4)
        gain = float(line.line_velocity_variance(n) / aided_velocity_variance(n, 1.0))
        label = f"c = 1, n = {n}: velocity's variance without over with its observation ('over 2')"
        finding = "more than twice up to n = 3 only" if n == 4 else ""
        yield Row(label, None, velocity, gain, 1e-6, finding)
