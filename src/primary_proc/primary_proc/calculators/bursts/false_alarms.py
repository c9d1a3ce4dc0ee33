# SPDX-License-Identifier: Apache-2.0
"""How often noise alone makes a plot, and the probability of a one that keeps it to a wanted rate."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from scipy.optimize import brentq
from scipy.special import lambertw

from primary_proc.automata.automaton import Output
from primary_proc.automata.automaton_chain import first_detection, noise_state, start_probability
from primary_proc.automata.book_chain import book_chain
from primary_proc.automata.burst_rule import BurstRule

_SMALLEST, _LARGEST = 1e-5, 0.3
_DENSEST = 0.2
_ITERATIONS = 3


def false_start_probability(rule: BurstRule, noise: float, model: str = "exact") -> float:
    """Probability per azimuth position that noise starts a burst, P_fa.

    Source: Kuzmin 1967, (3.51)-(3.63) for accumulators, (3.69) and (3.72) for programs, as "kuzmin"; the automaton's
    own chain for "exact".

    Args:
        rule: of the detector.
        noise: probability p_N of a one.
        model: "exact" or "kuzmin".

    Returns:
        Probability.

    Raises:
        ValueError: the model is neither, or the book has no form for the rule.
    """
    if model == "kuzmin":
        chain = book_chain(rule)
        return float(chain.noise_states(noise)[chain.detection])
    if model == "exact":
        automaton = rule.automaton
        return float(start_probability(automaton, noise_state(automaton, noise), noise))
    raise ValueError(f"model {model!r} is neither exact nor kuzmin")


@lru_cache(maxsize=256)
def noise_probability(rule: BurstRule, false_start: float, model: str = "exact") -> float:
    """Probability of a one in noise that gives a false-start probability; inverse of the above.

    Args:
        rule: of the detector.
        false_start: wanted P_fa per azimuth position.
        model: "exact" or "kuzmin".

    Returns:
        p_N.

    Raises:
        ValueError: more false starts are wanted than the detector should ever give.
    """
    lowest, highest = (
        false_start_probability(rule, noise, model) for noise in (_SMALLEST, _LARGEST)
    )
    if not lowest < false_start < highest:
        raise ValueError(
            f"a false-start probability of {false_start:.3g} is out of reach of {rule}: "
            f"p_N from {_SMALLEST:g} to {_LARGEST:g} gives {lowest:.3g} to {highest:.3g}"
        )

    def excess(logarithm: float) -> float:
        noise = float(np.exp(logarithm))
        return float(np.log(false_start_probability(rule, noise, model) / false_start))

    return float(np.exp(brentq(excess, np.log(_SMALLEST), np.log(_LARGEST))))


def false_bursts_per_second(
    rule: BurstRule, noise: float, rings: int, pulse_rate: float, model: str = "exact"
) -> float:
    """False bursts of the whole coverage in a second, (3.75)-(3.76): b F P_fa.

    Args:
        rule: of the detector.
        noise: probability p_N of a one.
        rings: b, range rings.
        pulse_rate: F, pulses a second.
        model: "exact" or "kuzmin".

    Returns:
        Mean number of bursts, those that would merge counted each.
    """
    return rings * pulse_rate * false_start_probability(rule, noise, model)


def false_plots_per_scan(
    rule: BurstRule, noise: float, rings: int, pulses_per_scan: float, gap: int = 0
) -> float:
    """False plots of the whole coverage in one turn, (3.75)-(3.76), less those that merge with another.

    Bursts of the same or of adjacent rings that are near each other become one plot. Bursts come as a Poisson process,
    so a plot is a burst with no other in the room before it; the noise of adjacent rings is taken as independent.

    Args:
        rule: of the detector.
        noise: probability p_N of a one.
        rings: range rings.
        pulses_per_scan: azimuth positions in one turn.
        gap: most pulses between two bursts that make one plot.

    Returns:
        Mean number of plots.
    """
    start = false_start_probability(rule, noise)
    room = _merging_room(rule, noise, rings, gap)
    return float(pulses_per_scan * rings * start * np.exp(-room * start))


def noise_probability_for_rate(
    rule: BurstRule, false_plots: float, rings: int, pulses_per_scan: float, gap: int = 0
) -> float:
    """Probability of a one in noise that gives a number of false plots per scan; inverse of the above.

    Args:
        rule: of the detector.
        false_plots: wanted false plots of the whole coverage in one turn.
        rings: range rings.
        pulses_per_scan: azimuth positions in one turn.
        gap: most pulses between two bursts that make one plot.

    Returns:
        p_N.

    Raises:
        ValueError: so many false plots are wanted that they would grow together.
    """
    share = false_plots / (rings * pulses_per_scan)
    noise = noise_probability(rule, share)
    for _ in range(_ITERATIONS):
        room = _merging_room(rule, noise, rings, gap)
        if share * room > _DENSEST:
            raise ValueError(
                f"{false_plots:g} false plots per scan on {rings * pulses_per_scan:g} cells lie so close that they "
                f"merge; at most {_DENSEST / room * rings * pulses_per_scan:.3g} can be had"
            )
        apart = float(-lambertw(-share * room).real / room) if room else share
        noise = noise_probability(rule, apart)
    return noise


def _merging_room(rule: BurstRule, noise: float, rings: int, gap: int) -> float:
    """Positions, in the ring itself and in one neighbour, where another burst would merge with a given one."""
    automaton = rule.automaton
    neighbour = 2.0 * (mean_noise_length(rule, noise) + gap) + 1.0
    ended = np.zeros(len(automaton))
    ended[-1] = 1.0
    again = float(first_detection(automaton, noise, np.full(gap, noise), ended))
    start = false_start_probability(rule, noise)
    return neighbour * (rings - 1) / rings - float(np.log1p(-again)) / start


def mean_noise_length(rule: BurstRule, noise: float) -> float:
    """Mean number of positions from start to end of a burst while only noise makes ones.

    The share of positions inside a burst over the probability that one starts; for a program that declares early this
    is the waiting time for k zeros in a row, (1 - q^k) / (p q^k).

    Args:
        rule: of the detector.
        noise: probability p_N of a one.

    Returns:
        Positions.
    """
    automaton = rule.automaton
    inside = noise_state(automaton, noise)[automaton.output == Output.BURST].sum()
    return float(inside / false_start_probability(rule, noise))
