# SPDX-License-Identifier: Apache-2.0
"""The shell around a pipeline: parameters are refused with reasons, bad messages are dropped, health is published."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest
import rclpy
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.parameter import Parameter
from sensor_msgs.msg import PointCloud2

from radar_common.health import Health
from radar_common.parameters import ParameterError, Parameters, parameter
from radar_common.ros.diagnostics import Diagnostics
from radar_common.ros.messages import TablePublisher, TableSubscription
from radar_common.ros.parameters import NodeParameters
from radar_common.ros.run import EXIT_BAD_PARAMETERS, run
from radar_common.tables import PLOT, PLOTS_TOPIC, Table

TIMEOUT = 20.0


@dataclass(frozen=True, kw_only=True)
class GateParameters(Parameters):
    smallest: float = parameter(1.0, "smallest gate", unit="sigma", low=0.5, high=10.0)
    largest: float = parameter(5.0, "largest gate", unit="sigma", low=0.5)
    hits: int = parameter(3, "plots to confirm", low=1, read_only=True)
    rule: str = parameter("nearest", "how to choose", choices=("nearest", "strongest"))

    def check(self):
        if self.smallest > self.largest:
            raise ParameterError("smallest must not exceed largest")


@pytest.fixture
def context():
    context = Context()
    rclpy.init(context=context)
    yield context
    rclpy.shutdown(context=context)


@pytest.fixture
def node(context):
    node = rclpy.create_node("shell", context=context)
    yield node
    node.destroy_node()


@pytest.fixture
def executor(context, node):
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    yield executor
    executor.shutdown()


def spin_until(executor, node, condition):
    deadline = node.get_clock().now().nanoseconds + TIMEOUT * 1e9
    while not condition():
        executor.spin_once(timeout_sec=0.1)
        assert node.get_clock().now().nanoseconds < deadline, "condition not met in time"


def test_defaults_and_descriptors_are_declared(node):
    assert NodeParameters(node, GateParameters).values == GateParameters()
    described = node.describe_parameter("smallest")
    assert described.description == "smallest gate [sigma]"
    assert described.floating_point_range[0].from_value == 0.5
    assert described.floating_point_range[0].to_value == 10.0
    assert node.describe_parameter("hits").read_only
    assert "strongest" in node.describe_parameter("rule").additional_constraints


def test_an_accepted_change_arrives_whole(node):
    seen = []
    parameters = NodeParameters(node, GateParameters, on_change=seen.append)
    results = node.set_parameters_atomically(
        [Parameter("smallest", value=6.0), Parameter("largest", value=7.0)]
    )
    assert results.successful
    assert seen == [GateParameters(smallest=6.0, largest=7.0)]
    assert parameters.values == seen[0]


@pytest.mark.parametrize(
    ("name", "value", "reason"),
    [
        ("smallest", 6.0, "must not exceed"),
        ("smallest", 0.1, ""),
        ("rule", "furthest", "one of nearest, strongest"),
        ("hits", 4, "read-only"),
    ],
)
def test_a_refused_change_gives_the_reason_and_changes_nothing(node, name, value, reason):
    seen = []
    parameters = NodeParameters(node, GateParameters, on_change=seen.append)
    (result,) = node.set_parameters([Parameter(name, value=value)])
    assert not result.successful
    assert reason in result.reason
    assert parameters.values == GateParameters()
    assert seen == []


def test_values_given_at_start_that_contradict_each_other_stop_the_node(context):
    node = rclpy.create_node(
        "bad", context=context, parameter_overrides=[Parameter("smallest", value=9.0)]
    )
    with pytest.raises(ParameterError, match="must not exceed"):
        NodeParameters(node, GateParameters)
    node.destroy_node()


def test_run_turns_impossible_parameters_into_one_line_and_an_exit_code(capfd):
    def create():
        raise ParameterError("smallest must not exceed largest")

    assert run(create, []) == EXIT_BAD_PARAMETERS
    assert capfd.readouterr().err.strip() == "cannot start: smallest must not exceed largest"
    assert not rclpy.ok()


def test_tables_travel_and_bad_messages_are_counted(node, executor):
    health, seen = Health(), []
    TableSubscription(node, PLOTS_TOPIC, seen.append, health, expected=PLOT)
    publisher = TablePublisher(node, PLOTS_TOPIC)
    raw = node.create_publisher(PointCloud2, PLOTS_TOPIC, 10)
    spin_until(executor, node, lambda: raw.get_subscription_count() == 1)
    rows = np.zeros(2, PLOT)
    rows["range"] = [1.0, 2.0]
    raw.publish(PointCloud2(width=5, height=1, point_step=8))
    publisher.publish(Table(7, rows))
    spin_until(executor, node, lambda: seen and health.dropped)
    assert seen[0].rows.tobytes() == rows.tobytes()
    assert seen[0].stamp == 7
    (reason,) = health.dropped
    assert "announced" in reason


def test_health_is_published_and_warns_only_while_something_is_dropped(node, executor):
    health, seen = Health(), []
    node.create_subscription(DiagnosticArray, "/diagnostics", seen.append, 10)
    diagnostics = Diagnostics(node, health)
    spin_until(executor, node, lambda: diagnostics._publisher.get_subscription_count() == 1)
    health.count("plots out", 3)
    health.drop("sector out of order")
    health.watch("false plots per scan", 10.0, 12.0)
    seen.clear()
    diagnostics.publish()
    diagnostics.publish()
    spin_until(executor, node, lambda: len(seen) >= 2)
    first, second = (message.status[0] for message in seen[:2])
    assert first.level == DiagnosticStatus.WARN
    assert "sector out of order" in first.message
    assert first.name == "/shell"
    values = {entry.key: entry.value for entry in first.values}
    assert values["plots out"] == "3"
    assert values["dropped: sector out of order"] == "1"
    assert values["false plots per scan, observed"] == "12"
    assert second.level == DiagnosticStatus.OK
