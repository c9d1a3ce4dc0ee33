# SPDX-License-Identifier: Apache-2.0
"""From what the user wants and what the radar does to the settings of the extractor."""

from __future__ import annotations

import math
from dataclasses import dataclass

from primary_proc.calculators.accuracy_table import AccuracyTable
from primary_proc.calculators.burst_shape import pulses_in_burst
from primary_proc.choices import METHODS
from primary_proc.parameters import ExtractorParameters
from radar_common.frames import TWO_PI

_WHOLE = 1e-3


@dataclass(frozen=True, slots=True)
class Design:
    """Settings of the extractor for one radar.

    Attributes:
        step: azimuth between pulses that they were made for, rad.
        pulses_per_scan: pulses in one turn.
        pulses_in_burst: N_0.
        noise_probability: p_N, probability of a one in noise.
        false_plots_per_scan: what noise is predicted to make.
        longest: limit of a burst, in pulses.
        gap: pulses between bursts that still make one plot.
        accuracy: azimuth accuracy against the burst's peak.
    """

    step: float
    pulses_per_scan: float
    pulses_in_burst: float
    noise_probability: float
    false_plots_per_scan: float
    longest: int
    gap: int
    accuracy: AccuracyTable


def design(parameters: ExtractorParameters, rings: int, step: float) -> Design:
    """Set up the extractor.

    Args:
        parameters: what the user wants.
        rings: range cells of a pulse.
        step: azimuth between pulses, rad.

    Returns:
        The settings.

    Raises:
        ValueError: the beam holds too few pulses for the detector, or the false-plot rate is out of reach.
    """
    method = METHODS[parameters.detector]
    pulses_per_scan = TWO_PI / step
    if abs(pulses_per_scan - round(pulses_per_scan)) < _WHOLE:
        # Rounding in azimuths must not make two designs of one radar.
        pulses_per_scan = float(round(pulses_per_scan))
    pulses = pulses_in_burst(
        parameters.pattern, math.radians(parameters.beamwidth_deg), TWO_PI / pulses_per_scan
    )
    if pulses < method.fewest_pulses:
        raise ValueError(
            f"a beam of {parameters.beamwidth_deg:g} deg holds {pulses:.1f} pulses, "
            f"detector {parameters.detector} needs {method.fewest_pulses}"
        )
    gap = round(parameters.merge_gap * pulses)
    noise = method.noise_probability(parameters.false_plots_per_scan, rings, pulses_per_scan, gap)
    return Design(
        step=step,
        pulses_per_scan=pulses_per_scan,
        pulses_in_burst=pulses,
        noise_probability=noise,
        false_plots_per_scan=parameters.false_plots_per_scan,
        longest=math.ceil(parameters.longest_burst * pulses),
        gap=gap,
        accuracy=method.accuracy(noise, parameters.pattern, pulses, parameters.fluctuation),
    )
