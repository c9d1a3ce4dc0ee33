# SPDX-License-Identifier: Apache-2.0
"""Kuzmin 1967, figures 3.7 and 3.28-3.30 recomputed: accuracy of the azimuth."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes

from primary_proc.automata.automaton import Output
from primary_proc.automata.program import Program
from primary_proc.calculators.azimuth.azimuth_accuracy import azimuth_error
from primary_proc.calculators.azimuth.potential_accuracy import quantised_bound
from primary_proc.calculators.bursts.false_alarms import noise_probability
from primary_proc.calculators.pulse.burst_shape import burst_shape
from primary_proc.calculators.pulse.single_pulse import steady_probability, threshold_for
from primary_proc.figures.book_detection import PATTERN, PROGRAMS, PULSES, RATES
from radar_common.figure_style import MUTED

_FIRST_THRESHOLD = 2.0
_AMPLITUDES = np.linspace(1.5, 5.0, 15)
_LONGER = 15
# The book's burst: found at position 4, ended in the noise at 13, its middle at 6.
_EXAMPLE = (0, 1, 1, 1, 0, 1, 1, 1, 1, 0, 1, 0, 0, 0)
_MIDDLE = 6


def potential_accuracy(axes: Axes) -> None:
    """Draw figure 3.7: the bound of binary bursts, and the book's working formula.

    Args:
        axes: to draw on.
    """
    for number, pulses in enumerate((PULSES, _LONGER)):
        for model, line in (("exact", "-"), ("kuzmin", "--")):
            bound = quantised_bound(PATTERN, pulses, _FIRST_THRESHOLD, _AMPLITUDES, model=model)
            label = f"$N_0$ = {pulses}" if line == "-" else None
            axes.plot(_AMPLITUDES, bound, line, color=f"C{number}", label=label)
    axes.set(title="3.7: potential accuracy, $x_0$ = 2", xlabel="$a_0$", ylabel="std / step")
    axes.set_ylim(bottom=0.0)
    axes.legend(title="dashed: (3.32)")


def example(axes: Axes) -> None:
    """Draw figure 3.28: how one burst of 11 pulses gets an error of 2.5 steps.

    Args:
        axes: to draw on.
    """
    program = Program.parse("3/3-2")
    state, said = 0, []
    for bit in _EXAMPLE:
        state = int(program.automaton.following[state, bit])
        said.append(int(program.automaton.output[state]))
    position = np.arange(1, len(_EXAMPLE) + 1)
    start = int(position[np.asarray(said) == Output.BURST][0])
    end = int(position[np.asarray(said) == Output.END][0])
    axes.bar(position, _EXAMPLE, width=0.5, color="C0")
    for place, name in ((start, "start"), (end, "end"), ((start + end) / 2, "middle")):
        axes.axvline(place, color="C1", linestyle="-" if name == "middle" else ":")
        axes.text(place, 1.12, name, ha="center", color="C1")
    axes.axvline(_MIDDLE, color=MUTED)
    axes.text(_MIDDLE, 1.12, "target", ha="center", color=MUTED)
    axes.set(
        title=f"3.28: 3/3-2, error {(start + end) / 2 - _MIDDLE:g} steps, bias not yet removed",
        xlabel="azimuth position",
        ylim=(0, 1.25),
        yticks=(0, 1),
    )


def random_errors(axes: Axes) -> None:
    """Draw figure 3.29: random error of the programs, and the bound.

    Args:
        axes: to draw on.
    """
    for name in PROGRAMS:
        axes.plot(_AMPLITUDES, _error(name, PULSES), label=name)
    bound = quantised_bound(PATTERN, PULSES, _FIRST_THRESHOLD, _AMPLITUDES)
    axes.plot(_AMPLITUDES, bound, "--", color=MUTED, label="bound, $x_0$ = 2")
    axes.set(
        title="3.29: $N_0$ = 11, $P_{fa}$ = 4e-3, by (3.103)", xlabel="$a_0$", ylabel="std / step"
    )
    axes.set_ylim(bottom=0.0)
    axes.legend()


def random_errors_over_length(axes: Axes) -> None:
    """Draw figure 3.30: random error with 11 and 15 pulses.

    Args:
        axes: to draw on.
    """
    for line, pulses in (("-", PULSES), ("--", _LONGER)):
        for number, name in enumerate(("3/3-2", "3/4-2")):
            label = name if line == "-" else None
            axes.plot(_AMPLITUDES, _error(name, pulses), line, color=f"C{number}", label=label)
    axes.set(
        title="3.30: $N_0$ = 11, and 15 (dashed), $P_{fa}$ = 4e-3",
        xlabel="$a_0$",
        ylabel="std / step",
    )
    axes.set_ylim(bottom=0.0)
    axes.legend()


def _error(name: str, pulses: int) -> list[float]:
    program = Program.parse(name)
    noise = noise_probability(program, RATES[0])
    threshold = threshold_for(noise)
    shape = burst_shape(PATTERN, pulses)
    return [
        float(
            azimuth_error(
                program, noise, steady_probability(threshold, amplitude * shape), model="kuzmin"
            ).std
        )
        for amplitude in _AMPLITUDES
    ]
