# SPDX-License-Identifier: Apache-2.0
"""The radar of an offline run: sweeps become plots, plots become tracks."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from primary_proc.parameters import ExtractorParameters
from primary_proc.plot_extractor import PlotExtractor
from radar_common.tables import PLOT, PLOTS_TOPIC, SWEEPS_TOPIC, TRACKS_TOPIC, Table
from radar_eval.stages import Stage, make_stage
from secondary_proc.parameters import TrackerParameters
from secondary_proc.tracker import Tracker

EXTRACTOR_NODE, TRACKER_NODE = "plot_extractor", "tracker"


class RadarChain:
    """Extractor and tracker, or the tracker alone."""

    def __init__(self, source: str, parameters: str | Path | None) -> None:
        """Build the pipelines.

        Args:
            source: topic to begin with, that of sweeps or of plots.
            parameters: ROS 2 parameter file; None takes the defaults.

        Raises:
            ParameterError: the parameter file is wrong.
        """
        self.source = source
        self.stages: dict[str, Stage] = {}
        """By names of the nodes."""
        self.plots = 0
        """Plots that came through."""
        if source == SWEEPS_TOPIC:
            self.stages[EXTRACTOR_NODE] = make_stage(
                PlotExtractor, ExtractorParameters, parameters, EXTRACTOR_NODE
            )
        self.stages[TRACKER_NODE] = make_stage(Tracker, TrackerParameters, parameters, TRACKER_NODE)

    def process(self, table: Table) -> Iterator[tuple[str, Table]]:
        """Take in one message of the source.

        Args:
            table: message.

        Yields:
            (topic, table): plots, then tracks.

        Raises:
            TableError: it is no table of its kind.
        """
        if self.source == SWEEPS_TOPIC:
            table = self.stages[EXTRACTOR_NODE].process(table)
        yield from self._track(table)

    def flush(self) -> Iterator[tuple[str, Table]]:
        """Give out what still waits for messages to come.

        Yields:
            (topic, table).
        """
        if EXTRACTOR_NODE in self.stages:
            last = self.stages[EXTRACTOR_NODE].flush()
            if len(last.rows):
                yield from self._track(last)
        tracks = self.stages[TRACKER_NODE].flush()
        if len(tracks.rows):
            yield TRACKS_TOPIC, tracks

    def _track(self, table: Table) -> Iterator[tuple[str, Table]]:
        # A message may carry more fields than a plot has; the pipelines take plots and nothing else.
        plots = Table(table.stamp, table.rows.astype(PLOT, copy=False), table.frame_id)
        self.plots += len(plots.rows)
        yield PLOTS_TOPIC, plots
        yield TRACKS_TOPIC, self.stages[TRACKER_NODE].process(plots)
