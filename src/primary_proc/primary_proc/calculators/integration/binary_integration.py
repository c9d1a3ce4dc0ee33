# SPDX-License-Identifier: Apache-2.0
"""Binary integration of one burst in one window: the count of ones, and the weighted sum of ones."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
from scipy.optimize import brentq
from scipy.stats import binom, norm

from primary_proc.calculators.integration.window_law import sum_law
from primary_proc.calculators.pulse.single_pulse import threshold_for
from primary_proc.calculators.pulse.target_models import TARGETS

FloatArray = npt.NDArray[np.float64]

_RESOLUTION = 1e-3
_LOUDEST_DB = 80.0
_FAINTEST_DB = -40.0


def count_probability(count: int, pulses: int, one: npt.ArrayLike) -> FloatArray:
    """Probability of a count of ones or more in a window whose pulses are alike.

    Source: Kuzmin 1967, (3.13) with p_S, (3.14) with p_N.

    Args:
        count: second threshold.
        pulses: N_0.
        one: probability of a one, any shape.

    Returns:
        Probability, same shape.
    """
    return np.asarray(binom.sf(count - 1, pulses, np.asarray(one, dtype=float)))


def one_probability(count: int, pulses: int, probability: float) -> float:
    """Probability of a one that gives a probability of detection; inverse of `count_probability`.

    Args:
        count: second threshold.
        pulses: N_0.
        probability: wanted, in (0, 1).

    Returns:
        p_N for a false-alarm probability (3.14), p_S for one of detection (3.13).
    """
    # The inverse of the binomial's tail is a quantile of the beta distribution; by bisection it keeps its digits.
    return float(
        np.exp(
            brentq(
                lambda log: binom.logsf(count - 1, pulses, np.exp(log)) - np.log(probability),
                -80.0,
                -1e-15,
                xtol=1e-14,
            )
        )
    )


def detection_by_count(
    pulses: int, count: int, noise: float, snr_db: float, target: str = "steady"
) -> float:
    """Probability that a rectangular burst that fills the window is detected.

    Args:
        pulses: N_0.
        count: second threshold.
        noise: probability p_N of a one in noise.
        snr_db: mean power over the mean noise power.
        target: name in `TARGETS`.

    Returns:
        Probability; of targets that are slow to change, the mean over their strengths.
    """
    model = TARGETS[target]
    amplitude = np.sqrt(2.0) * 10.0 ** (snr_db / 20.0) * model.factor
    one = model.single_pulse(threshold_for(noise), amplitude)
    return float(count_probability(count, pulses, one) @ model.weight)


def required_snr_db(
    pulses: int, count: int, false_alarm: float, detection: float, target: str = "steady"
) -> float:
    """Signal that a count of ones needs.

    Source: Kuzmin 1967, § 3.1.3, figure 3.3.

    Args:
        pulses: N_0, the burst being rectangular and just filling the window.
        count: second threshold.
        false_alarm: probability that noise alone reaches the count in one window, (3.14).
        detection: wanted probability (3.13).
        target: name in `TARGETS`.

    Returns:
        Power over the mean noise power in dB: a^2 / 2 of a steady target, k^2 of a fast one.
    """
    noise = one_probability(count, pulses, false_alarm)

    def excess(snr_db: float) -> float:
        return detection_by_count(pulses, count, noise, snr_db, target) - detection

    return float(brentq(excess, _FAINTEST_DB, _LOUDEST_DB, xtol=1e-9))


def weighted_sum_probability(
    weights: npt.ArrayLike, one: npt.ArrayLike, threshold: float, model: str = "exact"
) -> float:
    """Probability that a weighted sum of ones reaches a threshold.

    Source: Kuzmin 1967, (3.15) with p_N and (3.16) with p_S for "kuzmin", a normal approximation. With p_N it is wrong
    by orders of magnitude, since a threshold lies far out in the tail. "exact" adds pulse after pulse, the weights
    rounded to a thousandth of the largest unless they are whole.

    Args:
        weights: eta, not negative, shape (pulses,).
        one: probability of a one, shape (pulses,) or one for all.
        threshold: on the sum.
        model: "exact" or "kuzmin".

    Returns:
        Probability.

    Raises:
        ValueError: the model is neither.
    """
    eta = np.asarray(weights, dtype=float)
    chance = np.broadcast_to(np.asarray(one, dtype=float), eta.shape)
    if model == "kuzmin":
        spread = np.sqrt((chance * (1.0 - chance) * eta**2).sum())
        return float(norm.sf((threshold - (chance * eta).sum()) / spread))
    if model != "exact":
        raise ValueError(f"model {model!r} is neither exact nor kuzmin")
    unit = 1.0 if (eta == np.rint(eta)).all() else float(eta.max()) * _RESOLUTION
    scores = np.outer(np.rint(eta / unit), [0.0, 1.0])
    law = sum_law(scores, np.stack([1.0 - chance, chance], axis=1))
    first = int(np.ceil(threshold / unit - 1e-6))
    return float(law[max(first, 0) :][::-1].sum())
