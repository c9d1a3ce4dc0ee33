# SPDX-License-Identifier: Apache-2.0
"""False starts and false plots of the binary detectors: reference values, inverses, limits."""

from __future__ import annotations

import pytest

from primary_proc.automata.accumulator import Accumulator
from primary_proc.automata.program import Program
from primary_proc.calculators.bursts.accumulator_noise import (
    unbroken_probability,
    unlimited_false_starts,
)
from primary_proc.calculators.bursts.false_alarms import (
    false_bursts_per_second,
    false_plots_per_scan,
    false_start_probability,
    mean_noise_length,
    noise_probability,
    noise_probability_for_rate,
)
from primary_proc.calculators.pulse.single_pulse import threshold_for

THREE_OF_FOUR = Program(3, 4, 2)
# Kuzmin 1967, § 3.3.3: P_fa at p_N by the book's chain; exact chain where it differs.
FALSE_STARTS = [
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


@pytest.mark.parametrize(("name", "noise", "book", "exact"), FALSE_STARTS)
def test_false_start_probability(name, noise, book, exact):
    program = Program.parse(name)
    assert false_start_probability(program, noise, "kuzmin") == pytest.approx(book, rel=6e-5)
    assert false_start_probability(program, noise) == pytest.approx(
        book if exact is None else exact, rel=5e-4
    )


@pytest.mark.parametrize("from_first_one", [False, True])
@pytest.mark.parametrize("zeros", [1, 2, 3])
@pytest.mark.parametrize("threshold", [5, 9, 40])
def test_accumulators_have_the_closed_form(threshold, zeros, from_first_one):
    """The last one has so many states that its chain is solved as a sparse system."""
    rule = Accumulator(threshold, zeros, from_first_one, capacity=400 if threshold == 40 else None)
    closed = unlimited_false_starts(rule, 0.3)
    assert false_start_probability(rule, 0.3) == pytest.approx(closed, rel=1e-6)


def test_unbroken_probability_counts_words():
    """Of 8 words of 3 bits, 5 hold no two zeros in a row: 011, 101, 110, 111, 010."""
    assert unbroken_probability(3, 2, 0.5) == pytest.approx(5 / 8)
    assert unbroken_probability(2, 3, 0.1) == 1.0


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


def test_declaring_late_changes_nothing_in_noise():
    for name in ("3/5-3", "3/4-2", "2/3-2"):
        early, late = (
            Program.parse(name.removesuffix("-late") + how) for how in ("-early", "-late")
        )
        exact = false_start_probability(early, 0.2)
        assert false_start_probability(late, 0.2) == pytest.approx(exact, rel=1e-9)


@pytest.mark.parametrize("name", ["3/4-2", "4/4-3", "2/6-3"])
def test_length_of_a_false_burst_is_the_wait_for_zeros(name):
    program = Program.parse(name)
    run = 0.9**program.zeros
    assert mean_noise_length(program, 0.1) == pytest.approx((1 - run) / (0.1 * run))


@pytest.mark.parametrize("gap", [0, 10])
def test_rate_of_the_whole_coverage_inverts(gap):
    noise = noise_probability_for_rate(THREE_OF_FOUR, 200.0, 512, 2048.0, gap)
    found = false_plots_per_scan(THREE_OF_FOUR, noise, 512, 2048.0, gap)
    assert found == pytest.approx(200.0, rel=1e-3)
    unmerged = 512 * 2048 * false_start_probability(THREE_OF_FOUR, noise)
    assert unmerged > 200.0
    per_turn = 4.0 * false_bursts_per_second(THREE_OF_FOUR, noise, 512, 512.0)
    assert per_turn == pytest.approx(unmerged)


def test_rates_out_of_reach_are_refused():
    with pytest.raises(ValueError, match="merge"):
        noise_probability_for_rate(THREE_OF_FOUR, 1e3, 100, 1000.0, 20)
    with pytest.raises(ValueError, match="out of reach"):
        noise_probability(THREE_OF_FOUR, 0.5)
    with pytest.raises(ValueError, match="model"):
        false_start_probability(THREE_OF_FOUR, 0.1, "other")
