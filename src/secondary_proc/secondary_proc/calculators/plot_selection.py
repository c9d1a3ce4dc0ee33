# SPDX-License-Identifier: Apache-2.0
"""Which plot of a gate to take, and how often it is the target's own.

Source: Kuzmin 1967, § 4.7.3-4.7.4, (4.140)-(4.149). False plots lie in the gate by Poisson's law.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from secondary_proc.calculators.rule_chain import FloatArray
from secondary_proc.motion import inverse_2x2, quadratic_form

RULES = ("distance", "ellipse", "likelihood")


def select_plot(
    differences: FloatArray,
    covariance: FloatArray,
    rule: str = "likelihood",
    sigmas: float = np.inf,
) -> int | None:
    """Select one plot for a track.

    Source: (4.141)-(4.144); the smallest distance, not the largest that the flowchart of figure 4.26 prints.

    Args:
        differences: of the plots from the prediction, metres, shape (n, 2).
        covariance: of each difference, m^2, shape (n, 2, 2).
        rule: "distance" for the nearest in metres, "ellipse" for the least normalised distance, "likelihood" for the
            greatest normal density, which differs from it where plots are not equally accurate.
        sigmas: half axis of the elliptical gate.

    Returns:
        Index of the plot; None where the gate is empty.

    Raises:
        ValueError: there is no such rule.
    """
    if rule not in RULES:
        raise ValueError(f"no rule {rule!r}; there are {', '.join(RULES)}")
    inverse, determinant = inverse_2x2(covariance)
    normalised = quadratic_form(differences, inverse)
    cost = {
        "distance": (differences**2).sum(axis=1),
        "ellipse": normalised,
        "likelihood": normalised + np.log(determinant),
    }[rule]
    cost = np.where(normalised <= sigmas**2, cost, np.inf)
    if not np.isfinite(cost).any():
        return None
    return int(np.argmin(cost))


def nearest_in_metres(
    density: npt.ArrayLike, along_std: npt.ArrayLike, across_std: npt.ArrayLike
) -> FloatArray:
    """Probability that the plot nearest in metres is the target's own.

    The counterpart of (4.149), `expected_quality.correct_selection`, for circles instead of ellipses.

    Args:
        density: nu, false plots per square metre, any shape.
        along_std: standard deviation of the difference along one axis, metres, any shape that fits.
        across_std: the same along the other.

    Returns:
        Probability, in the common shape.
    """
    twice = 2.0 * np.pi * np.asarray(density, dtype=float)
    along, across = np.asarray(along_std, dtype=float), np.asarray(across_std, dtype=float)
    return np.asarray(1.0 / np.sqrt((1.0 + twice * along**2) * (1.0 + twice * across**2)))


@dataclass(frozen=True, slots=True)
class Outcome:
    """What becomes of a scan, each attribute in the shape of the arguments; their sum is one.

    Attributes:
        correct: the target's own plot is taken.
        wrong: a false plot is taken.
        none: the gate is empty.
    """

    correct: FloatArray
    wrong: FloatArray
    none: FloatArray


def selection_outcome(
    density: npt.ArrayLike, area: npt.ArrayLike, sigmas: npt.ArrayLike, detection: npt.ArrayLike
) -> Outcome:
    """Probabilities of a scan with a finite gate and a target that is not always seen.

    (4.149) is what `correct` tends to for a sure target and an endless gate.

    Args:
        density: nu, false plots per square metre, any shape.
        area: root of the determinant of the difference's covariance, sigma_x sigma_y, m^2, any shape that fits.
        sigmas: half axis of the elliptical gate, any shape that fits.
        detection: probability of the target's plot, any shape that fits.

    Returns:
        The probabilities.
    """
    crowd = np.pi * np.asarray(density, dtype=float) * np.asarray(area, dtype=float)
    square, seen = np.square(np.asarray(sigmas, dtype=float)), np.asarray(detection, dtype=float)
    correct = seen * -np.expm1(-(0.5 + crowd) * square) / (1.0 + 2.0 * crowd)
    none = (1.0 + seen * np.expm1(-square / 2.0)) * np.exp(-crowd * square)
    return Outcome(np.asarray(correct), np.asarray(1.0 - correct - none), np.asarray(none))
