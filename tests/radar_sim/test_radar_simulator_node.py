# SPDX-License-Identifier: Apache-2.0
"""The node publishes what the simulator makes, keeps to its clock, and ends by itself."""

from __future__ import annotations

import pytest
import rclpy
from rclpy.clock import ClockType
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.parameter import Parameter
from rosgraph_msgs.msg import Clock
from tf2_msgs.msg import TFMessage

from radar_common.bag import topics
from radar_common.health import Health
from radar_common.parameters import ParameterError
from radar_common.ros import qos
from radar_common.ros.messages import TableSubscription
from radar_common.ros.run import EXIT_BAD_PARAMETERS
from radar_common.tables import NANOSECONDS, SWEEPS_TOPIC, TRUTH, TRUTH_TOPIC
from radar_sim.parameters import SimulatorParameters
from radar_sim.radar_simulator_node import RadarSimulatorNode, main
from radar_sim.simulator import Simulator

TIMEOUT = 30.0
SECTORS = 8
SETTINGS = {
    "scenario": "tiny",
    "seed": 7,
    "scans": 2,
    "sectors": SECTORS,
    "rate": 0.0,
    "wait_for_subscribers": 1,
    "wait_for_truth_subscribers": 1,
}


class Listener:
    """Keeps what it hears of the simulator."""

    def __init__(self, node):
        self.health = Health()
        self.sweeps, self.truth = [], []
        TableSubscription(
            node,
            SWEEPS_TOPIC,
            self.sweeps.append,
            self.health,
            expected=None,
            profile=qos.SWEEPS_OUT,
        )
        TableSubscription(node, TRUTH_TOPIC, self.truth.append, self.health, expected=TRUTH)


@pytest.fixture
def context():
    context = Context()
    rclpy.init(context=context)
    yield context
    rclpy.shutdown(context=context)


@pytest.fixture
def executor(context):
    executor = SingleThreadedExecutor(context=context)
    yield executor
    for node in executor.get_nodes():
        node.destroy_node()
    executor.shutdown()


@pytest.fixture
def observer(context, executor):
    node = rclpy.create_node("observer", context=context)
    executor.add_node(node)
    return node


@pytest.fixture
def finished():
    return []


@pytest.fixture
def start(context, executor, finished):
    def create(**settings):
        node = RadarSimulatorNode(
            context=context,
            on_finished=lambda: finished.append(True),
            parameter_overrides=[Parameter(k, value=v) for k, v in (SETTINGS | settings).items()],
        )
        executor.add_node(node)
        return node

    return create


def spin_until(executor, node, condition):
    clock = rclpy.clock.Clock(clock_type=ClockType.STEADY_TIME)
    deadline = clock.now().nanoseconds + TIMEOUT * 1e9
    while not condition():
        executor.spin_once(timeout_sec=0.1)
        assert clock.now().nanoseconds < deadline, "condition not met in time"


def test_the_node_publishes_what_the_simulator_makes(start, executor, observer, finished):
    listener = Listener(observer)
    start()
    spin_until(executor, observer, lambda: finished and len(listener.truth) == 2 * SECTORS)
    begin = listener.sweeps[0].stamp
    made = Simulator.from_parameters(
        SimulatorParameters(scenario="tiny", seed=7, scans=2, sectors=SECTORS)
    )
    made.start = begin
    for sweeps, truth, sector in zip(listener.sweeps, listener.truth, made, strict=True):
        assert (sweeps.stamp, sweeps.frame_id) == (sector.sweeps.stamp, "radar")
        assert (truth.stamp, truth.frame_id) == (sector.truth.stamp, "map")
        assert sweeps.rows.tobytes() == sector.sweeps.rows.tobytes()
        assert truth.rows.tobytes() == sector.truth.rows.tobytes()
    assert not listener.health.dropped


def test_the_antenna_waits_for_its_subscribers(start, executor, observer, finished):
    start()
    for _ in range(30):
        executor.spin_once(timeout_sec=0.01)
    assert not finished
    listener = Listener(observer)
    spin_until(executor, observer, lambda: finished and len(listener.sweeps) == 2 * SECTORS)
    assert listener.sweeps[0].rows["azimuth"][0] == 0.0


def test_who_comes_late_still_learns_where_the_antenna_stands(start, executor, observer):
    start(scenario="tiny")
    transforms = []
    observer.create_subscription(
        TFMessage, "/tf_static", lambda message: transforms.extend(message.transforms), qos.LATCHED
    )
    spin_until(executor, observer, lambda: transforms)
    assert transforms[0].header.frame_id == "map"
    assert transforms[0].child_frame_id == "radar"
    assert transforms[0].transform.rotation.w == 1.0


def test_sectors_leave_when_the_clock_has_passed_them(start, executor, observer, finished):
    listener = Listener(observer)
    clock = observer.create_publisher(Clock, "/clock", 10)
    node = start(use_sim_time=True, rate=2.0, scans=1)
    # A turn of 2 s in 8 sectors at twice real time: one leaves every 0.125 s of the clock.
    begin, tick = 100 * NANOSECONDS, NANOSECONDS // 32
    spin_until(executor, observer, lambda: clock.get_subscription_count() == 1)
    now = begin
    while not finished:
        message = Clock()
        message.clock.sec, message.clock.nanosec = divmod(now, NANOSECONDS)
        clock.publish(message)
        spin_until(executor, observer, lambda: node.get_clock().now().nanoseconds == now)  # noqa: B023
        executor.spin_once(timeout_sec=0.05)
        if listener.sweeps:
            elapsed = now - listener.sweeps[0].stamp
            assert len(listener.sweeps) <= elapsed // (NANOSECONDS // 8)
        assert now < begin + 10 * NANOSECONDS
        now += tick
    spin_until(executor, observer, lambda: len(listener.sweeps) == SECTORS)
    assert listener.sweeps[0].stamp >= begin
    assert now - listener.sweeps[0].stamp <= 1.25 * NANOSECONDS


def test_an_impossible_scenario_stops_the_node(start):
    with pytest.raises(ParameterError, match="nowhere: neither one of"):
        start(scenario="nowhere")


def test_main_ends_by_itself_after_its_scans():
    arguments = ["--ros-args", "-p", "scenario:=tiny", "-p", "scans:=1", "-p", "rate:=0.0"]
    assert main(arguments) == 0
    assert not rclpy.ok()


def test_main_says_why_it_cannot_start(capfd):
    assert main(["--ros-args", "-p", "scenario:=nowhere"]) == EXIT_BAD_PARAMETERS
    assert "cannot start: scenario nowhere" in capfd.readouterr().err


@pytest.mark.parametrize("storage", ["mcap", "sqlite3"])
def test_main_writes_a_bag_with_the_parameters_given(tmp_path, storage):
    file = tmp_path / "parameters.yaml"
    file.write_text("radar_simulator:\n  ros__parameters: {scenario: tiny, sectors: 8}\n", "utf-8")
    arguments = ["--bag", str(tmp_path / "bag"), "--storage", storage, "--ros-args"]
    arguments += ["--params-file", str(file), "-p", "scans:=3"]
    assert main(arguments) == 0
    assert topics(tmp_path / "bag") == {SWEEPS_TOPIC: 24, TRUTH_TOPIC: 24}


def test_main_does_not_overwrite_a_bag(tmp_path, capfd):
    arguments = ["--bag", str(tmp_path), "--ros-args", "-p", "scenario:=tiny", "-p", "scans:=1"]
    assert main(arguments) == EXIT_BAD_PARAMETERS
    assert "exists" in capfd.readouterr().err
