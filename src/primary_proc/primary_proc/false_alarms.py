# SPDX-License-Identifier: Apache-2.0
"""How often noise alone makes a plot, and the probability of a one that keeps it to a wanted rate."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy.optimize import brentq

from primary_proc import cascade_chain
from primary_proc.automaton import Program, program_automaton
from primary_proc.automaton_chain import noise_state, start_probability

_SMALLEST, _LARGEST = 1e-5, 0.3


def false_start_probability(program: Program, noise: float, model: str = "exact") -> float:
    """Probability per azimuth position that noise starts a burst, P_fa.

    Source: Kuzmin 1967, (3.69) and (3.72) for "kuzmin"; the automaton's own chain for "exact".

    Args:
        program: l/m-k.
        noise: probability p_N of a one.
        model: "exact" or "kuzmin".

    Returns:
        Probability.

    Raises:
        ValueError: the model is neither, or the book has no form for the program.
    """
    if model == "kuzmin":
        states = cascade_chain.noise_states(program, noise)
        return float(states[cascade_chain.detection_index(program)])
    if model == "exact":
        automaton = program_automaton(program)
        return float(start_probability(automaton, noise_state(automaton, noise), noise))
    raise ValueError(f"model {model!r} is neither exact nor kuzmin")


def noise_probability(program: Program, false_start: float, model: str = "exact") -> float:
    """Probability of a one in noise that gives a false-start probability; inverse of the above.

    Args:
        program: l/m-k.
        false_start: wanted P_fa per azimuth position.
        model: "exact" or "kuzmin".

    Returns:
        p_N.

    Raises:
        ValueError: more false starts are wanted than the program should ever give.
    """
    return _invert(lambda noise: false_start_probability(program, noise, model), false_start)


def false_plots_per_scan(
    program: Program, noise: float, rings: int, pulses_per_scan: float
) -> float:
    """False plots of the whole coverage in one turn, (3.75)-(3.76), less those that merge with a neighbour.

    Bursts of adjacent rings that overlap become one plot. To first order that takes away the number of overlapping
    pairs, a share of about 10 P_fa. Noise samples of adjacent rings are taken as independent.

    Args:
        program: l/m-k.
        noise: probability p_N of a one.
        rings: range rings.
        pulses_per_scan: azimuth positions in one turn.

    Returns:
        Mean number of plots.
    """
    start = false_start_probability(program, noise)
    pairs = (rings - 1) * start**2 * (2.0 * mean_noise_length(program, noise) + 1.0)
    return pulses_per_scan * (rings * start - pairs)


def noise_probability_for_rate(
    program: Program, false_plots: float, rings: int, pulses_per_scan: float
) -> float:
    """Probability of a one in noise that gives a number of false plots per scan.

    Args:
        program: l/m-k.
        false_plots: wanted false plots of the whole coverage in one turn.
        rings: range rings.
        pulses_per_scan: azimuth positions in one turn.

    Returns:
        p_N.

    Raises:
        ValueError: more false plots are wanted than the program should ever give on so few cells.
    """
    return _invert(
        lambda noise: false_plots_per_scan(program, noise, rings, pulses_per_scan), false_plots
    )


def mean_noise_length(program: Program, noise: float) -> float:
    """Mean number of positions from start to end of a burst while only noise makes ones.

    It is the waiting time for k zeros in a row, (1 - q^k) / (p q^k).

    Args:
        program: l/m-k.
        noise: probability p_N of a one.

    Returns:
        Positions.
    """
    run = (1.0 - noise) ** program.zeros
    return (1.0 - run) / (noise * run)


def _invert(rate: Callable[[float], float], wanted: float) -> float:
    if not rate(_SMALLEST) < wanted < rate(_LARGEST):
        raise ValueError(
            f"a false-alarm rate of {wanted:g} is outside what p_N of {_SMALLEST:g} to {_LARGEST:g} gives, "
            f"{rate(_SMALLEST):.3g} to {rate(_LARGEST):.3g}"
        )
    return float(
        np.exp(
            brentq(
                lambda log: np.log(rate(np.exp(log)) / wanted), np.log(_SMALLEST), np.log(_LARGEST)
            )
        )
    )
