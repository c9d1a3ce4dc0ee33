# SPDX-License-Identifier: Apache-2.0
"""The message classes of a running ROS 2 that `radar_common.odometry` builds with."""

from __future__ import annotations

from builtin_interfaces.msg import Time
from geometry_msgs.msg import (
    Point,
    Pose,
    PoseWithCovariance,
    Quaternion,
    Twist,
    TwistWithCovariance,
    Vector3,
)
from nav_msgs.msg import Odometry
from std_msgs.msg import Header

from radar_common.odometry import OdometryTypes

ODOMETRY_TYPES = OdometryTypes(
    Odometry=Odometry,
    PoseWithCovariance=PoseWithCovariance,
    Pose=Pose,
    Point=Point,
    Quaternion=Quaternion,
    TwistWithCovariance=TwistWithCovariance,
    Twist=Twist,
    Vector3=Vector3,
    Header=Header,
    Time=Time,
)
