# SPDX-License-Identifier: Apache-2.0
"""Quantisation in amplitude (Kuzmin 1967, § 1.2.2, 2.2.2 and 2.3.4): levels, moments and the binary threshold."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from scipy.special import ndtr

from primary_proc.calculators.pulse.amplitude_laws import (
    AmplitudeLaw,
    envelope_law,
    rice_density,
    strong_signal_density,
    synchronous_law,
)
from primary_proc.calculators.pulse.single_pulse import (
    fluctuating_probability,
    steady_probability,
    threshold_for,
)
from primary_proc.calculators.quantisation.binary_threshold import (
    average_risk,
    information_kept,
    least_risk_threshold,
    most_information_threshold,
)
from primary_proc.calculators.quantisation.lloyd_max import lloyd_max
from primary_proc.calculators.quantisation.quantisation_loss import (
    multilevel_gain_db,
    weak_signal_loss_db,
)
from primary_proc.calculators.quantisation.surveillance_grid import SurveillanceGrid
from primary_proc.calculators.quantisation.uniform_quantiser import (
    characteristic_function,
    grouped_moments,
    sheppard_variance,
)
from radar_eval.published.result import Row, to_digits

_NORMAL, _RAYLEIGH = synchronous_law(0.0), envelope_law(0.0)
# Upper thresholds and outputs of the symmetric law; all of the other.
_LEVELS: dict[tuple[str, int], tuple[tuple[float, ...], tuple[float, ...], float]] = {
    ("normal", 2): ((0.0,), (0.7979,), 0.3634),
    ("normal", 4): ((0.0, 0.9816), (0.4528, 1.5104), 0.1175),
    ("normal", 8): ((0.0, 0.5005, 1.05, 1.7479), (0.2451, 0.756, 1.3439, 2.1519), 0.03455),
    ("Rayleigh", 2): ((1.3748,), (0.8292, 1.9204), 0.14629),
    ("Rayleigh", 4): (
        (0.8218, 1.4195, 2.1269),
        (0.5293, 1.1144, 1.7246, 2.5291),
        0.04473,
    ),
    ("Rayleigh", 8): (
        (0.4992, 0.8251, 1.1351, 1.4532, 1.8, 2.2082, 2.7597),
        (0.3286, 0.6697, 0.9805, 1.2898, 1.6166, 1.9835, 2.4329, 3.0864),
        0.01261,
    ),
}
_AMPLITUDES = (1.0, 2.0, 3.0, 4.0, 5.0)
_FLUCTUATING = (1.0, 2.0, 3.0)
_SINGLE_PULSE = {
    0.1: (2.146, (0.2177, 0.5423, 0.8545, 0.9786, 0.9987), (0.3162, 0.631, 0.7943)),
    0.05: (2.4477, (0.1327, 0.4154, 0.7707, 0.9567, 0.9965), (0.2236, 0.5493, 0.7411)),
    0.02: (2.7971, (0.0678, 0.2809, 0.6477, 0.9121, 0.9903), (0.1414, 0.4573, 0.6762)),
    0.01: (3.0349, (0.0404, 0.2039, 0.5533, 0.8666, 0.9819), (0.1, 0.3981, 0.631)),
    1e-3: (3.7169, (0.0069, 0.0627, 0.286, 0.6607, 0.9192), (0.0316, 0.2512, 0.5012)),
}
# Printed to four places; what happens to end in zeros is no less exact.
_PLACES = 0.51e-4


def level_quantisation() -> Iterator[Row]:
    """Compute what quantisation in amplitude does.

    Yields:
        Rows 1, 2, 5-7, 12-19, 22-24 of the chapter's numbers and the tables behind them.
    """
    grid = SurveillanceGrid(2e-6, 1.0 / 500.0, 10.0, 300e3)
    inside = 10.0 <= grid.pulses_in_burst(np.radians(1.5)) <= 250.0
    yield Row(
        "§ 1.2.2: N_0 of 500 Hz, 10 s, 1.5 deg lies in 10-250 (1 = yes)", 1.0, 1.0, float(inside), 0.0,
        "a statement about radars of its time, not checkable; the example of § 2.3.2 lies in it",
    )  # fmt: skip
    yield from _strong_signals()
    yield from _moments()
    yield from _optimum_levels()
    yield from _least_risk()
    yield from _information()
    yield from _single_pulses()
    yield from _multilevel_gain()


def _strong_signals() -> Iterator[Row]:
    for a, error, spread, bias in (
        (3.0, 0.068, 0.967, 0.173),
        (4.0, 0.05, 0.983, 0.127),
        (5.0, 0.04, 0.99, 0.101),
    ):
        x = np.linspace(0.0, a + 9.0, 20_001)
        exact, step = rice_density(x, a), x[1]
        ours = np.abs(1.0 - steady_probability(x, a) - ndtr(x - a)).max()
        yield Row(
            f"§ 1.2.2, (1.36): largest error of the normal law's distribution, a = {a:g}", 0.0, error, ours, 6e-4,
            "the book lets the factor be dropped from a = 3 to 5 on: a rough approximation, not an exact one",
        )  # fmt: skip
        mean = float(x @ exact * step)
        deviation = float(np.sqrt(np.square(x - mean) @ exact * step))
        yield Row(
            f"§ 1.2.2: standard deviation of the envelope, a = {a:g}", None, spread, deviation, 6e-4
        )
        yield Row(f"§ 1.2.2: bias of the envelope's mean, a = {a:g}", None, bias, mean - a, 6e-4)
        held = x > 0.3
        with_factor = np.abs(strong_signal_density(x[held], a) - exact[held]).max() / exact.max()
        yield Row(
            f"(1.36) with its factor: density right to 0.12 % of its peak, a = {a:g} (1 = yes)",
            None,
            1.0,
            float(with_factor <= 1.25e-3),
            0.0,
        )


def _moments() -> Iterator[Row]:
    for step, residual, tolerance in (
        (0.5, 0.0, 1e-14), (1.0, 1.1e-8, 1e-9), (1.5, 6.5e-4, 6e-6), (2.0, 0.032, 6e-4),
    ):  # fmt: skip
        ours = sheppard_variance(grouped_moments(_NORMAL, step)[1], step) - 1.0
        yield Row(
            f"§ 2.2.2, (2.15): variance that h^2 / 12 leaves over, normal law, h = {step:g}",
            None,
            residual,
            ours,
            tolerance,
        )
    grouped = grouped_moments(_NORMAL, 1.0)[1] - 1.0
    yield Row("§ 2.2.2: what the variance grows by at h = sigma", 1 / 12, 1 / 12, grouped, 2e-8)
    for frequency in (0.1, 0.3, 0.5):
        ours = float(abs(characteristic_function(_NORMAL, frequency)))
        formula = float(np.exp(-2.0 * np.square(np.pi * frequency)))
        yield Row(
            f"§ 2.2.2, (2.16): spectrum of the normal law at f = {frequency:g}",
            formula,
            formula,
            ours,
            1e-12,
        )
    at_step = float(abs(characteristic_function(_NORMAL, 0.5)))
    yield Row("§ 2.2.2: what the spectrum has fallen to for h = sigma", None, 0.0072, at_step, 6e-5)


def _optimum_levels() -> Iterator[Row]:
    laws: dict[str, AmplitudeLaw] = {"normal": _NORMAL, "Rayleigh": _RAYLEIGH}
    distortion = {}
    for (name, levels), (thresholds, outputs, least) in _LEVELS.items():
        ours = lloyd_max(laws[name].density, laws[name].support, levels)
        distortion[name, levels] = ours.distortion
        label = f"§ 2.2.2, (2.8)-(2.13), {name} law, {levels} levels"
        for kind, values, found in (
            ("threshold", thresholds, ours.thresholds[-len(thresholds) :]),
            ("output", outputs, ours.outputs[-len(outputs) :]),
        ):
            for value, one in zip(values, found, strict=True):
                yield Row(f"{label}: {kind} {value:g}", None, value, float(one), _PLACES)
        yield Row(f"{label}: distortion", None, least, ours.distortion, to_digits(least))
    for name in laws:
        first = distortion[name, 4] / distortion[name, 2]
        second = distortion[name, 8] / distortion[name, 4]
        yield Row(
            f"§ 2.3.4: error falls exponentially with the levels, {name} law (1 = yes)", 1.0, 0.0,
            float(abs(second / first**2 - 1.0) < 0.1), 0.0,
            "each doubling of the levels divides it by 3.1 to 3.6: a power of their number, exponential in bits",
        )  # fmt: skip


def _least_risk() -> Iterator[Row]:
    weak = least_risk_threshold(0.01)
    yield Row("§ 2.3.4, (2.35): x_opt of a weak signal", float(np.sqrt(2.0)), 1.4142, weak, _PLACES)
    for a, printed, expected, risk, fixed in (
        (1.0, 1.5, 1.502, 0.4183, 0.4332),
        (2.0, 1.75, 1.7509, 0.2566, 0.2659),
        (3.0, 2.1, 2.1063, 0.1225, 0.1243),
        (4.0, 2.5, 2.515, 0.0462, 0.075),
    ):
        best = least_risk_threshold(a)
        finding = "read from a curve to a digit or two" if abs(printed - expected) > 5e-3 else ""
        yield Row(f"§ 2.3.4, (2.35): x_opt, a = {a:g}", printed, expected, best, _PLACES, finding)
        yield Row(
            f"§ 2.3.4, (2.33): least risk, a = {a:g}",
            None,
            risk,
            float(average_risk(best, a)),
            _PLACES,
        )
        at_two = float(average_risk(2.0, a))
        yield Row(f"§ 2.3.4, (2.33): risk at x_0 = 2, a = {a:g}", None, fixed, at_two, _PLACES)
    yield Row(
        "§ 2.3.4: a fixed threshold of 1.8-2.2 will do: risk at x_0 = 2 over the least, a = 4", 1.0, 1.62,
        float(average_risk(2.0, 4.0) / average_risk(least_risk_threshold(4.0), 4.0)), 6e-3,
        "true for a = 2 to 3, where it is below 1.04; from a = 4 on the threshold must follow the signal",
    )  # fmt: skip
    yield Row("(2.35): x_opt, a = 10", None, 5.29, least_risk_threshold(10.0), 6e-4)


def _information() -> Iterator[Row]:
    for a, expected in ((0.5, 1.771), (1.0, 1.762), (2.0, 1.874), (3.0, 2.155), (4.0, 2.534)):
        ours = most_information_threshold(a)
        yield Row(f"§ 2.3.4, (2.32): x_opt of an envelope, a = {a:g}", None, expected, ours, 6e-4)
        synchronous = [
            choose(a, law="synchronous")
            for choose in (most_information_threshold, least_risk_threshold)
        ]
        for name, value in zip(("(2.32)", "(2.34)"), synchronous, strict=True):
            yield Row(
                f"§ 2.3.4, {name}: x_opt of a synchronous detector, a = {a:g}",
                a / 2.0,
                a / 2.0,
                value,
                1e-5,
            )
    for a, expected in ((1.0, 0.26), (3.0, 0.049), (4.0, 0.019)):
        ours = most_information_threshold(a) - least_risk_threshold(a)
        yield Row(
            f"§ 2.3.4: both criteria give one threshold, difference at a = {a:g}", 0.0, expected, ours, 6e-4,
            "they come within 0.05 of each other from a = 3 on",
        )  # fmt: skip
    for a, envelope, synchronous_share in ((2.0, 0.73, 0.76), (3.0, 0.8, 0.85), (4.0, 0.88, 0.92)):
        for law, share in (("envelope", envelope), ("synchronous", synchronous_share)):
            yield Row(
                f"§ 2.3.4: binary quantisation keeps all information, {law}, a = {a:g}", 1.0, share,
                information_kept(a, law=law), 6e-3,
                "of the information about the signal's presence a fifth to a quarter is lost at a = 2 to 3",
            )  # fmt: skip


def _single_pulses() -> Iterator[Row]:
    for probability, (threshold, steady, fast) in _SINGLE_PULSE.items():
        x = float(threshold_for(probability))
        label = f"§ 2.3.4, p_N = {probability:g}"
        yield Row(f"{label}, (2.36): x_0", None, threshold, x, _PLACES)
        for a, expected in zip(_AMPLITUDES, steady, strict=True):
            yield Row(
                f"{label}, (2.37): p_S, a = {a:g}",
                None,
                expected,
                float(steady_probability(x, a)),
                _PLACES,
            )
        for k, expected in zip(_FLUCTUATING, fast, strict=True):
            yield Row(
                f"{label}: p_S, fast, k = {k:g}",
                None,
                expected,
                float(fluctuating_probability(x, k)),
                _PLACES,
            )
    for a, expected in zip(_AMPLITUDES, (0.269, 0.6035, 0.8867, 0.9853, 0.9992), strict=True):
        ours = float(steady_probability(2.0, a))
        yield Row(f"§ 2.3.4, x_0 = 2, (2.37): p_S, a = {a:g}", None, expected, ours, _PLACES)


def _multilevel_gain() -> Iterator[Row]:
    for pulses, expected in ((10, 1.03), (16, 1.04), (20, 1.03), (50, 1.01), (100, 1.0)):
        yield Row(
            f"§ 2.3.4: most that levels gain over binary, dB, N = {pulses}, P_fa = 1e-5, P_d = 0.5", 1.0, expected,
            multilevel_gain_db(pulses, 1e-5), 6e-3, "the book's \"not over 1 dB\" is a round number",
        )  # fmt: skip
    best = most_information_threshold(0.01)
    yield Row("§ 2.3.4: the same for weak signals, x_0 = 1.785", 1.0, 0.943, weak_signal_loss_db([best]), 6e-4,
              "the book's \"not over 1 dB\" is a round number")  # fmt: skip
