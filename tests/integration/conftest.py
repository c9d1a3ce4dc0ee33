# SPDX-License-Identifier: Apache-2.0
"""Nodes in an executor, processes on the command line, and waiting for conditions instead of time."""

from __future__ import annotations

import os
import signal
import subprocess
import threading
import time
from contextlib import contextmanager

import numpy as np
import pytest
import rclpy
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.qos import QoSProfile

from radar_common.health import Health
from radar_common.ros.messages import TableSubscription
from radar_common.tables import PLOT, PLOTS_TOPIC, TRACK, TRACKS_TOPIC, TRUTH, TRUTH_TOPIC

TIMEOUT = 60.0
# Longer than any run here: a busy machine may be late, but must lose nothing.
DEEP = 2000
LOSSLESS = {
    "plot_extractor": {
        "qos_overrides./radar/sweeps.subscription.reliability": "reliable",
        "qos_overrides./radar/sweeps.subscription.depth": DEEP,
    },
    "tracker": {"qos_overrides./radar/plots.subscription.depth": DEEP},
}


@pytest.fixture
def context():
    """A ROS context of the test's own."""
    context = Context()
    rclpy.init(context=context)
    yield context
    rclpy.try_shutdown(context=context)


@pytest.fixture
def executor(context):
    """An executor on the test's context."""
    executor = SingleThreadedExecutor(context=context)
    yield executor
    for node in list(executor.get_nodes()):
        executor.remove_node(node)
        node.destroy_node()
    executor.shutdown()


@pytest.fixture
def spin_until(executor):
    """Spin until a condition holds, and fail if it does not in time."""

    def spin(condition, what):
        deadline = time.monotonic() + TIMEOUT
        while not condition():
            executor.spin_once(timeout_sec=0.1)
            assert time.monotonic() < deadline, f"waited in vain for {what}"

    return spin


class Listener:
    """Keeps every table that the chain publishes."""

    def __init__(self, node):
        self.node = node
        self.health = Health()
        self.tables = {PLOTS_TOPIC: [], TRACKS_TOPIC: [], TRUTH_TOPIC: []}
        for topic, dtype in ((PLOTS_TOPIC, PLOT), (TRACKS_TOPIC, TRACK), (TRUTH_TOPIC, TRUTH)):
            keep = self.tables[topic].append
            TableSubscription(
                node, topic, keep, self.health, expected=dtype, profile=QoSProfile(depth=DEEP)
            )

    def rows(self, topic):
        tables = self.tables[topic]
        return np.concatenate([t.rows for t in tables]) if tables else np.empty(0)

    def ready(self):
        return all(self.node.count_publishers(f"/{t}") for t in (PLOTS_TOPIC, TRACKS_TOPIC))


@pytest.fixture
def listener(context, executor):
    """A node that hears plots, tracks and truth."""
    node = rclpy.create_node("listener", context=context)
    executor.add_node(node)
    return Listener(node)


@contextmanager
def running(*command):
    """Run a `ros2` command and its children in a group of their own; interrupt them all at the end."""
    process = subprocess.Popen(
        ["ros2", *command],
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        start_new_session=True,
    )
    output = []
    reader = threading.Thread(target=lambda: output.extend(process.stdout), daemon=True)
    reader.start()
    process.lines = output
    try:
        yield process
    finally:
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGINT)
        try:
            process.wait(20)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()
        reader.join()


@pytest.fixture
def ros2():
    """Start `ros2` commands that end with the test."""
    return running


@pytest.fixture(scope="session")
def lossless():
    """Parameters with which a node loses nothing, by the node's name."""
    return LOSSLESS


@pytest.fixture(scope="session")
def lossless_arguments():
    """The same as ROS arguments."""
    return {
        node: [part for k, v in settings.items() for part in ("-p", f"{k}:={v}")]
        for node, settings in LOSSLESS.items()
    }
