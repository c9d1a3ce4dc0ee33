# SPDX-License-Identifier: Apache-2.0
"""Whether a pass of the beam over a target gives a plot, and how strong it is.

A slowly fluctuating target (Swerling 1) has an exponential power of mean 1 + S over the noise's. It passes a threshold
that noise passes with probability F with probability F^(1 / (1 + S)), which falls with the range as S does (Kuzmin
1967, § 4.2.2 and 4.3.5: plots are missed the more often the farther away). Above its threshold an exponential power
is exponential again.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]

_CERTAIN = 1.0 - 1e-12


def detection_probability(snr_db: npt.ArrayLike, false_alarm_probability: float) -> FloatArray:
    """Probability of a plot.

    Args:
        snr_db: mean power ratio of the integrated burst, dB, any shape.
        false_alarm_probability: F, of the threshold.

    Returns:
        Probability, same shape.
    """
    power = 10.0 ** (np.asarray(snr_db, dtype=float) / 10.0)
    return np.asarray(false_alarm_probability ** (1.0 / (1.0 + power)))


def snr_for_detection(probability: npt.ArrayLike, false_alarm_probability: float) -> FloatArray:
    """Signal-to-noise ratio of a target that is detected so often; the inverse of `detection_probability`.

    Args:
        probability: between that of a false alarm and one, any shape.
        false_alarm_probability: F, of the threshold.

    Returns:
        Mean power ratio, dB, same shape.

    Raises:
        ValueError: a probability is not between F and one.
    """
    wanted = np.asarray(probability, dtype=float)
    if not np.all((wanted > false_alarm_probability) & (wanted <= 1.0)):
        raise ValueError(
            f"a detection probability lies above {false_alarm_probability:g} and not above 1, got "
            f"{wanted.min():g} to {wanted.max():g}"
        )
    power = np.log(false_alarm_probability) / np.log(np.minimum(wanted, _CERTAIN)) - 1.0
    return np.asarray(10.0 * np.log10(power))


def power_over_threshold(
    snr_db: FloatArray, false_alarm_probability: float, rng: np.random.Generator
) -> FloatArray:
    """Draw the powers of plots, given that they passed the threshold.

    Args:
        snr_db: mean power ratio behind each plot, -inf for noise, dB, shape (n,).
        false_alarm_probability: of the threshold.
        rng: source of randomness.

    Returns:
        Power over the mean power of the noise, shape (n,).
    """
    mean = 1.0 + 10.0 ** (snr_db / 10.0)
    return np.asarray(-np.log(false_alarm_probability) + mean * rng.exponential(size=len(snr_db)))
