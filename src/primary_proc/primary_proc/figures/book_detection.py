# SPDX-License-Identifier: Apache-2.0
"""Kuzmin 1967, figures 3.3 and 3.19-3.27 recomputed: thresholds, false alarms, detection."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.ticker import NullFormatter

from primary_proc.automata.accumulator import Accumulator
from primary_proc.automata.burst_rule import BurstRule
from primary_proc.automata.program import Program
from primary_proc.calculators.bursts.detection_probability import detection_probability
from primary_proc.calculators.bursts.false_alarms import false_start_probability, noise_probability
from primary_proc.calculators.integration.binary_integration import required_snr_db
from primary_proc.calculators.pulse.burst_shape import burst_shape
from primary_proc.calculators.pulse.single_pulse import steady_probability, threshold_for

PROGRAMS = ("3/3-2", "4/4-2", "4/4-3", "3/4-2")
PULSES = 11
RATES = (4e-3, 2e-4)
PATTERN = "sinc2"

_WINDOW = 16
_FALSE_ALARM = 1e-5
_NOISE = np.geomspace(0.02, 0.5, 25)
_TICKS = (0.02, 0.05, 0.1, 0.2, 0.5)
_AMPLITUDES = np.linspace(0.5, 6.0, 23)
_THRESHOLDS = (3, 4, 5, 6, 8)
_THRESHOLD = 5
_LENGTHS = (8, 11, 15, 20)


def required_amplitude(axes: Axes, target: str) -> None:
    """Draw figure 3.3: signal needed against the second threshold, a window of 16 pulses.

    Args:
        axes: to draw on.
        target: "steady" for part a, "fast" for part b.
    """
    counts = np.arange(1, _WINDOW + 1)
    for detection in (0.5, 0.7, 0.9):
        needed = [
            required_snr_db(_WINDOW, int(count), _FALSE_ALARM, detection, target)
            for count in counts
        ]
        axes.plot(counts, needed, marker=".", label=f"$P_d$ = {detection:g}")
    axes.set(
        title=f"3.3: {target} target, $N_0$ = {_WINDOW}, $P_{{fa}}$ = 1e-5",
        xlabel="second threshold, ones",
        ylabel="SNR, dB",
    )
    axes.legend()


def accumulator_false_alarms(axes: Axes, zeros: int, *, from_first_one: bool) -> None:
    """Draw figures 3.19-3.22: false starts of an accumulator against the probability of a one.

    Args:
        axes: to draw on.
        zeros: k.
        from_first_one: whether the count begins with a one (3.21, 3.22) or after a series (3.19, 3.20).
    """
    for number, threshold in enumerate(_THRESHOLDS):
        if threshold <= zeros:
            continue
        rule = Accumulator(threshold, zeros, from_first_one)
        for model, line in (("kuzmin", "--"), ("exact", "-")):
            rate = [false_start_probability(rule, float(p), model) for p in _NOISE]
            axes.loglog(
                _NOISE,
                rate,
                line,
                color=f"C{number}",
                label=f"{threshold}" if line == "-" else None,
            )
    figure = {(2, False): "3.19", (3, False): "3.20", (2, True): "3.21", (3, True): "3.22"}
    place = "from the first one" if from_first_one else "between series"
    axes.set(
        title=f"{figure[zeros, from_first_one]}: accumulator {place}, k = {zeros}",
        xlabel="probability of a one in noise",
        ylabel="false starts per position",
        ylim=(1e-6, 10.0),
    )
    _probability_axis(axes)
    axes.legend(title="threshold; dashed: book's chain", ncols=3, loc="upper left")


def program_false_alarms(axes: Axes) -> None:
    """Draw figure 3.24: false starts of the programs against the probability of a one.

    Args:
        axes: to draw on.
    """
    for name in PROGRAMS:
        rate = [false_start_probability(Program.parse(name), float(p)) for p in _NOISE]
        axes.loglog(_NOISE, rate, label=name)
    axes.set(
        title="3.24: program detectors",
        xlabel="probability of a one in noise",
        ylabel="false starts per position",
        ylim=(1e-7, 0.2),
    )
    _probability_axis(axes)
    axes.legend()


def detection(axes: Axes, rules: dict[str, BurstRule], title: str) -> None:
    """Draw figures 3.25 and 3.26: detection against the amplitude, both false-alarm probabilities.

    Args:
        axes: to draw on.
        rules: detectors by the name to print.
        title: of the drawing.
    """
    shape = burst_shape(PATTERN, PULSES)
    for number, (name, rule) in enumerate(rules.items()):
        for rate, line in zip(RATES, ("-", "--"), strict=True):
            noise = noise_probability(rule, rate)
            found = _detected(rule, noise, shape)
            axes.plot(
                _AMPLITUDES, found, line, color=f"C{number}", label=name if line == "-" else None
            )
    axes.set(title=title, xlabel="$a_0$", ylabel="probability of detection", ylim=(0, 1.02))
    axes.legend(title="$P_{fa}$ 4e-3; dashed 2e-4", loc="lower right")


def accumulators() -> dict[str, BurstRule]:
    """Give the accumulators of figure 3.25.

    Returns:
        Rules by name.
    """
    return {
        f"{place}, k = {zeros}": Accumulator(_THRESHOLD, zeros, first)
        for place, first in (("between series", False), ("from the first one", True))
        for zeros in (2, 3)
    }


def programs() -> dict[str, BurstRule]:
    """Give the programs of figure 3.26.

    Returns:
        Rules by name.
    """
    return {name: Program.parse(name) for name in PROGRAMS}


def detection_over_length(axes: Axes) -> None:
    """Draw figure 3.27: how detection grows with the pulses in a burst.

    Args:
        axes: to draw on.
    """
    for line, name in (("-", "3/4-2"), ("--", "3/3-2")):
        rule = Program.parse(name)
        noise = noise_probability(rule, RATES[0])
        for number, pulses in enumerate(_LENGTHS):
            found = _detected(rule, noise, burst_shape(PATTERN, pulses))
            axes.plot(
                _AMPLITUDES, found, line, color=f"C{number}", label=pulses if line == "-" else None
            )
    axes.set(
        title="3.27: 3/4-2 and 3/3-2 (dashed), $P_{fa}$ = 4e-3",
        xlabel="$a_0$",
        ylabel="probability of detection",
        ylim=(0, 1.02),
    )
    axes.legend(title="$N_0$")


def _probability_axis(axes: Axes) -> None:
    axes.set_xticks(_TICKS, [f"{tick:g}" for tick in _TICKS])
    axes.xaxis.set_minor_formatter(NullFormatter())


def _detected(rule: BurstRule, noise: float, shape: npt.NDArray[np.float64]) -> list[float]:
    threshold = threshold_for(noise)
    return [
        detection_probability(rule, noise, steady_probability(threshold, amplitude * shape))
        for amplitude in _AMPLITUDES
    ]
