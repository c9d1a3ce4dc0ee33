# SPDX-License-Identifier: Apache-2.0
"""Thresholds of CFAR normalisers, and what one pulse of an echo does at them."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
from scipy.optimize import brentq

from primary_proc.calculators.cfar.cfar_laws import KnownLevel, LevelLaw
from primary_proc.calculators.pulse.target_models import TARGETS

FloatArray = npt.NDArray[np.float64]

_LOG_MULTIPLIERS = (-60.0, 200.0)
_WEAKEST_DB = -60.0
_SPREAD_DB = 10.0
_ONE_PULSE = {"slow": "fast", "slow-dominant": "fast-dominant"}


def multiplier_for(law: LevelLaw, probability: float) -> float:
    """Multiplier of the noise level for a wanted false-alarm probability.

    Args:
        law: of the level.
        probability: p_N of one cell and pulse, in (0, 1).

    Returns:
        T on the mean of the cells for averages, greatest-of and smallest-of, on the cell for an ordered statistic.

    Raises:
        ValueError: the probability is not between 0 and 1, or out of reach.
    """
    if not 0.0 < probability < 1.0:
        raise ValueError(f"a probability of {probability} has no threshold")
    wanted = np.log(probability)

    def excess(log_multiplier: float) -> float:
        return float(law.log_exceedance(np.exp(log_multiplier)) - wanted)

    return float(np.exp(brentq(excess, *_LOG_MULTIPLIERS, xtol=1e-14)))


def false_alarm_probability(law: LevelLaw, multiplier: npt.ArrayLike) -> FloatArray:
    """Probability that noise exceeds a multiple of its level.

    Args:
        law: of the level.
        multiplier: T >= 0, any shape.

    Returns:
        p_N, same shape.
    """
    return np.exp(law.log_exceedance(multiplier))


def detection_probability(
    law: LevelLaw, multiplier: float, snr_db: npt.ArrayLike, target: str
) -> FloatArray:
    """Probability that one pulse of a target exceeds a multiple of the noise level.

    Closed where the echo's power is exponential (Swerling 1 and 2), by quadrature over the level elsewhere. One pulse
    cannot tell slow from fast fluctuation.

    Args:
        law: of the level.
        multiplier: T.
        snr_db: mean power over the mean noise power, any shape.
        target: name in `target_models.TARGETS`.

    Returns:
        Probability, same shape.
    """
    target = _ONE_PULSE.get(target, target)
    snr = 10.0 ** (np.asarray(snr_db, dtype=float) / 10.0)
    if target == "fast":
        return np.exp(law.log_exceedance(multiplier / (1.0 + snr)))
    level, weight = law.quadrature()
    threshold = np.sqrt(2.0 * multiplier * level)
    return TARGETS[target].single_pulse(threshold, np.sqrt(2.0 * snr)[..., None]) @ weight


def required_snr_db(law: LevelLaw, false_alarm: float, detection: float, target: str) -> float:
    """Signal-to-noise ratio that one pulse needs.

    Args:
        law: of the level.
        false_alarm: p_N, in (0, detection).
        detection: wanted probability, in (false_alarm, 1).
        target: name in `target_models.TARGETS`.

    Returns:
        Mean power over the mean noise power, dB.

    Raises:
        ValueError: the probabilities are not in this order.
    """
    if not 0.0 < false_alarm < detection < 1.0:
        raise ValueError(f"needs 0 < {false_alarm} < {detection} < 1")
    multiplier = multiplier_for(law, false_alarm)
    exponential = float(10.0 * np.log10(multiplier / multiplier_for(law, detection) - 1.0))
    if _ONE_PULSE.get(target, target) == "fast":
        return exponential

    def excess(snr_db: float) -> float:
        return float(detection_probability(law, multiplier, snr_db, target)) - detection

    # No fluctuation needs much more than an exponential one: less at high probabilities, little more at low ones.
    return float(brentq(excess, _WEAKEST_DB, exponential + _SPREAD_DB, xtol=1e-10))


def loss_db(
    law: LevelLaw, false_alarm: float, detection: float = 0.5, target: str = "steady"
) -> float:
    """Signal-to-noise ratio that it costs not to know the noise level.

    Args:
        law: of the level.
        false_alarm: p_N.
        detection: probability at which the needs are compared.
        target: name in `target_models.TARGETS`.

    Returns:
        dB more than with `KnownLevel`, for one pulse.
    """
    needs = [required_snr_db(each, false_alarm, detection, target) for each in (law, KnownLevel())]
    return needs[0] - needs[1]
