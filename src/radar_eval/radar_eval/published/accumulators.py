# SPDX-License-Identifier: Apache-2.0
"""Accumulators in noise and on targets (Kuzmin 1967, § 3.3.2-3.3.5, (3.47)-(3.63), (3.77)-(3.87), figure 3.19)."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import numpy.typing as npt

from primary_proc.automata.accumulator import Accumulator
from primary_proc.automata.book_chain import BookChain, book_chain, zero_runs
from primary_proc.automata.program import Program
from primary_proc.calculators.bursts.accumulator_noise import unlimited_false_starts
from primary_proc.calculators.bursts.detection_probability import detection_probability
from primary_proc.calculators.bursts.false_alarms import false_start_probability, noise_probability
from primary_proc.calculators.pulse.burst_shape import burst_shape
from primary_proc.calculators.pulse.single_pulse import steady_probability, threshold_for
from radar_eval.published.result import Row, to_digits

FloatArray = npt.NDArray[np.float64]

_CAPACITY = 16
# Figure 3.19 as a table: k, p_N, L, from the first one, the book's chain, the automaton itself.
_FALSE_STARTS = (
    (2, 0.05, 5, False, 4.287e-5, 1.319e-3), (2, 0.05, 6, False, 4.180e-6, 2.253e-4),
    (2, 0.05, 5, True, 4.192e-5, 3.272e-4), (2, 0.05, 6, True, 4.088e-6, 1.286e-4),
    (2, 0.10, 5, False, 5.832e-4, 5.376e-3), (2, 0.10, 6, False, 1.108e-4, 1.612e-3),
    (2, 0.10, 5, True, 5.606e-4, 2.268e-3), (2, 0.10, 6, True, 1.065e-4, 1.021e-3),
    (2, 0.20, 5, False, 6.555e-3, 2.059e-2), (2, 0.20, 6, False, 2.360e-3, 1.004e-2),
    (2, 0.20, 5, True, 6.169e-3, 1.331e-2), (2, 0.20, 6, True, 2.221e-3, 7.414e-3),
    (3, 0.05, 5, False, 9.163e-4, 1.710e-2), (3, 0.05, 6, False, 1.307e-4, 4.214e-3),
    (3, 0.05, 5, True, 8.781e-4, 4.276e-3), (3, 0.05, 6, True, 1.252e-4, 2.439e-3),
    (3, 0.10, 5, False, 5.903e-3, 3.368e-2), (3, 0.10, 6, False, 1.600e-3, 1.407e-2),
    (3, 0.10, 5, True, 5.492e-3, 1.444e-2), (3, 0.10, 6, True, 1.488e-3, 9.127e-3),
    (3, 0.20, 5, False, 2.940e-2, 5.957e-2), (3, 0.20, 6, False, 1.435e-2, 3.803e-2),
    (3, 0.20, 5, True, 2.660e-2, 3.955e-2), (3, 0.20, 6, True, 1.298e-2, 2.905e-2),
)  # fmt: skip
# L = 5: k, from the first one, P_fa, p_N by the book's chain, by the automaton.
_INVERSE = (
    (2, False, 4e-3, 0.1723, 0.0863), (2, False, 2e-4, 0.0750, 0.0197),
    (3, False, 4e-3, 0.0860, 0.0119), (3, False, 2e-4, 0.0292, 0.0006),
    (2, True, 4e-3, 0.1753, 0.1237), (2, True, 2e-4, 0.0756, 0.0421),
    (3, True, 4e-3, 0.0883, 0.0482), (3, True, 2e-4, 0.0295, 0.0102),
)  # fmt: skip
_AMPLITUDES = (1.0, 1.5, 2.0, 2.5, 3.0, 4.0)
# L = 5, k = 2, N_0 = 11: from the first one, P_fa, model, detection probability.
_DETECTION = (
    (False, 4e-3, "kuzmin", (0.109, 0.246, 0.478, 0.720, 0.882, 0.988)),
    (True, 4e-3, "kuzmin", (0.106, 0.232, 0.447, 0.684, 0.857, 0.983)),
    (False, 4e-3, "exact", (0.092, 0.184, 0.351, 0.568, 0.767, 0.961)),
    (True, 4e-3, "exact", (0.098, 0.201, 0.379, 0.599, 0.788, 0.966)),
    (False, 2e-4, "kuzmin", (0.011, 0.046, 0.163, 0.390, 0.650, 0.938)),
    (True, 2e-4, "kuzmin", (0.010, 0.041, 0.139, 0.339, 0.590, 0.915)),
    (False, 2e-4, "exact", (0.007, 0.023, 0.073, 0.187, 0.380, 0.789)),
    (True, 2e-4, "exact", (0.009, 0.030, 0.096, 0.239, 0.452, 0.835)),
)
_TOLERANCE = 1.1e-3


def accumulators() -> Iterator[Row]:
    """Compute the accumulators.

    Yields:
        Limiting probabilities of single states, false starts of both models and thresholds for them, the recurrences
        on a target, detection probabilities, and what the book concludes from them.
    """
    yield from _single_states()
    for zeros, noise, threshold, from_one, book, exact in _FALSE_STARTS:
        rule = Accumulator(threshold, zeros, from_one, _CAPACITY)
        at = f"{rule}, p_N = {noise:g}: P_fa"
        ours = false_start_probability(rule, noise, "kuzmin")
        yield Row(f"{at}, book's chain with M = 16", None, book, ours, to_digits(book))
        ours = false_start_probability(rule, noise)
        yield Row(f"{at}, automaton itself", None, exact, ours, to_digits(exact))
    for threshold in (5, 6):
        rule = Accumulator(threshold, 2, from_first_one=False)
        unlimited = unlimited_false_starts(rule, 0.1)
        ours = false_start_probability(rule, 0.1)
        yield Row(f"{rule}, p_N = 0.1: P_0 u_L against the automaton", None, unlimited, ours, 1e-12)
    for zeros, from_one, false_alarm, book, exact in _INVERSE:
        rule = Accumulator(5, zeros, from_one, _CAPACITY)
        at = f"{rule} at P_fa = {false_alarm:g}: p_N"
        for model, expected in (("kuzmin", book), ("exact", exact)):
            ours = noise_probability(rule, false_alarm, model)
            yield Row(f"{at}, {model}", None, expected, ours, to_digits(expected))
    yield from _recurrences()
    for from_one, false_alarm, model, values in _DETECTION:
        rule = Accumulator(5, 2, from_one, _CAPACITY)
        for amplitude, expected in zip(_AMPLITUDES, values, strict=True):
            label = f"{rule}, P_fa = {false_alarm:g}, a_0 = {amplitude:g}, N_0 = 11: {model}"
            ours = _detection(rule, false_alarm, amplitude, model)
            yield Row(label, None, expected, ours, _TOLERANCE)
    rule = Accumulator(5, 2, from_first_one=True, capacity=_CAPACITY)
    ours = detection_probability(rule, 0.1753, _signal(0.1753, 2.0))
    yield Row(f"{rule}, p_N = 0.1753, a_0 = 2, N_0 = 11: exact", None, 0.5369, ours, 1e-4)
    yield from _conclusions()


def _single_states() -> Iterator[Row]:
    between, first = (
        {zeros: book_chain(Accumulator(5, zeros, f), _CAPACITY) for zeros in (1, 2, 3, 4)}
        for f in (False, True)
    )
    endless = book_chain(Accumulator(5, 3, from_first_one=True), 2000)
    for chain, equation, points in (
        (between[1], "(3.51)", {0: 0.9, 1: 0.09, 2: 0.009, 3: 0.0009}),
        (between[2], "(3.54)", {0: 0.447514, 1: 0.447514, 2: 0.0850276, 5: 5.832e-4, 6: 1.1081e-4}),
        (between[3], "(3.57)", {0: 0.296583, 2: 0.296583, 3: 0.080374, 5: 5.9027e-3}),
        (between[4], "k = 4, as (3.57)", {0: 0.221036, 3: 0.221036, 4: 0.076014, 5: 0.026141}),
        (first[2], "(3.60)-(3.61)", {0: 0.817356, 1: 0.0817356, 2: 0.0817356, 5: 5.606e-4}),
        (endless, "(3.63)", {0: 0.747846, 1: 0.0747846, 3: 0.0747846, 4: 0.0202666}),
    ):
        states = chain.noise_states(0.1)
        for state, expected in points.items():
            label = f"{equation}, p_N = 0.1: P_{state}"
            yield Row(label, None, expected, float(states[state]), to_digits(expected))
    for noise, expected in ((0.1, 0.009), (0.2, 0.032)):
        endless = book_chain(Accumulator(5, 2, from_first_one=True), 2000)
        initial = float(endless.noise_states(noise)[0])
        ours = 1.0 - (1.0 - noise) ** 2 / initial
        label = f"(3.62), p_N = {noise:g}: error of P_0 = q^2, relative"
        yield Row(label, None, expected, ours, to_digits(expected))


def _recurrences() -> Iterator[Row]:
    noise = 0.1353353
    signal = _signal(noise, 2.5)
    for equation, rule in (
        ("(3.81)", Accumulator(5, 1, from_first_one=False)),
        ("(3.83)", Accumulator(5, 2, from_first_one=False)),
        ("(3.85)", Accumulator(5, 3, from_first_one=False)),
        ("(3.87), P_2 corrected", Accumulator(5, 2, from_first_one=True)),
    ):
        chain = book_chain(rule, _CAPACITY)
        ours = chain.signal_states(noise, signal)
        printed = _as_printed(equation[:6], chain, noise, signal)
        largest = float(np.abs(ours - printed).max())
        yield Row(f"{equation} against the chain: largest difference", None, 0.0, largest, 1e-14)
    chain = book_chain(Accumulator(5, 2, from_first_one=True), _CAPACITY)
    as_printed = _as_printed("misprint", chain, noise, signal)
    yield Row(
        "(3.87) as printed, x_0 = 2, a_0 = 2.5: sum of the probabilities after 11 pulses", None,
        1.030, float(as_printed[-1].sum()), 5.1e-4,
        "P_1 and P_2 are printed as one and the same P_0 p, which does not keep the sum at one; P_2 follows from the "
        "P_1 before it",
    )  # fmt: skip
    ours_sum = float(chain.signal_states(noise, signal)[-1].sum())
    yield Row("(3.87) corrected: sum of the probabilities", None, 1.0, ours_sum, 1e-12)


def _as_printed(equation: str, chain: BookChain, noise: float, signal: FloatArray) -> FloatArray:
    """Recurrences (3.81)-(3.87) term by term."""
    states = [chain.noise_states(noise)]
    before = states[0][1]
    resets = zero_runs(chain.zeros, noise, signal)
    for one, reset in zip(signal, resets, strict=True):
        old, new = states[-1], np.zeros_like(states[0])
        new[1:] = old[:-1] * (1.0 - reset)
        if equation == "(3.81)":
            new[0] = 1.0 - one + old[-1] * one
            new[1:] = old[:-1] * one
        elif equation == "(3.83)":
            new[0] = reset * (1.0 - old[0]) + old[-1] * (1.0 - reset)
            new[1] = old[0]
        elif equation == "(3.85)":
            new[0] = (1.0 - old[0] - before) * reset + old[-1] * (1.0 - reset)
            new[1:3] = old[:2]
            before = old[0]
        else:
            new[0] = (
                (1.0 - one) * old[0] + reset * (1.0 - old[0] - old[1]) + old[-1] * (1.0 - reset)
            )
            new[1] = old[0] * one
            new[2] = new[1] if equation == "misprint" else old[1]
        states.append(new)
    return np.array(states[1:])


def _conclusions() -> Iterator[Row]:
    program = Program(3, 4, 2)
    accumulator = Accumulator(5, 2, from_first_one=False, capacity=_CAPACITY)
    for model, expected, finding in (
        ("kuzmin", 1.0, ""),
        (
            "exact",
            0.0,
            "the book resets the count with q^k at every position, whatever the bits before: its accumulator makes "
            "9 times fewer false bursts than the automaton; at equal true P_fa the accumulator detects less",
        ),
    ):
        better = _detection(accumulator, 4e-3, 2.5, model) > _detection(program, 4e-3, 2.5, model)
        yield Row(
            f"accumulator between series detects better than 3/4-2, P_fa = 0.004, {model} (1 = yes)",
            1.0, expected, float(better), 0.0, finding,
        )  # fmt: skip


def _signal(noise: float, amplitude: float) -> FloatArray:
    return steady_probability(threshold_for(noise), amplitude * burst_shape("sinc2", 11))


def _detection(
    rule: Accumulator | Program, false_alarm: float, amplitude: float, model: str
) -> float:
    noise = noise_probability(rule, false_alarm, model)
    return detection_probability(rule, noise, _signal(noise, amplitude), model)
