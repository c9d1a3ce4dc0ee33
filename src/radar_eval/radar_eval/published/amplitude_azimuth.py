# SPDX-License-Identifier: Apache-2.0
"""Azimuth from the amplitudes of a burst, and how well it can be known (Kuzmin 1967, § 1.4.3)."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from primary_proc.calculators.azimuth.amplitude_accuracy import swerling_bound, unquantised_bound
from radar_eval.published.azimuth_trials import FloatArray, amplitude_errors
from radar_eval.published.result import Row, to_digits

_BOUNDS = {
    ("steady", "gaussian"): {3.0: 0.0942, 10.0: 0.02825, 30.0: 0.00942},
    ("steady", "exact"): {3.0: 0.1133, 5.0: 0.0617, 10.0: 0.02912, 30.0: 0.00946},
    ("fast", "exact"): {1.0: 0.3528, 3.0: 0.1125, 10.0: 0.0601},
}
_ZERO_CROSSING = {5.0: 0.062, 10.0: 0.0288, 20.0: 0.0141}
_EXPONENTS = {
    (3.0, 2.0): 0.081, (3.0, 1.0): 0.091, (3.0, 0.5): 0.103,
    (10.0, 2.0): 0.043, (10.0, 1.0): 0.065, (10.0, 0.5): 0.084,
}  # fmt: skip
_TRIALS_AGREE = 0.04
_PRINTED_STEADY = (
    "a_0 is a voltage ratio everywhere else in the book; (1.76) holds for power ratios, a_0^2 / 2"
)
_PRINTED_FAST = "holds if g is the power pattern and k_0 stands for the power ratio k_0^2 of (1.39)"


def amplitude_azimuth() -> Iterator[Row]:
    """Compute bounds and simulated errors, Gaussian pattern.

    Yields:
        (1.76) and (1.77) as printed and as they must be read, the bounds by the discrete sum of the information, and
        the errors of the zero crossings (1.72) and (1.74).
    """
    scale = np.sqrt(20.0)
    yield Row(
        "(1.76), amplitude pattern exp(-alpha^2): sigma a_0 sqrt(N_0) / phi", 0.8932, 1.2632,
        float(swerling_bound("gaussian", 20, 1.0)) * scale, to_digits(1.2632), _PRINTED_STEADY,
    )  # fmt: skip
    yield Row(
        "(1.76) taken literally, amplitude pattern exp(-alpha^2)", 0.8932, 0.8932,
        float(swerling_bound("gaussian", 20, 1.0, printed=True)) * scale, to_digits(0.8932),
    )  # fmt: skip
    # The pattern exp(-alpha^2 / 2) is the same beam with phi and N_0 a root of two smaller.
    root = np.sqrt(2.0)
    for printed, expected in ((False, 1.5023), (True, 1.0623)):
        yield Row(
            f"(1.76){' taken literally' if printed else ''}, power pattern exp(-alpha^2)", 1.0623, expected,
            float(swerling_bound("gaussian", 20 * root, 1.0, printed=printed)) * scale * root,
            to_digits(1.5023), "" if printed else _PRINTED_STEADY,
        )  # fmt: skip
    for strength, expected in _BOUNDS["fast", "exact"].items():
        literal = float(swerling_bound("gaussian", 20, strength, "fast", printed=True))
        ours = float(swerling_bound("gaussian", 20, strength, "fast"))
        label = f"(1.77), N_0 = 20, k_0 = {strength:g}: sigma in phi"
        differs = abs(literal - expected) > to_digits(expected)
        yield Row(
            label, literal, expected, ours, to_digits(expected), _PRINTED_FAST if differs else ""
        )
    for (fluctuation, model), points in _BOUNDS.items():
        for strength, expected in points.items():
            ours = float(unquantised_bound("gaussian", 20, strength, fluctuation, model=model))
            law = "Rayleigh" if fluctuation == "fast" else "Rice" if model == "exact" else "(1.69)"
            label = f"sum of the information, {law}, N_0 = 20, strength {strength:g}: sigma in phi"
            yield Row(label, None, expected, ours, to_digits(expected))
    yield from _trials()


def _trials() -> Iterator[Row]:
    for strength, expected in _ZERO_CROSSING.items():
        error = amplitude_errors(20, strength, _pattern)
        ours, tolerance = float(error.std()), _TRIALS_AGREE * expected
        label = f"(1.72) simulated, N_0 = 20, a_0 = {strength:g}: sigma in phi"
        yield Row(label, None, expected, ours, tolerance)
        bias = float(error.mean())
        yield Row(f"(1.72) simulated, a_0 = {strength:g}: bias in phi", None, 0.0, bias, 3e-3)
    for (strength, exponent), expected in _EXPONENTS.items():
        ours = float(amplitude_errors(40, strength, _POTENTIALS[exponent], fast=True).std())
        printed = 0.5 if exponent == 0.5 else None
        yield Row(
            f"(1.74)-(1.75) simulated, N_0 = 40, k_0 = {strength:g}, exponent {exponent:g}: sigma in phi",
            None, expected, ours, _TRIALS_AGREE * expected,
            "the exponent 1/2 as printed is a misprint of 2, which alone comes near the bound" if printed else "",
        )  # fmt: skip
    for strength, expected in ((3.0, 0.0796), (10.0, 0.0425)):
        ours = float(unquantised_bound("gaussian", 40, strength, "fast"))
        label = f"sum of the information, Rayleigh, N_0 = 40, k_0 = {strength:g}: sigma in phi"
        yield Row(label, None, expected, ours, to_digits(expected))


def _pattern(strength: FloatArray, shape: FloatArray) -> FloatArray:
    return np.broadcast_to(shape, np.broadcast_shapes(strength.shape, shape.shape))


def _squared(strength: FloatArray, shape: FloatArray) -> FloatArray:
    return -1.0 / (2.0 * strength**2 * (1.0 + (strength * shape) ** 2))


def _first(strength: FloatArray, shape: FloatArray) -> FloatArray:
    return np.log1p((strength * shape) ** 2) / (2.0 * strength**2)


def _root(strength: FloatArray, shape: FloatArray) -> FloatArray:
    return np.sqrt(1.0 + (strength * shape) ** 2) / strength**2


_POTENTIALS = {2.0: _squared, 1.0: _first, 0.5: _root}
