# SPDX-License-Identifier: Apache-2.0
"""Fused bearings drawn: a line of sight from the radar, its colour by the health of the channels."""

from __future__ import annotations

import math

from visualization_msgs.msg import MarkerArray

from bearing_tracker.ros.drawing import CLEAR, DOUBTFUL, draw_label, draw_line, marker
from radar_common.tables import Table

LENGTH = 60e3
"""Metres of a line whose end nobody knows."""

_LIFETIME = 3.0
_EVEN = 0.5


def bearing_markers(bearings: Table, place: tuple[float, float]) -> MarkerArray:
    """Draw the last row of every target.

    Args:
        bearings: dtype BEARING.
        place: of the radar, metres east and north.

    Returns:
        A line and a label for each; the label says which channel is probably disturbed.
    """
    message = MarkerArray()
    for row in {int(row["id"]): row for row in bearings.rows}.values():
        azimuth, offset, number = float(row["azimuth"]), float(row["time_offset"]), int(row["id"])
        words = [
            word
            for word, health in (
                ("jammed", row["active_health"]),
                ("silent", row["passive_health"]),
            )
            if health[1] > _EVEN
        ]
        colour = DOUBTFUL if words else CLEAR
        end = (place[0] + LENGTH * math.sin(azimuth), place[1] + LENGTH * math.cos(azimuth))
        line = marker(bearings, number, offset, "bearing", _LIFETIME, colour)
        draw_line(line, place, end)
        label = marker(bearings, number, offset, "label", _LIFETIME, colour)
        draw_label(label, end, " ".join([str(number), f"{math.degrees(azimuth):.1f}°", *words]))
        message.markers += [line, label]
    return message
