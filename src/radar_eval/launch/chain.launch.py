# SPDX-License-Identifier: Apache-2.0
"""Start the whole chain: simulator, plot extractor and tracker, joined by topics."""

from __future__ import annotations

from pathlib import Path

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue

CHAIN = (
    ("secondary_proc", "tracker"),
    ("primary_proc", "plot_extractor"),
    ("radar_sim", "radar_simulator"),
)
SIMULATION = (
    ("scenario", "airport", str, "name of a scenario of radar_sim, or path of a YAML file"),
    ("seed", "1", int, "of traffic, noise and fluctuation"),
    ("scans", "0", int, "turns to simulate, 0 without end"),
    ("rate", "1.0", float, "simulated seconds a second, 0 as fast as possible"),
)


def default_parameters(package: str, node: str) -> str:
    return str(Path(get_package_share_directory(package)) / "config" / f"{node}.yaml")


def generate_launch_description() -> LaunchDescription:
    arguments = [
        DeclareLaunchArgument("namespace", default_value="", description="of all three nodes"),
        DeclareLaunchArgument(
            "use_sim_time", default_value="false", description="whether to follow /clock"
        ),
    ]
    arguments += [
        DeclareLaunchArgument(name, default_value=default, description=text)
        for name, default, _, text in SIMULATION
    ]
    arguments += [
        DeclareLaunchArgument(
            f"{node}_params",
            default_value=default_parameters(package, node),
            description=f"ROS 2 parameter file of {node}",
        )
        for package, node in CHAIN
    ]
    simulation = {
        name: ParameterValue(LaunchConfiguration(name), value_type=kind)
        for name, _, kind, _ in SIMULATION
    }
    nodes = [
        Node(
            package=package,
            executable=node,
            name=node,
            namespace=LaunchConfiguration("namespace"),
            output="screen",
            parameters=[
                LaunchConfiguration(f"{node}_params"),
                {"use_sim_time": LaunchConfiguration("use_sim_time")},
                *([simulation] if node == "radar_simulator" else []),
            ],
        )
        for package, node in CHAIN
    ]
    return LaunchDescription(arguments + nodes)
