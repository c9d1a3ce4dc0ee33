# SPDX-License-Identifier: Apache-2.0
"""Markers that the nodes have in common: a line of sight and a label."""

from __future__ import annotations

from builtin_interfaces.msg import Duration
from geometry_msgs.msg import Point
from rclpy.time import Time
from std_msgs.msg import ColorRGBA
from visualization_msgs.msg import Marker

from radar_common.tables import NANOSECONDS, Table

CLEAR = ColorRGBA(r=0.2, g=0.9, b=0.3, a=1.0)
DOUBTFUL = ColorRGBA(r=1.0, g=0.7, b=0.1, a=1.0)
TRANSPARENT = ColorRGBA(r=0.2, g=0.9, b=0.3, a=0.5)
FAINT = ColorRGBA(r=0.6, g=0.7, b=1.0, a=0.7)

_LINE_WIDTH = 120.0
_LABEL_HEIGHT = 1200.0


def marker(
    table: Table, number: int, offset: float, namespace: str, lifetime: float, colour: ColorRGBA
) -> Marker:
    """Begin a marker of one row.

    Args:
        table: that the row is of.
        number: id of the row.
        offset: of its time from the table's stamp, seconds.
        namespace: of the marker.
        lifetime: seconds that it is shown.
        colour: of it.

    Returns:
        A marker without shape.
    """
    seconds, nanoseconds = divmod(round(lifetime * NANOSECONDS), NANOSECONDS)
    drawn = Marker(
        ns=namespace,
        # A marker's id is signed.
        id=(number & 0x7FFFFFFF),
        lifetime=Duration(sec=seconds, nanosec=nanoseconds),
        action=Marker.ADD,
        color=colour,
    )
    drawn.header.frame_id = table.frame_id
    time = table.stamp + round(offset * NANOSECONDS)
    drawn.header.stamp = Time(nanoseconds=max(time, 0)).to_msg()
    drawn.pose.orientation.w = 1.0
    return drawn


def draw_line(drawn: Marker, begin: tuple[float, float], end: tuple[float, float]) -> None:
    """Make a marker a line on the ground.

    Args:
        drawn: the marker.
        begin: metres east and north.
        end: metres east and north.
    """
    drawn.type = Marker.LINE_STRIP
    drawn.points = [Point(x=x, y=y, z=0.0) for x, y in (begin, end)]
    drawn.scale.x = _LINE_WIDTH


def draw_label(drawn: Marker, place: tuple[float, float], text: str) -> None:
    """Make a marker a text.

    Args:
        drawn: the marker.
        place: metres east and north.
        text: what it says.
    """
    drawn.type = Marker.TEXT_VIEW_FACING
    drawn.pose.position.x, drawn.pose.position.y = place
    drawn.pose.position.z = _LABEL_HEIGHT
    drawn.scale.z = _LABEL_HEIGHT
    drawn.text = text
