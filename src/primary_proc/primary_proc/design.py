# SPDX-License-Identifier: Apache-2.0
"""From what the user wants and what the radar does to the settings of the extractor."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

from primary_proc.calculators.pulse.burst_shape import pulses_in_burst
from primary_proc.choices import find_method
from primary_proc.methods.detection_method import SettledMethod
from primary_proc.methods.requirements import Requirements
from primary_proc.parameters import ExtractorParameters
from radar_common.frames import TWO_PI

_WHOLE = 1e-3
_REMEMBERED = 8


@dataclass(frozen=True, slots=True)
class Design:
    """Settings of the extractor for one radar.

    Attributes:
        step: azimuth between pulses that they were made for, rad.
        requirements: what is asked of the detector.
        method: the detector set up for it.
        longest: limit of a burst, in pulses.
    """

    step: float
    requirements: Requirements
    method: SettledMethod
    longest: int


def requirements_for(parameters: ExtractorParameters, rings: int, step: float) -> Requirements:
    """Say what a user and a radar ask of the detector.

    Args:
        parameters: what the user wants.
        rings: range cells of a pulse.
        step: azimuth between pulses, rad.

    Returns:
        The requirements.
    """
    pulses_per_scan = TWO_PI / step
    if abs(pulses_per_scan - round(pulses_per_scan)) < _WHOLE:
        # Rounding in azimuths must not make two designs of one radar.
        pulses_per_scan = float(round(pulses_per_scan))
    pulses = pulses_in_burst(
        parameters.pattern, math.radians(parameters.beamwidth_deg), TWO_PI / pulses_per_scan
    )
    return Requirements(
        false_plots=parameters.false_plots_per_scan,
        rings=rings,
        pulses_per_scan=pulses_per_scan,
        gap=round(parameters.merge_gap * pulses),
        pattern=parameters.pattern,
        pulses=pulses,
        target=parameters.fluctuation,
        snr_db=parameters.weights_snr_db,
        second_threshold=parameters.second_threshold,
        end_zeros=parameters.end_zeros,
        levels=parameters.quantiser_levels,
        level_kind=parameters.level_placement,
    )


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
    requirements = requirements_for(parameters, rings, step)
    return Design(
        step=step,
        requirements=requirements,
        method=settled(parameters.detector, requirements),
        longest=math.ceil(parameters.longest_burst * requirements.pulses),
    )


@lru_cache(maxsize=_REMEMBERED)
def settled(detector: str, requirements: Requirements) -> SettledMethod:
    """Set up a detector; a pause or a change back to an earlier rotation must not cost the set-up again.

    Args:
        detector: its name.
        requirements: what is asked of it.

    Returns:
        The detector with its thresholds.

    Raises:
        ValueError: the beam holds too few pulses for the detector, or the false-plot rate is out of reach.
    """
    method = find_method(detector)
    if requirements.pulses < method.fewest_pulses:
        raise ValueError(
            f"a beam that holds {requirements.pulses:.1f} pulses is too narrow for detector {detector}, "
            f"which needs {method.fewest_pulses}; see beamwidth_deg"
        )
    return method.settle(requirements)
