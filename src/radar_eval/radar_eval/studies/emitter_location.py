# SPDX-License-Identifier: Apache-2.0
"""Every emitter filter beside the Cramer-Rao bound, and what else can happen to the default one."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from bearing_tracker.emitters import DEFAULT_FILTER, FILTERS, CorrelatedError, FilterSettings
from radar_eval.command_line import progress
from radar_eval.figures.emitter_location import draw_emitter_location
from radar_eval.figures.style import as_png
from radar_eval.studies.emitter_location_scenes import LocationScene, aircraft, ship, turning
from radar_eval.studies.emitter_location_trials import LocationOutcome, try_filter

PICTURE = "emitter_location.png"
RUNS = 500

STEADY = FilterSettings(acceleration_std=1e-4)
"""For emitters that keep course and speed: practically no process noise."""

_LASTING_DEG = 0.8


def scenes() -> list[LocationScene]:
    """Give the two scenes on which all filters are compared."""
    return [ship(), aircraft()]


def circumstances() -> list[tuple[LocationScene, str, FilterSettings]]:
    """Give what else the default filter is tried on: scene, circumstance, settings."""
    lasting = aircraft("correlated", "correlated bearing errors", lasting_std_deg=_LASTING_DEG)
    turn = turning()

    def against(treatment: str) -> FilterSettings:
        error = CorrelatedError(std=lasting.lasting_std, time=10.0, treatment=treatment)
        return FilterSettings(acceleration_std=1e-4, correlated=error)

    return [
        (aircraft("stationary", "stationary emitter", speed=0.0), "stationary emitter", STEADY),
        (
            aircraft("zigzag", "courses of 40 degrees", turn_deg=40.0),
            "courses of 40 degrees",
            STEADY,
        ),
        (aircraft("straight", "no manoeuvre", turn_deg=0.0), "observer without manoeuvre", STEADY),
        (
            aircraft(),
            "process noise of 0.05 m/s^2 assumed",
            FilterSettings(acceleration_std=0.05),
        ),
        (lasting, "correlated errors taken for white", STEADY),
        (lasting, "correlated errors inflated", against("inflate")),
        (lasting, "correlated errors estimated", against("augment")),
        (turn, "turning emitter, steady model", FilterSettings(acceleration_std=1e-3)),
        (turn, "turning emitter, one noisy model", FilterSettings(acceleration_std=0.4)),
        (
            turn,
            "turning emitter, interacting models",
            FilterSettings(acceleration_std=1e-3, manoeuvre_std=1.2, quiet_time=1000.0),
        ),
    ]


def compare_filters(runs: int = RUNS, seed: int = 1) -> list[LocationOutcome]:
    """Run all filters on the two scenes.

    Args:
        runs: of each.
        seed: of priors and errors; all filters see the same.

    Returns:
        One outcome a scene and filter.
    """
    pairs = [(scene, name) for scene in scenes() for name in FILTERS]
    return [
        try_filter(scene, name, FILTERS[name](STEADY), runs, seed)
        for scene, name in progress(pairs, "filters", unit="filter")
    ]


def try_circumstances(runs: int = RUNS, seed: int = 1) -> dict[str, LocationOutcome]:
    """Run the default filter under all circumstances.

    Args:
        runs: of each.
        seed: of priors and errors.

    Returns:
        Outcomes by circumstance.
    """
    return {
        title: try_filter(scene, DEFAULT_FILTER, FILTERS[DEFAULT_FILTER](settings), runs, seed)
        for scene, title, settings in progress(circumstances(), "circumstances", unit="scene")
    }


def study_emitter_location(folder: Path, runs: int = RUNS) -> dict[str, Any]:
    """Run the study.

    Args:
        folder: where the picture goes.
        runs: of each filter and scene.

    Returns:
        All outcomes, for JSON.
    """
    outcomes = compare_filters(runs)
    figure = draw_emitter_location(scenes(), outcomes)
    (folder / PICTURE).write_bytes(as_png(figure, dpi=120))
    return {
        "runs": runs,
        "filters": [outcome.as_dict() for outcome in outcomes],
        "circumstances": {
            title: outcome.as_dict() for title, outcome in try_circumstances(runs).items()
        },
    }
