# SPDX-License-Identifier: Apache-2.0
"""Emitters drawn: a ray while only their direction is known, an ellipse of their error as soon as their range is."""

from __future__ import annotations

import math

import numpy as np
from geometry_msgs.msg import PoseWithCovarianceStamped
from rclpy.time import Time
from visualization_msgs.msg import Marker, MarkerArray

from bearing_tracker.ros.drawing import CLEAR, FAINT, TRANSPARENT, draw_label, draw_line, marker
from radar_common.tables import NANOSECONDS, Table, TrackStatus

_LIFETIME = 10.0
_SIGMAS = 2.0
_THINNEST = 20.0


def emitter_markers(emitters: Table, reach: float) -> MarkerArray:
    """Draw confirmed emitters; those that ended are deleted.

    Args:
        emitters: dtype EMITTER.
        reach: length of a ray, metres.

    Returns:
        A ray from the platform or an ellipse of two standard deviations, and a label, with the emitter's id.
    """
    message = MarkerArray()
    for row in {int(row["id"]): row for row in emitters.rows}.values():
        if row["status"] == TrackStatus.TENTATIVE:
            continue
        colour = CLEAR if row["range_known"] else FAINT
        offset, number = float(row["time_offset"]), int(row["id"])
        ray, ellipse, label = (
            marker(emitters, number, offset, namespace, _LIFETIME, colour)
            for namespace in ("ray", "ellipse", "label")
        )
        if row["status"] == TrackStatus.ENDED:
            for drawn in (ray, ellipse, label):
                drawn.action = Marker.DELETE
        elif row["range_known"]:
            ray.action = Marker.DELETE
            _draw_ellipse(ellipse, row)
        else:
            ellipse.action = Marker.DELETE
            _draw_ray(ray, row, reach)
        place = (float(row["x"]), float(row["y"]))
        words = f"±{row['range_std'] / 1e3:.1f} km" if row["range_known"] else "range unknown"
        draw_label(label, place, f"{number} {words}")
        message.markers += [ray, ellipse, label]
    return message


def pose(emitters: Table, row: np.void) -> PoseWithCovarianceStamped:
    """Write one emitter's place as a message of its own.

    Args:
        emitters: that the row is of.
        row: of dtype EMITTER.

    Returns:
        Position and covariance of east and north; the other elements of the covariance are zero.
    """
    message = PoseWithCovarianceStamped()
    message.header.frame_id = emitters.frame_id
    time = emitters.stamp + round(float(row["time_offset"]) * NANOSECONDS)
    message.header.stamp = Time(nanoseconds=max(time, 0)).to_msg()
    position = message.pose.pose.position
    position.x, position.y, position.z = (float(row[name]) for name in ("x", "y", "z"))
    message.pose.pose.orientation.w = 1.0
    covariance = np.zeros((6, 6))
    covariance[:2, :2] = row["covariance"].reshape(4, 4)[:2, :2]
    message.pose.covariance = covariance.ravel()
    return message


def _draw_ray(drawn: Marker, row: np.void, reach: float) -> None:
    azimuth, distance = float(row["azimuth"]), float(row["range"])
    sine, cosine = math.sin(azimuth), math.cos(azimuth)
    platform = (float(row["x"]) - distance * sine, float(row["y"]) - distance * cosine)
    draw_line(drawn, platform, (platform[0] + reach * sine, platform[1] + reach * cosine))


def _draw_ellipse(drawn: Marker, row: np.void) -> None:
    covariance = row["covariance"].reshape(4, 4)[:2, :2].astype(float)
    variance, axes = np.linalg.eigh(covariance)
    yaw = math.atan2(axes[1, 1], axes[0, 1])
    drawn.type = Marker.CYLINDER
    drawn.pose.position.x, drawn.pose.position.y = float(row["x"]), float(row["y"])
    drawn.pose.position.z = float(row["z"])
    drawn.pose.orientation.z, drawn.pose.orientation.w = math.sin(yaw / 2), math.cos(yaw / 2)
    short, long = 2.0 * _SIGMAS * np.sqrt(np.maximum(variance, 0.0))
    drawn.scale.x, drawn.scale.y = max(float(long), _THINNEST), max(float(short), _THINNEST)
    drawn.scale.z = _THINNEST
    drawn.color = TRANSPARENT
