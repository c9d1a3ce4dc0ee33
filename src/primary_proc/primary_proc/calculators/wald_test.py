# SPDX-License-Identifier: Apache-2.0
"""Wald's sequential test: its bounds, and what it really does on envelopes that are not quantised.

Source: A. Wald, Sequential Analysis, 1947; Kuzmin 1967, § 1.3, whose A is the lower bound and B the upper one.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.special import i0e

from primary_proc.calculators.single_pulse import steady_probability

FloatArray = npt.NDArray[np.float64]

_CELLS = 300
_HIGHEST_ENVELOPE, _ENVELOPES = 40.0, 8_001


@dataclass(frozen=True, slots=True)
class SequentialQuality:
    """What a sequential test does.

    Attributes:
        false_alarm: probability to decide for the target in noise.
        miss: probability to decide for noise on the target.
        noise_length: mean number of samples to a decision in noise.
        target_length: mean number of samples to a decision on the target.
    """

    false_alarm: float
    miss: float
    noise_length: float
    target_length: float


def wald_bounds(false_alarm: float, miss: float) -> tuple[float, float]:
    """Bounds on the likelihood ratio: A = P_miss / (1 - P_fa) below, B = (1 - P_miss) / P_fa above.

    The errors are then at most about those wanted: the ratio mostly jumps over a bound.

    Args:
        false_alarm: wanted probability P_fa to decide for the target in noise.
        miss: wanted probability P_miss to decide for noise on the target.

    Returns:
        (A, B).

    Raises:
        ValueError: the errors are not positive, or their sum is one or more.
    """
    if min(false_alarm, miss) <= 0.0 or false_alarm + miss >= 1.0:
        raise ValueError(f"no test has the error probabilities {false_alarm:g} and {miss:g}")
    return miss / (1.0 - false_alarm), (1.0 - miss) / false_alarm


def sequential_quality(amplitude: float, false_alarm: float, miss: float) -> SequentialQuality:
    """Errors and lengths of the test for a steady target, from the integral equations of the sum between its bounds.

    Each sample adds -a^2 / 2 + ln I_0(a x) for an envelope x; the interval between the bounds is cut into cells and
    the equations become a linear system.

    Args:
        amplitude: a, of the target over the noise's sigma, the same on each pulse.
        false_alarm: wanted probability to decide for the target in noise.
        miss: wanted probability to decide for noise on the target.

    Returns:
        The true errors and the mean numbers of samples.
    """
    lower, upper = np.log(wald_bounds(false_alarm, miss))
    edges = np.linspace(lower, upper, _CELLS + 1)
    places = np.append((edges[1:] + edges[:-1]) / 2.0, 0.0)
    envelope = np.linspace(0.0, _HIGHEST_ENVELOPE, _ENVELOPES)
    change = np.log(i0e(amplitude * envelope)) + amplitude * envelope - amplitude**2 / 2.0
    steps = edges - places[:, None]

    def solve(target: float) -> tuple[float, float]:
        """Probability of the upper bound, and mean length, from zero."""
        over = np.interp(steps, change, steady_probability(envelope, target))
        stays = over[:, :-1] - over[:, 1:]
        inner = np.eye(_CELLS) - stays[:-1]
        wins, length = np.linalg.solve(inner, np.stack([over[:-1, -1], np.ones(_CELLS)], 1)).T
        return float(stays[-1] @ wins + over[-1, -1]), float(stays[-1] @ length + 1.0)

    false, noise_length = solve(0.0)
    detected, target_length = solve(amplitude)
    return SequentialQuality(false, 1.0 - detected, noise_length, target_length)
