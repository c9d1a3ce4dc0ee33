# SPDX-License-Identifier: Apache-2.0
"""Azimuth accuracy of the binary detectors (Kuzmin 1967, § 3.3.6, figures 3.28-3.30)."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from primary_proc.automata.accumulator import Accumulator
from primary_proc.automata.automaton_chain import StartEnd, start_end_distribution
from primary_proc.automata.burst_rule import BurstRule
from primary_proc.automata.program import Program
from primary_proc.calculators.azimuth.azimuth_accuracy import AzimuthError, azimuth_error, error_of
from primary_proc.calculators.azimuth.potential_accuracy import quantised_bound
from primary_proc.calculators.bursts.false_alarms import noise_probability
from primary_proc.calculators.pulse.burst_shape import burst_shape
from primary_proc.calculators.pulse.single_pulse import steady_probability, threshold_for
from radar_eval.published.result import Row

_PULSES = 11
_AMPLITUDES = (2.0, 3.0, 4.0)
_BEST = Program(3, 4, 2)
# Sigma in steps, N_0 = 11, at each amplitude: (3.103), the automaton with ends up to N_0 + k, and without that limit.
_SIGMA = {
    (4e-3, "3/3-2"): ((1.37, 1.35, 1.45), (0.96, 0.96, 1.08), (0.77, 0.79, 0.93)),
    (4e-3, "4/4-2"): ((1.41, 1.37, 1.65), (1.00, 0.98, 1.30), (0.84, 0.83, 1.19)),
    (4e-3, "4/4-3"): ((1.33, 1.27, 2.27), (0.97, 0.94, 2.07), (0.84, 0.81, 2.02)),
    (4e-3, "3/4-2"): ((1.40, 1.38, 1.44), (0.95, 0.97, 1.02), (0.75, 0.78, 0.85)),
    (2e-4, "3/3-2"): ((1.02, 1.03, 1.04), (0.76, 0.78, 0.80), (0.62, 0.65, 0.67)),
    (2e-4, "4/4-2"): ((1.06, 1.06, 1.12), (0.77, 0.79, 0.86), (0.65, 0.68, 0.76)),
    (2e-4, "4/4-3"): ((1.06, 1.05, 1.30), (0.79, 0.81, 1.11), (0.68, 0.71, 1.04)),
    (2e-4, "3/4-2"): ((1.08, 1.08, 1.09), (0.79, 0.80, 0.81), (0.61, 0.64, 0.65)),
}
_FORMS = ("(3.103)", "automaton, ends up to N_0 + k", "automaton")
_SIGMA_OF_15 = (1.86, 1.30, 1.02)
_FIRST_ONE = {2: (1.37, 1.16, 0.96, 0.87), 3: (1.34, 1.12, 0.89, 0.80)}
_BIAS = {
    "3/3-1": (1.41, 1.46, 1.46),
    "4/4-1": (1.85, 1.94, 1.96),
    "3/3-2": (2.25, 2.32, 2.30),
    "3/3-3": (3.18, 3.23, 3.19),
    "4/4-2": (2.92, 3.01, 3.00),
    "4/4-3": (4.27, 4.33, 4.31),
}
_OVER_BOUND = {2.0: 0.13, 2.5: 0.26, 3.0: 0.33, 4.0: 0.41, 5.0: 0.47}
_TOLERANCE = 6e-3
_SYMMETRIC = "symmetric as the book says; counting bursts by their declaration drops some late ones"
_SOFT_END = "the end is softer than the start; the book counts what is left as random error"


def azimuth_accuracies() -> Iterator[Row]:
    """Compute spread, bias and number of starts.

    Yields:
        The book's example, sigma and bias of programs and accumulators, and what the book concludes from them.
    """
    start, end, pulses = 4, 13, _PULSES
    example = StartEnd(np.ones((1, 1)), np.array([start]), np.array([end]))
    ours = float(error_of(example, pulses).bias)
    yield Row("start 4, end 13, N_0 = 11: error in steps, (3.95)", 2.5, 2.5, ours, 1e-12)
    for (false_alarm, name), values in _SIGMA.items():
        for amplitude, three in zip(_AMPLITUDES, values, strict=True):
            for form, expected in zip(_FORMS, three, strict=True):
                label = (
                    f"{name}, P_fa = {false_alarm:g}, a_0 = {amplitude:g}: sigma in steps, {form}"
                )
                ours = float(_error(name, false_alarm, amplitude, form=form).std)
                yield Row(label, None, expected, ours, _TOLERANCE)
    for amplitude, expected in zip(_AMPLITUDES, _SIGMA_OF_15, strict=True):
        ours = float(_error("3/4-2", 4e-3, amplitude, pulses=15, form="(3.103)").std)
        label = f"3/4-2, P_fa = 0.004, a_0 = {amplitude:g}, N_0 = 15: sigma in steps, (3.103)"
        yield Row(label, None, expected, ours, _TOLERANCE)
    for zeros, several in _FIRST_ONE.items():
        rule = Accumulator(5, zeros, from_first_one=True, capacity=16)
        for amplitude, expected in zip((2.5, 3.0, 4.0, 5.0), several, strict=True):
            ours = float(_counted_error(rule, amplitude).std)
            label = f"{rule}, P_fa = 0.004, a_0 = {amplitude:g}: sigma in steps, automaton"
            yield Row(label, None, expected, ours, _TOLERANCE)
    yield from _biases()
    yield from _numbers_of_starts()
    yield from _conclusions()


def _biases() -> Iterator[Row]:
    for zeros in (2, 3):
        rule = Accumulator(5, zeros, from_first_one=True)
        ours = float(_counted_error(rule, 3.0).bias) - (rule.threshold - 1) / 2.0
        yield Row(f"{rule}: bias in steps, k / 2", zeros / 2.0, zeros / 2.0, ours, 1e-6)
    for name, values in _BIAS.items():
        program = Program.parse(name)
        symmetric = program.zeros == 1
        model = "exact" if symmetric else "kuzmin"
        for amplitude, expected in zip(_AMPLITUDES, values, strict=True):
            ours = float(_rule_error(program, 4e-3, amplitude, model).bias)
            yield Row(
                f"{name}, P_fa = 0.004, a_0 = {amplitude:g}: bias in steps, (m + k - 1) / 2",
                program.nominal_bias, expected, ours, _TOLERANCE,
                _SYMMETRIC if symmetric else _SOFT_END,
            )  # fmt: skip
    ours = float(_rule_error(_BEST, 4e-3, 3.0, "kuzmin").bias)
    yield Row(
        "3/4-2, P_fa = 0.004, a_0 = 3: bias in steps", 2.5, 2.176, ours, 2e-3,
        "(m + k - 1)/2 counts m positions up to the start, but 3/4-2 mostly starts on three ones in a row: l = 3 "
        "belongs in the place of m",
    )  # fmt: skip
    yield Row("3/4-2: nominal bias with l for m, in steps", None, 2.0, _BEST.nominal_bias, 1e-12)
    left = _rule_error(Program(4, 4, 3), 4e-3, 3.0, "kuzmin")
    ours = (float(left.bias) - 3.0) / float(left.std)
    yield Row(
        "4/4-3, P_fa = 0.004, a_0 = 3: bias left by (m + k - 1) / 2, of sigma", 1.0, 0.643, ours,
        2e-3, "it comes near sigma, as the book says; the exact chain has a larger sigma",
    )  # fmt: skip


def _numbers_of_starts() -> Iterator[Row]:
    ours = float(_rule_error(_BEST, 4e-3, 3.0, "kuzmin").bursts)
    yield Row("3/4-2, P_fa = 0.004, a_0 = 3: starts a burst", None, 0.89, ours, _TOLERANCE)
    several = [
        float(_error("3/4-2", 4e-3, 2.5, pulses=15, pattern="gaussian", form=form).bursts)
        for form in ("(3.103)", "automaton")
    ]
    yield Row(
        "Gaussian pattern, N_0 = 15, a_0 = 2.5: starts a burst can exceed one (1 = yes)", 1.0, 1.0,
        float(min(several) > 1.0), 0.0,
    )  # fmt: skip


def _conclusions() -> Iterator[Row]:
    names = ("3/3-2", "4/4-2", "4/4-3", "3/4-2")
    for amplitude in (3.0, 4.0):
        sigma = {name: float(_error(name, 4e-3, amplitude, form="(3.103)").std) for name in names}
        at = f"P_fa = 0.004, a_0 = {amplitude:g}, (3.103)"
        best = min(sigma, key=lambda name: sigma[name])
        yield Row(
            f"{at}: 3/4-2 is the most accurate of the four (1 = yes)",
            1.0,
            1.0,
            best == "3/4-2",
            0.0,
        )
        spread = max(sigma.values()) / min(sigma.values())
        yield Row(
            f"{at}: largest over smallest sigma, little over 1",
            None,
            1.05 if amplitude == 3.0 else 1.12,
            spread,
            0.02,
        )
        strict = float(_error("3/4-2", 2e-4, amplitude, form="(3.103)").std)
        yield Row(
            f"{at}: a higher threshold makes sigma smaller (1 = yes)",
            1.0,
            1.0,
            strict < sigma["3/4-2"],
            0.0,
        )
    more = float(_error("3/4-2", 4e-3, 3.0, pulses=15, form="(3.103)").std)
    fewer = float(_error("3/4-2", 4e-3, 3.0, form="(3.103)").std)
    yield Row("3/4-2, a_0 = 3: sigma of 15 pulses over that of 11", None, 1.37, more / fewer, 0.01)
    threshold = float(threshold_for(noise_probability(_BEST, 4e-3, "kuzmin")))
    for amplitude, expected in _OVER_BOUND.items():
        bound = float(quantised_bound("sinc2", _PULSES, 2.0, amplitude))
        ours = float(_rule_error(_BEST, 4e-3, amplitude, "kuzmin").std) / bound - 1.0
        yield Row(
            f"3/4-2, P_fa = 0.004, x_0 = {threshold:.2f}, a_0 = {amplitude:g}: sigma over the potential one, less 1",
            0.35, expected, ours, 0.012,
            "the book says 30 to 40 %; the exact automaton is from 13 to 47 % worse, the more the stronger the signal",
        )  # fmt: skip


def _error(
    name: str,
    false_alarm: float,
    amplitude: float,
    *,
    pulses: int = _PULSES,
    pattern: str = "sinc2",
    form: str = "automaton",
) -> AzimuthError:
    program = Program.parse(name)
    noise = noise_probability(program, false_alarm, "kuzmin")
    signal = steady_probability(threshold_for(noise), amplitude * burst_shape(pattern, pulses))
    if form == "(3.103)":
        return azimuth_error(program, noise, signal, model="kuzmin")
    joint = start_end_distribution(program.automaton, noise, signal)
    if form != "automaton":
        last = pulses + program.zeros
        joint = StartEnd(joint.probability[:, :last], joint.start, joint.end[:last])
    return error_of(joint, pulses)


def _counted_error(rule: Accumulator, amplitude: float) -> AzimuthError:
    """Error over the counts that overlap the target and reach at most three positions beyond it on either side."""
    noise = noise_probability(rule, 4e-3)
    signal = steady_probability(threshold_for(noise), amplitude * burst_shape("sinc2", _PULSES))
    counted = rule.threshold - 1
    longer = np.append(signal, np.full(counted, noise))
    joint = start_end_distribution(rule.automaton, noise, longer)
    first, last = joint.start - counted, joint.end - rule.zeros
    taken = np.outer(first >= -2, (last >= 1) & (last <= _PULSES + 3))
    return error_of(StartEnd(joint.probability * taken, joint.start, joint.end), _PULSES)


def _rule_error(rule: BurstRule, false_alarm: float, amplitude: float, model: str) -> AzimuthError:
    """Error of the automaton itself, its first threshold set for the rate in either model."""
    noise = noise_probability(rule, false_alarm, model)
    signal = steady_probability(threshold_for(noise), amplitude * burst_shape("sinc2", _PULSES))
    return azimuth_error(rule, noise, signal)
