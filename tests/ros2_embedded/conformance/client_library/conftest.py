# SPDX-License-Identifier: Apache-2.0
"""Fixtures of the conformance tests.

The tests import rclpy and message packages only, so that the same files run on the embedded
runtime and on a ROS 2 installation (Jazzy).
"""

from __future__ import annotations

import os
import re
import time
from collections.abc import Callable, Iterator

# The generated message classes of Jazzy check values only if this is set before their import.
os.environ.setdefault("ROS_PYTHON_CHECK_FIELDS", "1")

import pytest
import rclpy
from rclpy.context import Context
from rclpy.executors import Executor, SingleThreadedExecutor
from rclpy.node import Node

WAIT_SECONDS = 20.0


@pytest.fixture(scope="session")
def domain_id() -> int:
    """A domain that parallel test sessions of one machine are unlikely to share."""
    return 1 + os.getpid() % 100


@pytest.fixture
def context(domain_id: int) -> Iterator[Context]:
    """An initialised context of its own."""
    context = Context()
    rclpy.init(context=context, args=[], domain_id=domain_id)
    yield context
    context.try_shutdown()


@pytest.fixture
def make_node(context: Context) -> Iterator[Callable[..., Node]]:
    """Make nodes that are destroyed after the test."""
    nodes: list[Node] = []

    def make(name: str = "tester", **options: object) -> Node:
        node = Node(name, context=context, **options)
        nodes.append(node)
        return node

    yield make
    for node in nodes:
        node.destroy_node()


@pytest.fixture
def node(make_node: Callable[..., Node]) -> Node:
    """A node."""
    return make_node()


@pytest.fixture
def executor(context: Context) -> Iterator[Executor]:
    """A single-threaded executor."""
    executor = SingleThreadedExecutor(context=context)
    yield executor
    executor.shutdown()


@pytest.fixture
def topic(request: pytest.FixtureRequest) -> str:
    """A topic that no other test uses."""
    return "/" + re.sub(r"\W+", "_", request.node.name).strip("_")


@pytest.fixture
def spin_until() -> Callable[[Executor, Callable[[], object]], None]:
    """Spin an executor until a condition holds."""

    def spin(executor: Executor, condition: Callable[[], object]) -> None:
        give_up = time.monotonic() + WAIT_SECONDS
        while not condition():
            assert time.monotonic() < give_up, "the condition did not come true"
            executor.spin_once(timeout_sec=0.05)

    return spin
