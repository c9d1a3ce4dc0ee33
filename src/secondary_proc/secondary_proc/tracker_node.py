# SPDX-License-Identifier: Apache-2.0
"""ROS 2 node `tracker`: radar/plots in; radar/tracks and markers for viewers out."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from builtin_interfaces.msg import Duration
from geometry_msgs.msg import Point
from rclpy.node import Node
from rclpy.time import Time
from std_msgs.msg import ColorRGBA
from visualization_msgs.msg import Marker, MarkerArray

from radar_common.health import Health
from radar_common.ros.diagnostics import Diagnostics
from radar_common.ros.messages import TablePublisher, TableSubscription
from radar_common.ros.parameters import NodeParameters
from radar_common.ros.run import run
from radar_common.tables import NANOSECONDS, PLOT, PLOTS_TOPIC, TRACKS_TOPIC, Table, TrackStatus
from secondary_proc.parameters import TrackerParameters
from secondary_proc.state_file import StateFile
from secondary_proc.tracker import Tracker

NODE_NAME = "tracker"
MARKERS_TOPIC = "radar/track_markers"

_LOOK_AHEAD = 30.0
"""Seconds of flight that the arrow of a velocity shows."""
_LIFETIME_SCANS = 2.5
_ARROW_WIDTH = 150.0
_LABEL_HEIGHT = 1200.0
_COLOURS = {
    TrackStatus.CONFIRMED: ColorRGBA(r=0.2, g=0.9, b=0.3, a=1.0),
    TrackStatus.COASTING: ColorRGBA(r=1.0, g=0.7, b=0.1, a=1.0),
}


class TrackerNode(Node):
    """Runs one Tracker on the plots that arrive."""

    def __init__(self, **node_options: Any) -> None:
        """Wait for plots.

        Args:
            node_options: passed on to rclpy's Node.

        Raises:
            ParameterError: the parameters are impossible.
        """
        super().__init__(NODE_NAME, **node_options)
        self._health = Health()
        self._settings = NodeParameters(self, TrackerParameters, self._change)
        values = self._settings.values
        self._tracker = Tracker(values, self._health)
        self._state = StateFile(values.state_file, values.state_interval, self._health)
        self._state.restore(self._tracker)
        self._tracks = TablePublisher(self, TRACKS_TOPIC)
        self._markers = self.create_publisher(MarkerArray, MARKERS_TOPIC, 10)
        self._plots = TableSubscription(
            self, PLOTS_TOPIC, self._receive, self._health, expected=PLOT
        )
        self._diagnostics = Diagnostics(self, self._health)

    def _change(self, parameters: TrackerParameters) -> None:
        self._tracker.reconfigure(parameters)

    def _receive(self, plots: Table) -> None:
        tracks = self._tracker.process(plots)
        self._tracks.publish(tracks)
        self._state.keep(self._tracker, plots.stamp)
        if len(tracks.rows) and self._markers.get_subscription_count():
            self._markers.publish(markers(tracks, self._tracker.period))


def markers(tracks: Table, period: float) -> MarkerArray:
    """Draw tracks for a viewer: an arrow for the velocity and a label; tentative tracks stay unseen.

    Args:
        tracks: dtype TRACK.
        period: of the antenna, seconds, which sets how long a marker is shown.

    Returns:
        Markers with the track's id; those of ended tracks are deleted.
    """
    seconds, nanoseconds = divmod(round(_LIFETIME_SCANS * period * NANOSECONDS), NANOSECONDS)
    lifetime = Duration(sec=seconds, nanosec=nanoseconds)
    message = MarkerArray()
    shown = tracks.rows["status"] != TrackStatus.TENTATIVE
    # The last row of a track is its present state.
    _, last = np.unique(tracks.rows["id"][shown][::-1], return_index=True)
    for row in tracks.rows[shown][::-1][last]:
        for namespace, draw in (("velocity", _arrow), ("label", _label)):
            marker = Marker(ns=namespace, id=int(row["id"]) & 0x7FFFFFFF, lifetime=lifetime)
            marker.header.frame_id = tracks.frame_id
            time = tracks.stamp + round(float(row["time_offset"]) * NANOSECONDS)
            marker.header.stamp = Time(nanoseconds=max(time, 0)).to_msg()
            if row["status"] == TrackStatus.ENDED:
                marker.action = Marker.DELETE
            else:
                marker.action = Marker.ADD
                marker.color = _COLOURS[TrackStatus(int(row["status"]))]
                draw(marker, row)
            message.markers.append(marker)
    return message


def _arrow(marker: Marker, row: np.void) -> None:
    marker.type = Marker.ARROW
    x, y, z, vx, vy = (float(row[name]) for name in ("x", "y", "z", "vx", "vy"))
    marker.points = [
        Point(x=x, y=y, z=z),
        Point(x=x + vx * _LOOK_AHEAD, y=y + vy * _LOOK_AHEAD, z=z),
    ]
    marker.scale.x, marker.scale.y = _ARROW_WIDTH, 3.0 * _ARROW_WIDTH
    marker.pose.orientation.w = 1.0


def _label(marker: Marker, row: np.void) -> None:
    marker.type = Marker.TEXT_VIEW_FACING
    marker.pose.position.x, marker.pose.position.y = float(row["x"]), float(row["y"])
    marker.pose.position.z = float(row["z"]) + _LABEL_HEIGHT
    marker.pose.orientation.w = 1.0
    marker.scale.z = _LABEL_HEIGHT
    marker.text = f"{row['id']} {row['speed']:.0f} m/s"


def main(args: Sequence[str] | None = None) -> int:
    """Run the node until it is interrupted.

    Args:
        args: command line without the program's name, None for that of the process.

    Returns:
        Exit code: 0 after an interrupt, 2 if it cannot start.
    """
    return run(TrackerNode, args)
