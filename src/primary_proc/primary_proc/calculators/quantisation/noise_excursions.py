# SPDX-License-Identifier: Apache-2.0
"""How often, and for how long, the envelope of noise is over a threshold, and what that makes of a time gate.

Time is nu, in pulse lengths. The model "book" takes the noise's correlation as it is printed (Kuzmin 1967, 2.21),
"physical" that of white noise behind the printed filter, which changes 2.5 times more slowly.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from primary_proc.calculators.pulse.single_pulse import fluctuating_probability
from radar_common.pulse_response import PULSE_RESPONSES, PulseResponse

FloatArray = npt.NDArray[np.float64]

_MODELS = {"book": "gaussian-book", "physical": "gaussian"}


def video_model(model: str) -> PulseResponse:
    """Find pulse and noise along range.

    Args:
        model: "book" or "physical".

    Returns:
        The pair that belongs together.

    Raises:
        ValueError: the model is neither.
    """
    if model not in _MODELS:
        raise ValueError(f"model {model!r} is neither book nor physical")
    return PULSE_RESPONSES[_MODELS[model]]


def crossing_rate(threshold: npt.ArrayLike, model: str = "book") -> FloatArray:
    """Mean number of times that noise rises over a threshold in one pulse length.

    Source: Kuzmin 1967, (2.61)-(2.62), (2.62a).

    Args:
        threshold: x_0 in units of the noise's sigma, any shape.
        model: "book" or "physical".

    Returns:
        Up-crossings per unit nu, same shape.

    Raises:
        ValueError: the model is neither.
    """
    x = np.asarray(threshold, dtype=float)
    rate = video_model(model).bandwidth / np.sqrt(2.0 * np.pi)
    return np.asarray(rate * x * np.exp(-np.square(x) / 2.0))


def mean_excursion(threshold: npt.ArrayLike, model: str = "book") -> FloatArray:
    """Mean time that noise stays over a threshold.

    Source: Kuzmin 1967, (2.57) and (2.63), (2.63a).

    Args:
        threshold: x_0 > 0, any shape.
        model: "book" or "physical".

    Returns:
        Duration in pulse lengths, same shape.

    Raises:
        ValueError: the model is neither.
    """
    x = np.asarray(threshold, dtype=float)
    return np.asarray(np.sqrt(2.0 * np.pi) / (video_model(model).bandwidth * x))


def false_detection_in_gate(
    threshold: npt.ArrayLike, gate: npt.ArrayLike, model: str = "book"
) -> FloatArray:
    """Probability that noise is over a threshold anywhere within a gate.

    Crossings are counted as if noise were as often below the threshold as it can be: too low by 2 % for x_0 = 3, 16 %
    for x_0 = 1.5, in a gate of one pulse length. `pulse_in_gate.detection_in_gate` with no signal is nearer.

    Source: Kuzmin 1967, (2.59).

    Args:
        threshold: x_0, any shape.
        gate: length of the gate in pulse lengths, broadcast with it.
        model: "book" or "physical".

    Returns:
        Probability, of the broadcast shape.

    Raises:
        ValueError: the model is neither.
    """
    start = fluctuating_probability(threshold, 0.0)
    crossings = crossing_rate(threshold, model) * np.asarray(gate, dtype=float)
    return np.asarray(1.0 - (1.0 - start) * np.exp(-crossings))


def long_excursions(
    duration: npt.ArrayLike, threshold: npt.ArrayLike, model: str = "book", law: str = "rice"
) -> FloatArray:
    """Share of excursions of noise that last longer than a relay needs to respond.

    Source: Kuzmin 1967, (2.64)-(2.65), for "kuzmin", whose mean 1 / N contradicts (2.63); S. O. Rice, Bell Syst. Tech.
    J. 37, 1958, for "rice", the parabolic excursions of a high threshold.

    Args:
        duration: in pulse lengths, any shape.
        threshold: x_0, broadcast with it.
        model: "book" or "physical".
        law: "rice" or "kuzmin".

    Returns:
        Share, of the broadcast shape.

    Raises:
        ValueError: the model or the law is unknown.
    """
    time = np.asarray(duration, dtype=float)
    if law == "kuzmin":
        return np.asarray(np.exp(-crossing_rate(threshold, model) * time))
    if law != "rice":
        raise ValueError(f"law {law!r} is neither rice nor kuzmin")
    return np.asarray(np.exp(-np.pi / 4.0 * np.square(time / mean_excursion(threshold, model))))


def long_crossing_rate(
    duration: npt.ArrayLike, threshold: npt.ArrayLike, model: str = "book", law: str = "rice"
) -> FloatArray:
    """Rate of those excursions that last long enough.

    Source: Kuzmin 1967, (2.66), with "kuzmin"; see `long_excursions`.

    Args:
        duration: in pulse lengths, any shape.
        threshold: x_0, broadcast with it.
        model: "book" or "physical".
        law: "rice" or "kuzmin".

    Returns:
        Excursions per unit nu, of the broadcast shape.

    Raises:
        ValueError: the model or the law is unknown.
    """
    return crossing_rate(threshold, model) * long_excursions(duration, threshold, model, law)
