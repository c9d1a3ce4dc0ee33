# SPDX-License-Identifier: Apache-2.0
"""Wald's sequential test: its bounds, and what it really does on envelopes that are not quantised.

Source: A. Wald, Sequential Analysis, 1947; Kuzmin 1967, § 1.3, whose A is the lower bound and B the upper one.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.special import i0e

from primary_proc.calculators.pulse.single_pulse import steady_probability

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
    """Errors and lengths of the test for a steady target.

    Args:
        amplitude: a, of the target over the noise's sigma, the same on each pulse.
        false_alarm: wanted probability to decide for the target in noise.
        miss: wanted probability to decide for noise on the target.

    Returns:
        The true errors and the mean numbers of samples.
    """
    decided, length = operating_characteristic(amplitude, [0.0, amplitude], false_alarm, miss)
    return SequentialQuality(
        float(decided[0]), 1.0 - float(decided[1]), float(length[0]), float(length[1])
    )


def operating_characteristic(
    amplitude: float, true: npt.ArrayLike, false_alarm: float, miss: float
) -> tuple[FloatArray, FloatArray]:
    """What the test made for one steady target does on others, from the integral equations of its sum.

    Each sample adds -a^2 / 2 + ln I_0(a x) for an envelope x; the interval between the bounds is cut into cells and
    the equations become a linear system.

    Args:
        amplitude: a, that the test is made for, over the noise's sigma.
        true: amplitudes that there are, shape (n,).
        false_alarm: wanted probability to decide for the target in noise.
        miss: wanted probability to decide for noise on the target.

    Returns:
        (probability to decide for the target, mean number of samples), each of shape (n,).
    """
    lower, upper = np.log(wald_bounds(false_alarm, miss))
    edges = np.linspace(lower, upper, _CELLS + 1)
    # The sum is followed from the middle of each cell, and from zero, where it begins.
    places = np.append((edges[1:] + edges[:-1]) / 2.0, 0.0)
    envelope = np.linspace(0.0, _HIGHEST_ENVELOPE, _ENVELOPES)
    change = np.log(i0e(amplitude * envelope)) + amplitude * envelope - amplitude**2 / 2.0
    steps = edges - places[:, None]
    decided, length = np.empty(np.shape(true)), np.empty(np.shape(true))
    for place, present in enumerate(np.asarray(true, dtype=float)):
        over = np.interp(steps, change, steady_probability(envelope, present))
        stays = over[:, :-1] - over[:, 1:]
        sources = np.stack([over[:-1, -1], np.ones(_CELLS)], axis=1)
        wins, lasts = np.linalg.solve(np.eye(_CELLS) - stays[:-1], sources).T
        decided[place] = stays[-1] @ wins + over[-1, -1]
        length[place] = stays[-1] @ lasts + 1.0
    return decided, length
