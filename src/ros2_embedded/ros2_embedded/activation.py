# SPDX-License-Identifier: Apache-2.0
"""Offer ``rclpy`` and the message packages to programs where no ROS 2 is installed.

A ``.pth`` file calls :func:`activate` at every interpreter start. The finder it installs
stands last in ``sys.meta_path``: it is asked only for modules that nobody else has, so a
sourced ROS 2 always wins. Nothing is imported before a program asks for it.
"""

from __future__ import annotations

import sys

TYPE_CHECKING = False  # as in typing, whose import every interpreter start would pay for

if TYPE_CHECKING:
    from collections.abc import Sequence
    from importlib.machinery import ModuleSpec
    from types import ModuleType

#: Message packages of the common ROS 2 Jazzy distribution that are supplied.
MESSAGE_PACKAGES = frozenset(
    {
        "action_msgs",
        "actionlib_msgs",
        "builtin_interfaces",
        "diagnostic_msgs",
        "geometry_msgs",
        "lifecycle_msgs",
        "nav_msgs",
        "rcl_interfaces",
        "rmw_dds_common",
        "rosbag2_interfaces",
        "rosgraph_msgs",
        "sensor_msgs",
        "service_msgs",
        "shape_msgs",
        "statistics_msgs",
        "std_msgs",
        "std_srvs",
        "stereo_msgs",
        "tf2_msgs",
        "trajectory_msgs",
        "type_description_interfaces",
        "unique_identifier_msgs",
        "visualization_msgs",
    }
)


class EmbeddedFinder:
    """Meta-path finder for ``rclpy`` and the message packages."""

    def find_spec(
        self,
        fullname: str,
        path: Sequence[str] | None = None,
        target: ModuleType | None = None,
    ) -> ModuleSpec | None:
        """Find a supplied module.

        Args:
            fullname: Dotted name of the module.
            path: Search path of the parent package, not used.
            target: Module to reload, not used.

        Returns:
            The specification, or None if the module is not supplied here, or not now
            because another ``rclpy`` is installed.
        """
        package = fullname.partition(".")[0]
        if package == "rclpy":
            return _rclpy_spec() if fullname == "rclpy" else None
        if package not in MESSAGE_PACKAGES or _foreign_rclpy():
            return None
        from ros2_embedded.messages.packages import find_spec

        return find_spec(fullname)


def _rclpy_spec() -> ModuleSpec | None:
    from importlib.util import spec_from_file_location
    from pathlib import Path

    directory = Path(__file__).parent / "site" / "rclpy"
    return spec_from_file_location(
        "rclpy", directory / "__init__.py", submodule_search_locations=[str(directory)]
    )


def _foreign_rclpy() -> bool:
    """Tell whether someone else supplies ``rclpy``; then its messages must be used too."""
    return any(
        finder.find_spec("rclpy", None) is not None
        for finder in sys.meta_path
        if not isinstance(finder, EmbeddedFinder) and hasattr(finder, "find_spec")
    )


def activate() -> None:
    """Append the finder to ``sys.meta_path`` unless it stands there."""
    if not any(isinstance(finder, EmbeddedFinder) for finder in sys.meta_path):
        sys.meta_path.append(EmbeddedFinder())
