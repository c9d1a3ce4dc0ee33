# SPDX-License-Identifier: Apache-2.0
"""Accuracy of a delay measured where a Gaussian pulse in noise crosses the threshold of binary quantisation."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from primary_proc.calculators.quantisation.noise_excursions import video_model

FloatArray = npt.NDArray[np.float64]


def crossing_delay_variance(
    threshold: npt.ArrayLike, signal: npt.ArrayLike, model: str = "book"
) -> FloatArray:
    """Variance of the moment at which the edge of a pulse crosses a threshold.

    Noise moves the moment by its voltage over the slope there. For a strong signal: near the foot and the top of the
    pulse, where the slope vanishes, the noise does not move a crossing but makes and hides crossings.

    Source: Kuzmin 1967, (2.38)-(2.42); in (2.42) x_0 is squared, as the line before has it.

    Args:
        threshold: x_0 in units of the noise's sigma.
        signal: a_0 of the pulse's middle, over x_0; broadcast with it.
        model: "book" for the pulse exp(-pi nu^2), "physical" for what its matched filter makes of it.

    Returns:
        Variance of nu = t / tau, of the broadcast shape; NaN where the pulse does not reach the threshold.

    Raises:
        ValueError: the model is neither.
    """
    response = video_model(model)
    x, a = np.asarray(threshold, dtype=float), np.asarray(signal, dtype=float)
    with np.errstate(invalid="ignore", divide="ignore"):
        moment = np.sqrt(np.log(a / x) / -np.log(response.echo(np.ones(()))))
        return np.asarray(1.0 / np.square(a * response.slope(moment)))


def best_delay_threshold(signal: npt.ArrayLike) -> FloatArray:
    """Threshold of the most accurate delay: where the edge is steepest.

    Source: Kuzmin 1967, § 2.3.4; the same for both models.

    Args:
        signal: a_0, any shape.

    Returns:
        x_0 = a_0 exp(-1/2), same shape.
    """
    return np.exp(-0.5) * np.asarray(signal, dtype=float)


def potential_delay_variance(signal: npt.ArrayLike) -> FloatArray:
    """Least variance of any estimate of the delay.

    Source: Kuzmin 1967, (2.43)-(2.44). It rests on the pulse at the input and white noise, so it holds for both models.

    Args:
        signal: a_0 of the pulse's middle behind the matched filter, any shape.

    Returns:
        Variance of nu = t / tau, same shape.
    """
    return np.asarray(1.0 / (np.pi * np.square(np.asarray(signal, dtype=float))))
