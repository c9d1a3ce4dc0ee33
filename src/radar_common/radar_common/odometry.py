# SPDX-License-Identifier: Apache-2.0
"""A platform's pose and motion as `nav_msgs/Odometry`, in both directions.

Position is ENU in the site's frame, the yaw follows from the course, and the twist is that of the body (REP-103: x
forward, y to the left), as the message wants it. Like the codec of tables it is handed the message classes.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from radar_common.cloud import TableError
from radar_common.frames import azimuth_from_yaw, yaw_from_azimuth
from radar_common.tables import NANOSECONDS, SITE_FRAME

PLATFORM_FRAME = "platform"

_UNIT_TOLERANCE = 1e-2


@dataclass(frozen=True, slots=True)
class PlatformState:
    """Where a platform is and how it moves.

    Attributes:
        stamp: nanoseconds since the epoch of the clock in use.
        x: m east.
        y: m north.
        z: m up.
        course: where its nose points, rad clockwise from north.
        vx: m/s east.
        vy: m/s north.
        vz: m/s up.
        turn_rate: of the course, rad/s clockwise.
        position_variance: of x and of y, m²; 0 where the message gives none.
        frame_id: frame of position and course.
    """

    stamp: int
    x: float
    y: float
    z: float
    course: float
    vx: float
    vy: float
    vz: float = 0.0
    turn_rate: float = 0.0
    position_variance: float = 0.0
    frame_id: str = SITE_FRAME


@dataclass(frozen=True, slots=True)
class OdometryTypes:
    """The classes of one message family that an Odometry is built of."""

    Odometry: Callable[..., Any]
    PoseWithCovariance: Callable[..., Any]
    Pose: Callable[..., Any]
    Point: Callable[..., Any]
    Quaternion: Callable[..., Any]
    TwistWithCovariance: Callable[..., Any]
    Twist: Callable[..., Any]
    Vector3: Callable[..., Any]
    Header: Callable[..., Any]
    Time: Callable[..., Any]


def encode_odometry(state: PlatformState, types: OdometryTypes) -> Any:
    """Write a platform's state as an odometry message.

    Args:
        state: what to write.
        types: message classes to build with.

    Returns:
        An Odometry of `types`.
    """
    yaw = float(yaw_from_azimuth(state.course))
    seconds, nanoseconds = divmod(state.stamp, NANOSECONDS)
    cosine, sine = math.cos(yaw), math.sin(yaw)
    covariance = np.zeros((6, 6))
    covariance[0, 0] = covariance[1, 1] = state.position_variance
    return types.Odometry(
        header=types.Header(
            stamp=types.Time(sec=seconds, nanosec=nanoseconds), frame_id=state.frame_id
        ),
        child_frame_id=PLATFORM_FRAME,
        pose=types.PoseWithCovariance(
            pose=types.Pose(
                position=types.Point(x=state.x, y=state.y, z=state.z),
                orientation=types.Quaternion(
                    x=0.0, y=0.0, z=math.sin(yaw / 2.0), w=math.cos(yaw / 2.0)
                ),
            ),
            covariance=covariance.ravel(),
        ),
        twist=types.TwistWithCovariance(
            twist=types.Twist(
                linear=types.Vector3(
                    x=cosine * state.vx + sine * state.vy,
                    y=cosine * state.vy - sine * state.vx,
                    z=state.vz,
                ),
                angular=types.Vector3(x=0.0, y=0.0, z=-state.turn_rate),
            ),
            covariance=np.zeros(36),
        ),
    )


def decode_odometry(message: Any) -> PlatformState:
    """Read a platform's state; roll and pitch are left out.

    Args:
        message: Odometry of any message family.

    Returns:
        The state, the velocity turned from the body into the frame of the position.

    Raises:
        TableError: a number is not finite, or the quaternion is none.
    """
    position, orientation = message.pose.pose.position, message.pose.pose.orientation
    linear, angular = message.twist.twist.linear, message.twist.twist.angular
    quaternion = (orientation.x, orientation.y, orientation.z, orientation.w)
    numbers = (position.x, position.y, position.z, *quaternion, linear.x, linear.y, linear.z)
    if not all(map(math.isfinite, (*numbers, angular.z))):
        raise TableError("a number is not finite")
    norm = math.hypot(*quaternion)
    if abs(norm - 1.0) > _UNIT_TOLERANCE:
        raise TableError(f"the quaternion has length {norm:.3g}, not 1")
    x, y, z, w = (part / norm for part in quaternion)
    yaw = math.atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))
    cosine, sine = math.cos(yaw), math.sin(yaw)
    stamp = message.header.stamp
    return PlatformState(
        stamp=stamp.sec * NANOSECONDS + stamp.nanosec,
        x=position.x,
        y=position.y,
        z=position.z,
        course=float(azimuth_from_yaw(yaw)),
        vx=cosine * linear.x - sine * linear.y,
        vy=sine * linear.x + cosine * linear.y,
        vz=linear.z,
        turn_rate=-angular.z,
        position_variance=_position_variance(
            *(float(message.pose.covariance[i]) for i in (0, 1, 7))
        ),
        frame_id=message.header.frame_id,
    )


def _position_variance(xx: float, xy: float, yy: float) -> float:
    # Who knows no covariance leaves zeros, or marks it with -1; what is not positive definite is none either.
    definite = xx > 0.0 and yy > 0.0 and xx * yy > xy * xy
    return 0.5 * (xx + yy) if definite and math.isfinite(xx + yy) else 0.0
