# SPDX-License-Identifier: Apache-2.0
"""How a simulator starts from the command line: as a node, or straight into a bag."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Sequence
from typing import Any

import rclpy
from rclpy.node import Node
from rclpy.utilities import remove_ros_args

from radar_common.parameters import ParameterError, Parameters
from radar_common.ros.parameters import NodeParameters
from radar_common.ros.run import EXIT_BAD_PARAMETERS, run
from radar_sim.recording import RecordingError


def run_or_record(
    create_node: Callable[[], Node],
    parameters: type[Parameters],
    record: Callable[..., None],
    *,
    name: str,
    description: str,
    args: Sequence[str] | None,
) -> int:
    """Run a simulator's node, or write a bag where the command line says so.

    Args:
        create_node: makes the node.
        parameters: of the node.
        record: takes parameters, path, storage and report, and writes the bag.
        name: of the node.
        description: for --help.
        args: command line without the program's name, None for that of the process.

    Returns:
        Exit code: 0 at the end of the simulation or after an interrupt, 2 if it cannot start.
    """
    given = sys.argv[1:] if args is None else list(args)
    options = _parse(given, name, description)
    if options.bag is None:
        return run(create_node, args)
    rclpy.init(args=given)
    try:
        # Only a node knows how --ros-args become parameters.
        node = rclpy.create_node(name, enable_rosout=False, start_parameter_services=False)
        values = NodeParameters(node, parameters).values
        record(values, options.bag, storage=options.storage, report=node.get_logger().info)
    except (ParameterError, RecordingError) as error:
        print(f"cannot start: {error}", file=sys.stderr)
        return EXIT_BAD_PARAMETERS
    finally:
        rclpy.try_shutdown()
    return 0


def _parse(given: list[str], name: str, description: str) -> Any:
    parser = argparse.ArgumentParser(prog=name, description=description)
    parser.add_argument("--bag", help="write into this new bag instead of publishing")
    parser.add_argument("--storage", choices=("mcap", "sqlite3"), default="mcap", help="of the bag")
    # rcl takes no empty list; the program's name makes sure of it.
    return parser.parse_args(remove_ros_args(args=[name, *given])[1:])
