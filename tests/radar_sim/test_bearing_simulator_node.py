# SPDX-License-Identifier: Apache-2.0
"""The node publishes what the simulator makes, begins when it is told to, and ends by itself."""

from __future__ import annotations

import pytest
import rclpy
from nav_msgs.msg import Odometry
from rclpy.clock import ClockType
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.parameter import Parameter
from rosgraph_msgs.msg import Clock

from radar_common.bag import topics
from radar_common.health import Health
from radar_common.odometry import decode_odometry
from radar_common.parameters import ParameterError
from radar_common.ros import qos
from radar_common.ros.messages import TableSubscription
from radar_common.ros.run import EXIT_BAD_PARAMETERS
from radar_common.tables import (
    BEARING,
    BEARINGS_TOPIC,
    CHANNEL_TRUTH_TOPIC,
    NANOSECONDS,
    PLATFORM_TOPIC,
    PLOT,
    PLOTS_TOPIC,
    TRUTH,
    TRUTH_TOPIC,
)
from radar_sim.bearing_simulator_node import BearingSimulatorNode, main
from radar_sim.bearings.parameters import BearingSimulatorParameters
from radar_sim.bearings.simulator import BearingSimulator
from radar_sim.radar_simulator_node import RadarSimulatorNode

TIMEOUT = 30.0
DTYPES = {
    BEARINGS_TOPIC: BEARING,
    PLOTS_TOPIC: PLOT,
    TRUTH_TOPIC: TRUTH,
    CHANNEL_TRUTH_TOPIC: BEARING,
}
SETTINGS = {
    "scenario": "countermeasures",
    "seed": 3,
    "duration": 8.0,
    "rate": 0.0,
    "wait_for_subscribers": 1,
    "wait_for_truth_subscribers": 1,
}


class Listener:
    """Keeps what it hears."""

    def __init__(self, node):
        self.health = Health()
        self.heard = {topic: [] for topic in (*DTYPES, PLATFORM_TOPIC)}
        for topic, dtype in DTYPES.items():
            TableSubscription(node, topic, self.heard[topic].append, self.health, expected=dtype)
        node.create_subscription(
            Odometry,
            PLATFORM_TOPIC,
            lambda message: self.heard[PLATFORM_TOPIC].append(decode_odometry(message)),
            qos.TABLES,
        )


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
    for node in list(executor.get_nodes()):
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
    def create(cls=BearingSimulatorNode, **settings):
        node = cls(
            context=context,
            on_finished=lambda: finished.append(True),
            parameter_overrides=[Parameter(k, value=v) for k, v in settings.items()],
        )
        executor.add_node(node)
        return node

    return create


def spin_until(executor, condition):
    clock = rclpy.clock.Clock(clock_type=ClockType.STEADY_TIME)
    deadline = clock.now().nanoseconds + TIMEOUT * 1e9
    while not condition():
        executor.spin_once(timeout_sec=0.1)
        assert clock.now().nanoseconds < deadline, "condition not met in time"


def test_the_node_publishes_what_the_simulator_makes(start, executor, observer, finished):
    listener = Listener(observer)
    # The counts of subscriptions that are waited for cover two of the topics only.
    spin_until(executor, lambda: observer.count_subscribers(f"/{PLATFORM_TOPIC}") == 1)
    start(**SETTINGS)
    made = list(
        BearingSimulator.from_parameters(
            BearingSimulatorParameters(scenario="countermeasures", seed=3, duration=8.0)
        )
    )
    expected = {topic: [m.content for m in made if m.topic == topic] for topic in listener.heard}
    spin_until(
        executor,
        lambda: finished and all(len(listener.heard[t]) == len(c) for t, c in expected.items()),
    )
    first = listener.heard[BEARINGS_TOPIC][0].stamp
    shift = first - expected[BEARINGS_TOPIC][0].stamp
    for topic in DTYPES:
        for heard, content in zip(listener.heard[topic], expected[topic], strict=True):
            assert heard.stamp == content.stamp + shift
            assert heard.frame_id == content.frame_id
            assert heard.rows.tobytes() == content.rows.tobytes()
    for heard, content in zip(
        listener.heard[PLATFORM_TOPIC], expected[PLATFORM_TOPIC], strict=True
    ):
        assert heard.stamp == content.stamp + shift
        assert (heard.x, heard.y) == (content.x, content.y)
    assert not listener.health.dropped


@pytest.mark.parametrize("cls", [BearingSimulatorNode, RadarSimulatorNode])
def test_simulated_time_begins_when_it_is_told_to(cls, start, executor, observer):
    listener = Listener(observer)
    clock = observer.create_publisher(Clock, "/clock", 10)
    length = {"scans": 1} if cls is RadarSimulatorNode else {"duration": 2.0}
    settings = {
        "scenario": "countermeasures",
        "rate": 1000.0,
        "begin_at": 100,
        "use_sim_time": True,
        "wait_for_truth_subscribers": 1,
    }
    node = start(cls, **settings, **length)
    spin_until(executor, lambda: clock.get_subscription_count() == 1)
    for now, begun in ((99, False), (101, True)):
        message = Clock()
        message.clock.sec = now
        clock.publish(message)
        spin_until(
            executor,
            lambda now=now: node.get_clock().now().nanoseconds == now * NANOSECONDS,
        )
        for _ in range(20):
            executor.spin_once(timeout_sec=0.01)
        assert bool(listener.heard[TRUTH_TOPIC]) == begun
    assert listener.heard[TRUTH_TOPIC][0].stamp == 100 * NANOSECONDS


@pytest.mark.parametrize(
    ("scenario", "reason"),
    [("nowhere", "neither one of"), ("tiny", "neither direction_finder nor channels.active")],
)
def test_an_impossible_scenario_stops_the_node(start, scenario, reason):
    with pytest.raises(ParameterError, match=reason):
        start(scenario=scenario)


def test_main_ends_by_itself_after_its_duration():
    arguments = ["--ros-args", "-p", "scenario:=ship", "-p", "duration:=60.0", "-p", "rate:=0.0"]
    assert main(arguments) == 0
    assert not rclpy.ok()


def test_main_writes_a_bag_with_the_parameters_given(tmp_path):
    arguments = ["--bag", str(tmp_path / "bag"), "--ros-args"]
    arguments += ["-p", "scenario:=direction_finder", "-p", "duration:=10.0"]
    assert main(arguments) == 0
    assert topics(tmp_path / "bag") == {BEARINGS_TOPIC: 6, TRUTH_TOPIC: 6, CHANNEL_TRUTH_TOPIC: 6}


def test_main_says_why_it_cannot_start(tmp_path, capfd):
    assert main(["--bag", str(tmp_path / "bag"), "--ros-args", "-p", "seed:=1"]) == (
        EXIT_BAD_PARAMETERS
    )
    assert "duration must be above 0" in capfd.readouterr().err
