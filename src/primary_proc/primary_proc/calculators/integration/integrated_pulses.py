# SPDX-License-Identifier: Apache-2.0
"""Detection on the sum of the powers of n pulses, the non-coherent integration that others are measured against.

The sum of n powers of noise, in units of their mean, is gamma distributed with n degrees. With an echo it is gamma
with n + j degrees, j being Poisson distributed about the echo's whole energy (J. I. Marcum, 1947); if the energy itself
fluctuates with m pairs of degrees of freedom (P. Swerling, 1954), j is negative-binomial. One sum of positive terms
serves all cases: m is 1, n, 2, 2 n for Swerling 1 to 4, and infinite for the steady target.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import numpy.typing as npt
from scipy.optimize import brentq
from scipy.special import gammainc, gammainccinv, gammaln, xlog1py, xlogy

FloatArray = npt.NDArray[np.float64]

_WEAKEST_DB, _STRONGEST_DB = -100.0, 200.0
_DEVIATIONS = 12.0
_LEAST_TERMS = 80

ENERGY_DEGREES: dict[str, Callable[[int], float]] = {
    "steady": lambda pulses: np.inf,
    "slow": lambda pulses: 1.0,
    "fast": lambda pulses: float(pulses),
    "slow-dominant": lambda pulses: 2.0,
    "fast-dominant": lambda pulses: 2.0 * pulses,
}
"""Pairs of degrees of freedom m of the energy of n pulses, for each name in `target_models.TARGETS`."""


def integration_threshold(false_alarm: float, pulses: int) -> float:
    """Threshold on the sum of the powers of pulses.

    Args:
        false_alarm: probability that noise exceeds it, in (0, 1).
        pulses: n.

    Returns:
        In units of the mean noise power of one pulse.
    """
    return float(gammainccinv(pulses, false_alarm))


def integrated_detection_probability(
    snr_db: npt.ArrayLike, false_alarm: float, pulses: int, target: str
) -> FloatArray:
    """Probability that the sum of the powers of pulses exceeds its threshold.

    Args:
        snr_db: mean power of a pulse over the mean noise power, any shape.
        false_alarm: probability for noise, in (0, 1).
        pulses: n, all of one strength but for the fluctuation.
        target: name in `target_models.TARGETS`.

    Returns:
        Probability, same shape, exact to about 1e-13.

    Raises:
        ValueError: the probability or the number of pulses makes no sense.
    """
    if not 0.0 < false_alarm < 1.0 or pulses < 1:
        raise ValueError(f"no threshold for {pulses} pulses and a probability of {false_alarm}")
    energy = pulses * 10.0 ** (np.asarray(snr_db, dtype=float)[..., None] / 10.0)
    threshold = integration_threshold(false_alarm, pulses)
    # Beyond these degrees the sum stays under its threshold with no probability that matters.
    terms = int(threshold + _DEVIATIONS * np.sqrt(threshold)) + _LEAST_TERMS
    extra = np.arange(terms, dtype=float)
    degrees = ENERGY_DEGREES[target](pulses)
    if np.isinf(degrees):
        log_weight = xlogy(extra, energy) - energy - gammaln(extra + 1.0)
    else:
        log_weight = (
            gammaln(extra + degrees)
            - gammaln(degrees)
            - gammaln(extra + 1.0)
            - xlog1py(degrees, energy / degrees)
            - xlog1py(extra, degrees / energy)
        )
    missed = np.exp(log_weight) @ gammainc(pulses + extra, threshold)
    return np.asarray(1.0 - missed)


def integrated_snr_db(false_alarm: float, detection: float, pulses: int, target: str) -> float:
    """Signal-to-noise ratio that each pulse needs.

    Args:
        false_alarm: probability for noise, in (0, detection).
        detection: wanted probability, in (false_alarm, 1).
        pulses: n.
        target: name in `target_models.TARGETS`.

    Returns:
        Mean power of a pulse over the mean noise power, dB.

    Raises:
        ValueError: the probabilities are not in this order.
    """
    if not 0.0 < false_alarm < detection < 1.0:
        raise ValueError(f"needs 0 < {false_alarm} < {detection} < 1")

    def excess(snr_db: float) -> float:
        found = integrated_detection_probability(snr_db, false_alarm, pulses, target)
        return float(found) - detection

    return float(brentq(excess, _WEAKEST_DB, _STRONGEST_DB, xtol=1e-11))
