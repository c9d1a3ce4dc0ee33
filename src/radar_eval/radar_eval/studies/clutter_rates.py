# SPDX-License-Identifier: Apache-2.0
"""False plots and detected targets in clutter: every scenario, every normaliser, with and without criterion control."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
import numpy.typing as npt
from scipy.spatial import cKDTree

from primary_proc.choices import NORMALISERS
from primary_proc.parameters import ExtractorParameters
from primary_proc.plot_extractor import PlotExtractor
from radar_common.health import Health
from radar_common.tables import NANOSECONDS
from radar_eval.studies.clutter_scene import Scene

FloatArray = npt.NDArray[np.float64]

SCENARIOS = ("noise", "jamming", "interference", "rain", "sea", "land", "point_clutter")
WANTED = 10.0
"""False plots a turn that are asked for."""

_SETTLED = 0.6
_RANGE_GATE = 3.0
_CONTROL = (False, True)


@dataclass(frozen=True, slots=True)
class Outcome:
    """What one extractor made of a scene.

    Attributes:
        scenario: name.
        normaliser: name.
        controlled: whether the criterion was raised where it had to be.
        false_plots: in each turn.
        settled: mean false plots a turn over the last turns, when map and criterion have learned.
        clear_looks: looks at weak targets outside clutter in these turns.
        clear_found: share of them with a plot; NaN without looks.
        clutter_looks: looks at strong targets in clutter in these turns.
        clutter_found: share of them with a plot; NaN without looks.
        coverage_raised: share of the coverage with a raised criterion at the end.
        largest_raise_db: at the end.
    """

    scenario: str
    normaliser: str
    controlled: bool
    false_plots: list[int]
    settled: float
    clear_looks: int
    clear_found: float
    clutter_looks: int
    clutter_found: float
    coverage_raised: float
    largest_raise_db: float

    def as_dict(self) -> dict[str, Any]:
        """Give all values by their names."""
        return asdict(self)


def outcomes(scene: Scene, normalisers: Sequence[str] = tuple(NORMALISERS)) -> Iterator[Outcome]:
    """Run extractors over a scene.

    Args:
        scene: sweeps and truth.
        normalisers: names.

    Yields:
        One outcome for each normaliser without and with criterion control.
    """
    for normaliser in normalisers:
        for controlled in _CONTROL:
            yield _outcome(scene, normaliser, controlled)


def _outcome(scene: Scene, normaliser: str, controlled: bool) -> Outcome:
    radar = scene.radar
    default = ExtractorParameters()
    parameters = default.changed(
        {
            "normaliser": normaliser,
            "false_plots_per_scan": WANTED,
            "beamwidth_deg": radar.beamwidth_deg,
            "noise_level": math.sqrt(2.0) * radar.noise_level,
            "largest_raise_db": default.largest_raise_db if controlled else 0.0,
        }
    )
    health = Health()
    time, distance = _extract(PlotExtractor(parameters, health), scene)
    false, found = _matched(scene, time, distance)
    turn = np.floor(time / radar.scan_period).astype(int)
    numbers = np.bincount(np.clip(turn[false], 0, scene.turns - 1), minlength=scene.turns)
    first = int(_SETTLED * scene.turns)
    late = scene.time >= first * radar.scan_period
    clear = late & ~scene.strong & ~scene.in_clutter
    clutter = late & scene.strong & scene.in_clutter
    share, largest = (
        next((w.observed for name, w in health.watches.items() if name.startswith(start)), 0.0)
        for start in ("share of the coverage with a raised", "largest raise")
    )
    return Outcome(
        scenario=scene.name,
        normaliser=normaliser,
        controlled=controlled,
        false_plots=numbers.tolist(),
        settled=float(numbers[first:].mean()),
        clear_looks=int(clear.sum()),
        clear_found=_share(found[clear]),
        clutter_looks=int(clutter.sum()),
        clutter_found=_share(found[clutter]),
        coverage_raised=share,
        largest_raise_db=largest,
    )


def _extract(extractor: PlotExtractor, scene: Scene) -> tuple[FloatArray, FloatArray]:
    """Times, s after the start, and ranges of all plots."""
    tables = [extractor.process(sweeps) for sweeps in scene.sweeps] + [extractor.flush()]
    time = [table.stamp / NANOSECONDS + table.rows["time_offset"] for table in tables]
    return np.concatenate(time), np.concatenate([table.rows["range"] for table in tables])


def _matched(
    scene: Scene, time: FloatArray, distance: FloatArray
) -> tuple[npt.NDArray[np.bool_], npt.NDArray[np.bool_]]:
    """Which plots lie at no target, within three range cells and a beamwidth; and which looks have a plot."""
    radar = scene.radar
    gate = (
        radar.scan_period * radar.beamwidth_deg / 360.0,
        _RANGE_GATE * radar.range_step,
    )
    plots = np.column_stack([time, distance]) / gate
    looks = np.column_stack([scene.time, scene.distance]) / gate
    to_look, _ = cKDTree(looks).query(plots, p=np.inf, distance_upper_bound=1.0)
    to_plot, _ = cKDTree(plots).query(looks, p=np.inf, distance_upper_bound=1.0)
    return np.isinf(to_look), np.isfinite(to_plot)


def _share(found: npt.NDArray[np.bool_]) -> float:
    return float(found.mean()) if len(found) else math.nan
