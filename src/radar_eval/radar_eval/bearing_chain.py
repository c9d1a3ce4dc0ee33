# SPDX-License-Identifier: Apache-2.0
"""The direction finder of an offline run: bearings become fused ones beside a radar, and emitters on a platform."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from bearing_tracker.bearing_fusion import BearingFusion
from bearing_tracker.emitter_locator import EmitterLocator
from bearing_tracker.fusion_parameters import FusionParameters
from bearing_tracker.locator_parameters import LocatorParameters
from radar_common.odometry import PlatformState
from radar_common.tables import (
    BEARING,
    BEARINGS_TOPIC,
    EMITTERS_TOPIC,
    FUSED_BEARINGS_TOPIC,
    PLATFORM_TOPIC,
    PLOT,
    PLOTS_TOPIC,
    TRACK,
    TRACKS_TOPIC,
    Table,
)
from radar_eval.stages import Stage, make_stage

FUSION_NODE, LOCATOR_NODE = "bearing_fusion", "emitter_locator"


class BearingChain:
    """Fusion and locator, each where there is something for it to do."""

    def __init__(self, *, fuse: bool, locate: bool, parameters: str | Path | None) -> None:
        """Build the pipelines.

        Args:
            fuse: whether bearings are fused with those of a radar.
            locate: whether emitters are located.
            parameters: ROS 2 parameter file; None takes the defaults.

        Raises:
            ParameterError: the parameter file is wrong.
        """
        self.stages: dict[str, Stage] = {}
        """By names of the nodes."""
        self.active = ""
        """Topic of the active channel; empty without a fusion."""
        if fuse:
            stage = make_stage(BearingFusion, FusionParameters, parameters, FUSION_NODE)
            self.stages[FUSION_NODE] = stage
            plots = stage.pipeline.parameters.active_input == "plots"
            self.active = PLOTS_TOPIC if plots else TRACKS_TOPIC
        if locate:
            self.stages[LOCATOR_NODE] = make_stage(
                EmitterLocator, LocatorParameters, parameters, LOCATOR_NODE
            )

    def process(self, topic: str, content: Table | PlatformState) -> Iterator[tuple[str, Table]]:
        """Take in one message of any topic; those that no node hears do nothing.

        Args:
            topic: of the message.
            content: of it.

        Yields:
            (topic, table): fused bearings and emitters.
        """
        fusion, locator = (self.stages.get(node) for node in (FUSION_NODE, LOCATOR_NODE))
        if isinstance(content, PlatformState):
            if locator is not None and topic == PLATFORM_TOPIC:
                found = locator.timed(lambda: locator.pipeline.process_platform(content))
                # Fixes come often, and most of them bring no bearing with them.
                if len(found.rows):
                    yield EMITTERS_TOPIC, found
            return
        if fusion is not None and topic in (self.active, BEARINGS_TOPIC):
            yield FUSED_BEARINGS_TOPIC, fusion.process(_plain(topic, content))
        if locator is not None and topic == BEARINGS_TOPIC:
            yield EMITTERS_TOPIC, locator.process(_plain(topic, content))

    def flush(self) -> Iterator[tuple[str, Table]]:
        """Give out what still waits for messages to come.

        Yields:
            (topic, table).
        """
        for node, topic in ((FUSION_NODE, FUSED_BEARINGS_TOPIC), (LOCATOR_NODE, EMITTERS_TOPIC)):
            if node in self.stages:
                last = self.stages[node].flush()
                if len(last.rows):
                    yield topic, last


_LAYOUTS = {PLOTS_TOPIC: PLOT, TRACKS_TOPIC: TRACK, BEARINGS_TOPIC: BEARING}


def _plain(topic: str, table: Table) -> Table:
    # A message may carry more fields; the pipelines take the documented ones and nothing else.
    return Table(table.stamp, table.rows.astype(_LAYOUTS[topic], copy=False), table.frame_id)
