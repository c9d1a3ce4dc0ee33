# SPDX-License-Identifier: Apache-2.0
"""`ros2 service call`."""

from __future__ import annotations

import argparse

import rclpy
import yaml

from ros2_embedded.cli.direct_node import add_node_arguments, direct_node
from ros2_embedded.cli.interfaces import service_class
from ros2_embedded.cli.message_fill import fill_message


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments.

    Args:
        parser: The parser of the verb.
    """
    add_node_arguments(parser)
    parser.add_argument("service_name", help="Name of the ROS service to call to")
    parser.add_argument("service_type", help="Type of the ROS service (e.g. 'std_srvs/srv/Empty')")
    parser.add_argument("values", nargs="?", default="{}", help="Values of the request in YAML")


def main(args: argparse.Namespace) -> str | None:
    """Call a service, once it is there, and print its response.

    Args:
        args: The parsed arguments.

    Returns:
        The error, None if there is none.
    """
    kind = service_class(args.service_type)
    request = kind.Request()
    try:
        fill_message(request, yaml.safe_load(args.values) or {})
    except (yaml.YAMLError, AttributeError, TypeError, ValueError, AssertionError) as error:
        return f"Failed to populate field: {error}"
    with direct_node(args) as node:
        client = node.create_client(kind, args.service_name)
        if not client.service_is_ready():
            print("waiting for service to become available...")
            client.wait_for_service()
        print(f"requester: making request: {request!r}\n")
        future = client.call_async(request)
        rclpy.spin_until_future_complete(node, future)
        if future.result() is None:
            return f"Exception while calling service: {future.exception()!r}"
        print(f"response:\n{future.result()!r}\n")
    return None
