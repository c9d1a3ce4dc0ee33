# SPDX-License-Identifier: Apache-2.0
"""A bag held against its truth: everything that scores and figures are computed from."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from radar_eval.antenna import Rotation, estimate_rotation
from radar_eval.bag_tables import BagTables
from radar_eval.errors import ScoreError
from radar_eval.labelling import FALSE, Gates, Labels, label_plots
from radar_eval.track_history import TrackHistory, trace_tracks
from radar_eval.truth_paths import Looks, TruthPaths

FloatArray = npt.NDArray[np.float64]


@dataclass(frozen=True, kw_only=True, slots=True)
class ScoreOptions:
    """What counts as what.

    Attributes:
        gate_range: m, farthest that a plot of a target may lie from it in range.
        gate_azimuth: rad, the same in azimuth.
        scan_period: seconds a turn; None estimates it from the plots.
        longest_gap: scans; a target whose truth is silent for longer counts as absent meanwhile.
        plots_of_target: plots that make an aircraft or ship a target of the tracking scores.
        settled_after: plots of a track after which its position error counts.
        gospa_cutoff: m.
    """

    gate_range: float = 400.0
    gate_azimuth: float = float(np.radians(1.5))
    scan_period: float | None = None
    longest_gap: float = 10.0
    plots_of_target: int = 10
    settled_after: int = 10
    gospa_cutoff: float = 1000.0

    def __post_init__(self) -> None:
        """Refuse values that mean nothing."""
        periods = [] if self.scan_period is None else [self.scan_period]
        for value in (self.gate_range, self.gate_azimuth, self.gospa_cutoff, *periods):
            if not 0.0 < value < np.inf:
                raise ScoreError(f"gates, scan period and cutoff must be positive, got {value:g}")


@dataclass(frozen=True, slots=True)
class Evaluation:
    """A bag held against its truth.

    Attributes:
        tables: what the bag holds.
        options: what counts as what.
        rotation: of the antenna, in seconds after the bag's origin.
        paths: of the targets.
        looks: passes of the antenna over the targets.
        labels: which plot came from which target.
        history: which track followed which target.
        plots_of: number of plots of each target, shape (targets,).
        seen_from: seconds of the first plot of each target, infinite without one.
        seen_until: seconds of its last plot.
    """

    tables: BagTables
    options: ScoreOptions
    rotation: Rotation
    paths: TruthPaths
    looks: Looks
    labels: Labels
    history: TrackHistory
    plots_of: npt.NDArray[np.int64]
    seen_from: FloatArray
    seen_until: FloatArray

    @property
    def is_target(self) -> npt.NDArray[np.bool_]:
        """Which of the paths count as targets of the tracking scores, shape (targets,)."""
        return self.plots_of >= self.options.plots_of_target

    @property
    def scans(self) -> float:
        """Turns of the antenna that the bag covers."""
        return max(1.0, (self.tables.stop - self.tables.start) / self.rotation.period)


def evaluate(tables: BagTables, options: ScoreOptions) -> Evaluation:
    """Hold a bag against its truth.

    Args:
        tables: what the bag holds.
        options: what counts as what.

    Returns:
        The evaluation.

    Raises:
        ScoreError: the bag has no truth.
        RotationError: the plots do not tell how the antenna turned.
    """
    if not len(tables.truth):
        raise ScoreError("no truth in the bag; name a bag that has it with --truth")
    plots = tables.plots
    rotation = estimate_rotation(plots.time, plots.rows["azimuth"], period=options.scan_period)
    paths = TruthPaths(tables.truth, longest_gap=options.longest_gap * rotation.period)
    looks = paths.looks(rotation)
    during = (looks.time >= tables.start - 1e-6) & (looks.time <= tables.stop + 1e-6)
    looks = looks[during]
    gates = Gates(options.gate_range, options.gate_azimuth, 0.1 * rotation.period)
    labels = label_plots(plots, paths, looks, gates)
    own = labels.target != FALSE
    target, time = labels.target[own], plots.time[own]
    seen_from, seen_until = np.full(len(paths), np.inf), np.full(len(paths), -np.inf)
    np.minimum.at(seen_from, target, time)
    np.maximum.at(seen_until, target, time)
    return Evaluation(
        tables=tables,
        options=options,
        rotation=rotation,
        paths=paths,
        looks=looks,
        labels=labels,
        history=trace_tracks(tables.tracks, plots, labels.target),
        plots_of=np.bincount(target, minlength=len(paths)),
        seen_from=seen_from,
        seen_until=seen_until,
    )
