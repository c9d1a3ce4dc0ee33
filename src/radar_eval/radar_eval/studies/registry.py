# SPDX-License-Identifier: Apache-2.0
"""Every study that the command `study` knows."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from radar_eval.errors import EvaluationError
from radar_eval.studies.channel_fusion import study_channel_fusion
from radar_eval.studies.clutter import study_clutter
from radar_eval.studies.countermeasures import study_countermeasures
from radar_eval.studies.emitter_location import study_emitter_location
from radar_eval.studies.initiation import study_initiation
from radar_eval.studies.sensitivity import study_sensitivity
from radar_eval.studies.smoothers import study_smoothers
from radar_eval.studies.tracking import study_tracking


@dataclass(frozen=True, slots=True)
class Study:
    """A measurement of the packages, with pictures.

    Attributes:
        name: by which it is called.
        title: one line for people.
        run: takes the folder for pictures and gives the numbers.
    """

    name: str
    title: str
    run: Callable[[Path], dict[str, Any]]


STUDIES: dict[str, Study] = {
    study.name: study
    for study in [
        Study(
            "channel_fusion",
            "a bearing from two channels that are jammed and silent for a while, moment by moment",
            study_channel_fusion,
        ),
        Study(
            "clutter",
            "false plots and detected targets in clutter, by normaliser and criterion control",
            study_clutter,
        ),
        Study(
            "countermeasures",
            "fused bearings against the better of two channels, jammed and silent, at every moment",
            study_countermeasures,
        ),
        Study(
            "emitter_location",
            "emitters located from bearings, every filter beside the Cramer-Rao bound",
            study_emitter_location,
        ),
        Study(
            "initiation",
            "false tracks an hour against delay of confirmation, for every rule of initiation",
            study_initiation,
        ),
        Study(
            "sensitivity",
            "what every detector loses against the ideal integrator, predicted and measured",
            study_sensitivity,
        ),
        Study(
            "smoothers",
            "every smoother of the tracker on the same flights, straight and manoeuvring",
            study_smoothers,
        ),
        Study(
            "tracking",
            "the tracker with all its strategies and Stone Soup's on the same plots; NEES and NIS",
            study_tracking,
        ),
    ]
}
"""Studies by their names."""


def find_study(name: str) -> Study:
    """Find a study.

    Args:
        name: of it.

    Returns:
        The study.

    Raises:
        EvaluationError: there is none of that name.
    """
    if name not in STUDIES:
        raise EvaluationError(f"no study {name!r}; there are {', '.join(STUDIES)}")
    return STUDIES[name]
