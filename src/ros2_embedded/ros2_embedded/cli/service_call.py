# SPDX-License-Identifier: Apache-2.0
"""One call of a service, from the search for it to its answer."""

from __future__ import annotations

from typing import Any

import rclpy
from rclpy.node import Node

_WAIT_SECONDS = 5.0


def call_service(node: Node, kind: type[Any], name: str, request: Any) -> Any:
    """Call a service and wait for its answer.

    Args:
        node: The node that calls.
        kind: The service's class.
        name: Its name.
        request: The request.

    Returns:
        The response.

    Raises:
        RuntimeError: Nobody offers the service, or it failed.
    """
    client = node.create_client(kind, name)
    try:
        if not client.wait_for_service(timeout_sec=_WAIT_SECONDS):
            raise RuntimeError(f"Wait for service timed out waiting for service '{name}'")
        future = client.call_async(request)
        rclpy.spin_until_future_complete(node, future)
        response = future.result()
        if response is None:
            raise RuntimeError(f"Exception while calling service '{name}': {future.exception()}")
        return response
    finally:
        node.destroy_client(client)
