# SPDX-License-Identifier: Apache-2.0
"""Calculators against the reference values of Kuzmin 1967, § 3.3, and Monte Carlo through the detector against both."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.stats import binom, chi2, ncx2

from primary_proc.automata.automaton_chain import noise_state, start_end_distribution, step_chain
from primary_proc.automata.book_chain import book_chain
from primary_proc.automata.program import Program
from primary_proc.calculators.azimuth_accuracy import azimuth_error
from primary_proc.calculators.burst_shape import burst_shape, pulses_in_burst
from primary_proc.calculators.detection_probability import detection_probability
from primary_proc.calculators.false_alarms import (
    false_plots_per_scan,
    false_start_probability,
    mean_noise_length,
    noise_probability,
    noise_probability_for_rate,
)
from primary_proc.calculators.single_pulse import (
    fluctuating_probability,
    steady_probability,
    threshold_for,
)
from primary_proc.detectors.program_detector import ProgramDetector

THREE_OF_FOUR = Program(3, 4, 2)
AMPLITUDES = np.array([1.0, 1.5, 2.0, 2.5, 3.0, 4.0])
CONFIDENCE = 0.999
# MOD-G, sinc2, N0 = 11: p_N, then detection probability by the book's recurrence and by the exact automaton.
MOD_G = {
    ("3/3-2", 0.1691): [
        ".095/.096",
        ".202/.204",
        ".395/.400",
        ".630/.639",
        ".823/.833",
        ".975/.983",
    ],
    ("4/4-2", 0.2727): [
        ".092/.092",
        ".187/.188",
        ".362/.364",
        ".583/.586",
        ".778/.782",
        ".961/.965",
    ],
    ("4/4-3", 0.2733): [
        ".091/.092",
        ".187/.188",
        ".360/.362",
        ".580/.582",
        ".773/.776",
        ".954/.956",
    ],
    ("3/4-2", 0.1219): [
        ".103/.103",
        ".226/.226",
        ".444/.445",
        ".697/.699",
        ".883/.884",
        ".994/.993",
    ],
    ("3/3-2", 0.0597): [
        ".009/.009",
        ".034/.034",
        ".116/.116",
        ".293/.293",
        ".542/.543",
        ".913/.914",
    ],
    ("4/4-2", 0.1229): [
        ".008/.008",
        ".031/.031",
        ".104/.104",
        ".264/.264",
        ".495/.495",
        ".873/.874",
    ],
    ("3/4-2", 0.0419): [
        ".010/.010",
        ".037/.037",
        ".129/.129",
        ".329/.329",
        ".602/.602",
        ".950/.950",
    ],
}
# MOD-D, P_fa at p_N by the book's chain; exact chain where it differs.
MOD_D = [
    ("3/3-2", 0.05, 1.1874e-4, None),
    ("3/4-2", 0.05, 3.3251e-4, None),
    ("4/4-2", 0.10, 8.9991e-5, None),
    ("4/4-3", 0.10, 8.9982e-5, None),
    ("3/4-2", 0.15, 6.8950e-3, 6.887e-3),
    ("3/3-2", 0.20, 6.3467e-3, 6.337e-3),
    ("3/4-2", 0.20, 1.4142e-2, 1.409e-2),
    ("4/4-3", 0.30, 5.5602e-3, 5.515e-3),
    ("3/4-2", 0.30, 3.4723e-2, 3.421e-2),
    ("3/4-2", 0.50, 7.2838e-2, 6.771e-2),
]


def burst(p_noise, amplitude, pulses=11):
    """Probability of a one on each pulse of a sinc2 burst."""
    shape = burst_shape("sinc2", pulses)
    return steady_probability(threshold_for(p_noise), np.multiply.outer(amplitude, shape))


def packed(bits):
    assert bits.shape[1] % 64 == 0
    return np.packbits(bits.reshape(-1)).view(np.uint64).reshape(len(bits), -1)


def detect(program, probability, rings, rng):
    """Bursts that the detector finds in random bits; probability of a one on each pulse."""
    detector = ProgramDetector(program, rings, 10**6)
    found = [
        detector.detect(packed(rng.random((1, rings)) < one), pulse)
        for pulse, one in enumerate(probability)
    ]
    return np.concatenate(found), detector.open_bursts()


def test_single_pulse_probabilities():
    assert threshold_for(0.01) == pytest.approx(3.0349, abs=5e-5)
    table = {1: 0.0404, 2: 0.2039, 3: 0.5533, 4: 0.8666, 5: 0.9819}
    for amplitude, value in table.items():
        assert steady_probability(threshold_for(0.01), amplitude) == pytest.approx(value, abs=5e-5)
    assert fluctuating_probability(2.0, [1, 2, 3]) == pytest.approx(
        [0.36788, 0.67032, 0.81873], abs=5e-6
    )
    strong = np.linspace(0, 40, 30)
    assert steady_probability(3.0, strong) == pytest.approx(ncx2.sf(9.0, 2, strong**2), abs=1e-9)


def test_row_30_states_of_three_of_four():
    states = book_chain(THREE_OF_FOUR).noise_states(0.1)
    first, short, detection = (
        states[0],
        states[2],
        states[book_chain(THREE_OF_FOUR).detection],
    )
    assert first == pytest.approx(0.810211, abs=5e-7)
    assert short == pytest.approx(0.0801307, abs=5e-8)  # P_3, the state "10"
    assert detection == pytest.approx(2.34071e-3, rel=2e-6)


def test_row_28_states_of_three_of_three():
    states = book_chain(Program(3, 3, 2)).noise_states(0.1)
    assert states[[0, 3]] == pytest.approx([0.899091, 8.9909e-4], rel=2e-5)


def test_row_32_approximation_for_few_ones():
    p, q = 0.1, 0.9
    approximate = q * p**3 * ((1 - p * q) * (1 + q) + q)
    assert approximate == pytest.approx(2.366e-3, rel=3e-4)
    assert false_start_probability(THREE_OF_FOUR, p, "kuzmin") == pytest.approx(2.341e-3, rel=3e-4)


def test_row_46_threshold_for_a_rate_of_4_in_1000():
    for model in ("exact", "kuzmin"):
        noise = noise_probability(THREE_OF_FOUR, 4e-3, model)
        assert noise == pytest.approx(0.1219, abs=1e-4)
        assert threshold_for(noise) == pytest.approx(2.052, abs=1e-3)


@pytest.mark.parametrize(
    ("name", "rate", "noise"),
    [
        ("3/3-2", 4e-3, 0.1691),
        ("4/4-2", 4e-3, 0.2727),
        ("4/4-3", 4e-3, 0.2733),
        ("3/3-2", 2e-4, 0.0597),
        ("3/4-2", 2e-4, 0.0419),
    ],
)
def test_inverse_of_the_false_start_probability(name, rate, noise):
    found = noise_probability(Program.parse(name), rate, "kuzmin")
    assert found == pytest.approx(noise, abs=6e-5)
    assert false_start_probability(Program.parse(name), found, "kuzmin") == pytest.approx(rate)


@pytest.mark.parametrize(("name", "noise", "book", "exact"), MOD_D)
def test_false_start_probability(name, noise, book, exact):
    program = Program.parse(name)
    assert false_start_probability(program, noise, "kuzmin") == pytest.approx(book, rel=6e-5)
    assert false_start_probability(program, noise) == pytest.approx(
        book if exact is None else exact, rel=5e-4
    )


@pytest.mark.parametrize("name", ["3/4-2", "3/3-2", "4/4-2", "4/4-3", "3/3-4"])
@pytest.mark.parametrize("noise", [0.02, 0.1, 0.3])
def test_closed_forms_are_the_limit_of_the_books_chain(name, noise):
    program = Program.parse(name)
    states = book_chain(program).noise_states(noise)
    assert states.sum() == pytest.approx(1.0)
    stepped = book_chain(program).step(states, noise, (1 - noise) ** program.zeros)
    assert stepped == pytest.approx(states, abs=1e-14)


@pytest.mark.parametrize("name", ["3/4-2", "4/4-3", "3/5-2"])
def test_exact_noise_state_is_stationary(name):
    automaton = Program.parse(name).automaton
    state = noise_state(automaton, 0.2)
    assert state.sum() == pytest.approx(1.0)
    assert step_chain(automaton, state, 0.2) == pytest.approx(state, abs=1e-14)


@pytest.mark.parametrize("noise", [0.1, 0.1219])
def test_false_starts_of_the_detector_on_simulated_noise(noise):
    """P_fa per position within the binomial bound; starts are too far apart to be dependent."""
    pulses, rings = 1500, 1024
    rng = np.random.default_rng(41)
    closed, still_open = detect(THREE_OF_FOUR, np.full(pulses, noise), rings, rng)
    starts = np.concatenate([closed["start"], still_open["start"]])
    warm = 50
    count = int(np.count_nonzero(starts >= warm))
    expected = false_start_probability(THREE_OF_FOUR, noise)
    low, high = binom.interval(CONFIDENCE, (pulses - warm) * rings, expected)
    assert low <= count <= high
    length = (closed["end"] - closed["start"]).mean()
    assert length == pytest.approx(mean_noise_length(THREE_OF_FOUR, noise), rel=0.05)


@pytest.mark.parametrize(("name", "noise"), MOD_G)
def test_detection_probability_of_both_models(name, noise):
    program = Program.parse(name)
    # The table's p_N is rounded, so the rate that it stands for is used.
    rate = 4e-3 if noise in (0.1691, 0.2727, 0.2733, 0.1219) else 2e-4
    for amplitude, pair in zip(AMPLITUDES, MOD_G[name, noise], strict=True):
        book, exact = (float(value) for value in pair.split("/"))
        p_noise = noise_probability(program, rate, "kuzmin")
        signal = burst(p_noise, amplitude)
        assert detection_probability(program, p_noise, signal, "kuzmin") == pytest.approx(
            book, abs=6e-4
        )
        assert detection_probability(program, p_noise, signal) == pytest.approx(exact, abs=6e-4)


@pytest.mark.parametrize(
    ("pulses", "rate", "expected"), [(8, 4e-3, 0.301), (15, 4e-3, 0.583), (20, 2e-4, 0.282)]
)
def test_detection_probability_grows_with_the_pulses_of_a_burst(pulses, rate, expected):
    p_noise = noise_probability(THREE_OF_FOUR, rate)
    found = detection_probability(THREE_OF_FOUR, p_noise, burst(p_noise, 2.0, pulses))
    assert found == pytest.approx(expected, abs=1e-3)


def test_detection_probability_of_fast_fluctuation():
    p_noise = noise_probability(THREE_OF_FOUR, 4e-3)
    shape = burst_shape("sinc2", 11)
    for amplitude, expected in ((1.0, 0.184), (2.0, 0.631), (4.0, 0.965)):
        signal = fluctuating_probability(threshold_for(p_noise), amplitude * shape)
        assert detection_probability(THREE_OF_FOUR, p_noise, signal) == pytest.approx(
            expected, abs=1e-3
        )


@pytest.mark.parametrize("amplitude", [1.5, 2.0, 3.0])
@pytest.mark.parametrize("name", ["3/4-2", "3/3-2"])
def test_detection_and_azimuth_error_of_the_detector(name, amplitude):
    """The detector's own bursts on simulated targets: detection, bias and spread as calculated."""
    program = Program.parse(name)
    p_noise = noise_probability(program, 4e-3)
    signal = burst(p_noise, amplitude)
    before, after, rings = 40, 60, 40_000 // 64 * 64
    probability = np.concatenate([np.full(before, p_noise), signal, np.full(after, p_noise)])
    closed, _ = detect(program, probability, rings, np.random.default_rng(17))
    ours = closed[(closed["start"] >= before) & (closed["start"] < before + len(signal))]

    detected = len(np.unique(ours["ring"]))
    low, high = binom.interval(CONFIDENCE, rings, detection_probability(program, p_noise, signal))
    assert low <= detected <= high

    error = (ours["start"] + ours["end"]) / 2.0 - (before + (len(signal) - 1) / 2.0)
    expected = azimuth_error(program, p_noise, signal)
    count = len(error)
    assert abs(error.mean() - expected.bias) < 3.3 * expected.std / np.sqrt(count)
    # Kurtosis of the error is below 6 here, so the variance's own error is below sqrt(5 / n).
    assert abs(error.var() / expected.std**2 - 1.0) < 3.3 * np.sqrt(5.0 / count)


@pytest.mark.parametrize(
    ("name", "rate", "book", "exact"),
    [
        ("3/3-2", 4e-3, [1.37, 0.96, 0.77], [1.45, 1.08, 0.93]),
        ("4/4-3", 4e-3, [1.33, 0.97, 0.84], [2.27, 2.07, 2.02]),
        ("3/4-2", 4e-3, [1.40, 0.95, 0.75], [1.44, 1.02, 0.85]),
        ("3/4-2", 2e-4, [1.08, 0.79, 0.61], [1.09, 0.81, 0.65]),
    ],
)
def test_azimuth_error_of_both_models(name, rate, book, exact):
    program = Program.parse(name)
    p_noise = noise_probability(program, rate, "kuzmin")
    for amplitude, of_book, of_chain in zip((2.0, 3.0, 4.0), book, exact, strict=True):
        signal = burst(p_noise, amplitude)
        assert azimuth_error(program, p_noise, signal).std == pytest.approx(of_chain, abs=6e-3)
        assert azimuth_error(program, p_noise, signal, model="kuzmin").std == pytest.approx(
            of_book, abs=6e-3
        )


@pytest.mark.parametrize(
    ("name", "biases"),
    [
        ("3/3-2", [2.25, 2.32, 2.30]),
        ("4/4-3", [4.27, 4.33, 4.31]),
        ("3/3-1", [1.41, 1.46, 1.46]),
    ],
)
def test_bias_of_the_exact_chain(name, biases):
    program = Program.parse(name)
    model = "kuzmin" if program.zeros > 1 else "exact"  # One zero leaves nothing to approximate.
    p_noise = noise_probability(program, 4e-3, model)
    for amplitude, bias in zip((2.0, 3.0, 4.0), biases, strict=True):
        found = azimuth_error(program, p_noise, burst(p_noise, amplitude)).bias
        assert found == pytest.approx(bias, abs=6e-3)


def test_bias_of_three_of_four_is_that_of_three_ones():
    p_noise = noise_probability(THREE_OF_FOUR, 4e-3)
    bias = azimuth_error(THREE_OF_FOUR, p_noise, burst(p_noise, np.array([2.0, 3.0, 4.0]))).bias
    assert ((bias > 2.0) & (bias < 2.25)).all()
    assert THREE_OF_FOUR.nominal_bias == 2.0


def test_more_pulses_spread_the_estimate_in_steps():
    p_noise = noise_probability(THREE_OF_FOUR, 4e-3)
    for amplitude, expected in ((2.0, 1.86), (3.0, 1.30), (4.0, 1.02)):
        signal = burst(p_noise, amplitude, 15)
        found = azimuth_error(THREE_OF_FOUR, p_noise, signal, model="kuzmin").std
        assert found == pytest.approx(expected, abs=6e-3)


def test_distribution_of_start_and_end_holds_all_bursts():
    p_noise = noise_probability(Program(4, 4, 3), 4e-3)
    joint = start_end_distribution(Program(4, 4, 3).automaton, p_noise, burst(p_noise, 3.0))
    assert (joint.probability >= 0.0).all()
    assert joint.probability[np.subtract.outer(joint.start, joint.end) > -3].sum() == 0.0


@pytest.mark.parametrize("gap", [0, 10])
def test_rate_of_the_whole_coverage_inverts(gap):
    noise = noise_probability_for_rate(THREE_OF_FOUR, 200.0, 512, 2048.0, gap)
    found = false_plots_per_scan(THREE_OF_FOUR, noise, 512, 2048.0, gap)
    assert found == pytest.approx(200.0, rel=1e-3)
    unmerged = 512 * 2048 * false_start_probability(THREE_OF_FOUR, noise)
    assert unmerged > 200.0


def test_rates_out_of_reach_are_refused():
    with pytest.raises(ValueError, match="merge"):
        noise_probability_for_rate(THREE_OF_FOUR, 1e3, 100, 1000.0, 20)
    with pytest.raises(ValueError, match="out of reach"):
        noise_probability(THREE_OF_FOUR, 0.5)
    with pytest.raises(ValueError, match="model"):
        false_start_probability(THREE_OF_FOUR, 0.1, "other")
    with pytest.raises(ValueError, match="model"):
        detection_probability(THREE_OF_FOUR, 0.1, [0.5], "other")
    with pytest.raises(ValueError, match="model"):
        azimuth_error(THREE_OF_FOUR, 0.1, [0.5], model="other")
    with pytest.raises(ValueError, match="closed form"):
        book_chain(Program.parse("3/5-3"))


@pytest.mark.parametrize(
    ("pattern", "half_power"), [("sinc2", 0.44294647), ("gaussian", np.sqrt(np.log(2.0)))]
)
def test_beamwidth_is_where_the_pattern_falls_to_one_half(pattern, half_power):
    pulses = pulses_in_burst(pattern, beamwidth=0.02, step=0.001)
    assert pulses == pytest.approx(20.0 / half_power)
    assert burst_shape(pattern, pulses, np.array([-10.0, 10.0]))[:, round(pulses) // 2].max() <= 0.6
    middle = burst_shape(pattern, 11)
    assert middle == pytest.approx(middle[::-1])
    if pattern == "sinc2":
        assert middle[:6] == pytest.approx([0.010, 0.109, 0.334, 0.634, 0.896, 1.0], abs=6e-4)
    else:
        assert middle[:6] == pytest.approx([0.438, 0.589, 0.743, 0.876, 0.967, 1.0], abs=6e-4)


def test_chi_square_is_the_square_of_rayleigh():
    """The threshold is on the envelope in sigmas, whose square is chi-square with two degrees of freedom."""
    assert chi2.sf(threshold_for(0.037) ** 2, 2) == pytest.approx(0.037)
