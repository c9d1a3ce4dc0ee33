# SPDX-License-Identifier: Apache-2.0
"""Detection of a Gaussian pulse in noise within a time gate: crossings of a threshold by a signal that moves.

Time is nu, in pulse lengths from the pulse's middle. For the models see `noise_excursions`.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import numpy.typing as npt
from scipy.special import ive, ndtr

from primary_proc.calculators.pulse.gauss_rule import gauss_rule
from primary_proc.calculators.pulse.single_pulse import steady_probability
from primary_proc.calculators.quantisation.noise_excursions import crossing_rate, video_model

FloatArray = npt.NDArray[np.float64]

_ANGLES = 256
_TERMS = 60
_NODES = 48


def crossing_correction(
    kappa: npt.ArrayLike, slope: npt.ArrayLike, form: str = "integral"
) -> FloatArray:
    """Factor M by which the movement of the signal changes the rate of crossings.

    Source: Kuzmin 1967, (2.71) for "series", with the lost numerator I_(n-1) restored; (2.72) for "short", for
    z^2 < 0.4; "integral" is the mean over the angle between signal and envelope, of which the series is made.

    Args:
        kappa: a_nu x_0, any shape.
        slope: z = a'_nu / delta-omega, positive where the pulse rises; broadcast with it.
        form: "integral", "series" or "short".

    Returns:
        M, of the broadcast shape.

    Raises:
        ValueError: there is no such form.
    """
    if form not in _FORMS:
        raise ValueError(f"form {form!r} is none of {', '.join(_FORMS)}")
    both = np.broadcast_arrays(np.asarray(kappa, dtype=float), np.asarray(slope, dtype=float))
    return _FORMS[form](*both)


def pulse_crossing_rate(
    nu: npt.ArrayLike,
    signal: float,
    threshold: float,
    model: str = "book",
    form: str = "integral",
) -> FloatArray:
    """Mean number of times per pulse length that the envelope of pulse and noise rises over a threshold.

    Source: Kuzmin 1967, (2.67), (2.69)-(2.72).

    Args:
        nu: time, any shape.
        signal: a_0 of the pulse's middle.
        threshold: x_0.
        model: "book" or "physical".
        form: of the correction, see `crossing_correction`.

    Returns:
        Up-crossings per unit nu, same shape.

    Raises:
        ValueError: the model or the form is unknown.
    """
    response, time = video_model(model), np.asarray(nu, dtype=float)
    amplitude = signal * response.echo(time)
    kappa = amplitude * threshold
    standing = np.exp(kappa - np.square(amplitude) / 2.0) * ive(0, kappa)
    slope = signal * response.slope(time) / response.bandwidth
    return crossing_rate(threshold, model) * standing * crossing_correction(kappa, slope, form)


def detection_in_gate(
    start: float,
    gate: float,
    signal: float,
    threshold: float,
    *,
    model: str = "book",
    form: str = "hazard",
    reference: float | None = None,
) -> float:
    """Probability that the envelope is over a threshold anywhere within a gate.

    "poisson" counts crossings as if none excluded another; where the envelope is mostly over the threshold that is too
    few of them, and a longer gate can even seem to detect less. "hazard" takes their rate among envelopes that are
    below, and is within 6 % of simulated video.

    Source: Kuzmin 1967, (2.45)-(2.56), (2.68) for "poisson".

    Args:
        start: nu at which the gate begins.
        gate: its length in pulse lengths.
        signal: a_0 of the pulse's middle, 0 for noise.
        threshold: x_0.
        model: "book" or "physical".
        form: "hazard" or "poisson".
        reference: nu at which the probability is taken that crossings add to; the start if not given, as derived.

    Returns:
        Probability.

    Raises:
        ValueError: the model or the form is unknown.
    """
    if form not in ("hazard", "poisson"):
        raise ValueError(f"form {form!r} is neither hazard nor poisson")
    response = video_model(model)
    nu, weight = gauss_rule(start, start + gate, _NODES)
    rate = pulse_crossing_rate(nu, signal, threshold, model)
    if form == "hazard":
        rate = rate / (1.0 - steady_probability(threshold, signal * response.echo(nu)))
    crossings = float(np.sum(rate * weight))
    first = np.asarray(start if reference is None else reference)
    already = float(steady_probability(threshold, signal * response.echo(first)))
    return float(already + (1.0 - already) * -np.expm1(-crossings))


def detection_in_gates(probabilities: npt.ArrayLike) -> FloatArray:
    """Probability that a pulse is detected in at least one of the gates that it reaches.

    Source: Kuzmin 1967, (2.73).

    Args:
        probabilities: of each gate, shape (..., gates).

    Returns:
        Probability, shape (...).
    """
    return np.asarray(1.0 - np.prod(1.0 - np.asarray(probabilities, dtype=float), axis=-1))


def _integral(kappa: FloatArray, z: FloatArray) -> FloatArray:
    # Periodic, so equal steps converge faster than any power of their number.
    cosine = np.cos(2.0 * np.pi * np.arange(_ANGLES) / _ANGLES)
    weight = np.exp(kappa[..., None] * (cosine - 1.0)) / ive(0, kappa)[..., None] / _ANGLES
    along = z[..., None] * cosine
    rise = np.exp(-np.square(along) / 2.0) + np.sqrt(2.0 * np.pi) * along * ndtr(along)
    return np.asarray(np.sum(weight * rise, axis=-1))


def _series(kappa: FloatArray, z: FloatArray) -> FloatArray:
    n = np.arange(1, _TERMS + 1)
    square = np.square(z)[..., None]
    quarter = square / 4.0
    ratio = ive(2 * n, kappa[..., None]) / ive(0, kappa)[..., None]
    # ive carries the factor exp(-z^2 / 4) that stands before the braces.
    main = 2.0 * ive(n, quarter) * (1.0 - square / (2.0 * (4.0 * np.square(n) - 1.0)))
    side = ive(n - 1, quarter) / (2 * n - 1) - ive(n + 1, quarter) / (2 * n + 1)
    terms = (-1.0) ** n * ratio * (main - square / 2.0 * side)
    quarter, square = quarter[..., 0], square[..., 0]
    even = ive(0, quarter) + square / 2.0 * (ive(0, quarter) + ive(1, quarter))
    return np.asarray(_odd(kappa, z) + even + terms.sum(axis=-1))


def _short(kappa: FloatArray, z: FloatArray) -> FloatArray:
    return np.asarray(1.0 + np.square(z) / 2.0 + _odd(kappa, z))


def _odd(kappa: FloatArray, z: FloatArray) -> FloatArray:
    return np.asarray(np.sqrt(np.pi / 2.0) * z * ive(1, kappa) / ive(0, kappa))


_FORMS: dict[str, Callable[[FloatArray, FloatArray], FloatArray]] = {
    "integral": _integral,
    "series": _series,
    "short": _short,
}
