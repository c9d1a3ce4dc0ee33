# SPDX-License-Identifier: Apache-2.0
"""Start the fusion of angle channels."""

from __future__ import annotations

from pathlib import Path

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description() -> LaunchDescription:
    config = Path(get_package_share_directory("bearing_tracker")) / "config" / "bearing_fusion.yaml"
    return LaunchDescription(
        [
            DeclareLaunchArgument(
                "name", default_value="bearing_fusion", description="name of the node"
            ),
            DeclareLaunchArgument("namespace", default_value="", description="its namespace"),
            DeclareLaunchArgument(
                "params", default_value=str(config), description="ROS 2 parameter file"
            ),
            DeclareLaunchArgument(
                "use_sim_time", default_value="false", description="whether to follow /clock"
            ),
            Node(
                package="bearing_tracker",
                executable="bearing_fusion",
                name=LaunchConfiguration("name"),
                namespace=LaunchConfiguration("namespace"),
                output="screen",
                parameters=[
                    LaunchConfiguration("params"),
                    {"use_sim_time": LaunchConfiguration("use_sim_time")},
                ],
            ),
        ]
    )
