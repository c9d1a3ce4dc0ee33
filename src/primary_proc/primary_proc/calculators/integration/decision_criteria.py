# SPDX-License-Identifier: Apache-2.0
"""Thresholds of the likelihood ratio, and what they become for the sums that stand in for it."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]


def average_risk(
    false_alarm: npt.ArrayLike,
    miss: npt.ArrayLike,
    presence: float,
    miss_cost: float = 1.0,
    false_alarm_cost: float = 1.0,
) -> FloatArray:
    """Mean cost of a decision.

    Source: Kuzmin 1967, (1.45).

    Args:
        false_alarm: probability to decide for a target where there is none, any shape.
        miss: probability to decide against one where there is, same shape.
        presence: prior probability P_S of a target.
        miss_cost: C_1.
        false_alarm_cost: C_2.

    Returns:
        R = C_2 Q_S P_fa + C_1 P_S P_miss, same shape.
    """
    return np.asarray(
        false_alarm_cost * (1.0 - presence) * np.asarray(false_alarm)
        + miss_cost * presence * np.asarray(miss)
    )


def ratio_threshold(
    presence: float, miss_cost: float = 1.0, false_alarm_cost: float = 1.0
) -> float:
    """Likelihood ratio from which on deciding for a target has the least mean cost.

    Source: Kuzmin 1967, (1.46)-(1.48); equal costs make the ideal observer.

    Args:
        presence: prior probability P_S of a target, in (0, 1).
        miss_cost: C_1.
        false_alarm_cost: C_2.

    Returns:
        l_0 = Q_S C_2 / (P_S C_1).
    """
    return (1.0 - presence) * false_alarm_cost / (presence * miss_cost)


def likelihood_sum_threshold(log_ratio: float, amplitude: npt.ArrayLike) -> float:
    """Threshold of sum ln I_0(a x).

    Source: Kuzmin 1967, (1.50).

    Args:
        log_ratio: ln l_0.
        amplitude: a of a steady target on each pulse, shape (pulses,).

    Returns:
        ln l_0 + sum a^2 / 2.
    """
    return float(log_ratio + np.square(amplitude).sum() / 2.0)


def linear_sum_threshold(log_ratio: float, amplitude: float, shape: npt.ArrayLike) -> float:
    """Threshold of sum g x, which stands for (1.50) while the signal is strong.

    Source: Kuzmin 1967, § 1.3.3.

    Args:
        log_ratio: ln l_0.
        amplitude: a_0 at the beam's axis.
        shape: g of each pulse, shape (pulses,).

    Returns:
        ln l_0 / a_0 + a_0 / 2 sum g^2.
    """
    return float(log_ratio / amplitude + amplitude / 2.0 * np.square(shape).sum())


def square_sum_threshold(log_ratio: float, amplitude: float, shape: npt.ArrayLike) -> float:
    """Threshold of sum g^2 x^2, which stands for (1.50) while the signal is weak.

    Source: Kuzmin 1967, § 1.3.3.

    Args:
        log_ratio: ln l_0.
        amplitude: a_0 at the beam's axis.
        shape: g of each pulse, shape (pulses,).

    Returns:
        4 ln l_0 / a_0^2 + 2 sum g^2.
    """
    return float(4.0 * log_ratio / amplitude**2 + 2.0 * np.square(shape).sum())


def fast_sum_threshold(log_ratio: float, ratio: npt.ArrayLike) -> float:
    """Threshold of sum k^2 x^2 / 2 (1 + k^2), the likelihood ratio of a fast-fluctuating target.

    Source: from Kuzmin 1967, (1.38) and (1.40).

    Args:
        log_ratio: ln l_0.
        ratio: k^2, mean power over the mean noise power on each pulse, shape (pulses,).

    Returns:
        ln l_0 + sum ln(1 + k^2).
    """
    return float(log_ratio + np.log1p(ratio).sum())
