# SPDX-License-Identifier: Apache-2.0
"""ROS arguments of the command line: parameters, files, remappings."""

from __future__ import annotations

import math

import pytest
import rclpy
from rclpy.context import Context
from rclpy.exceptions import InvalidParameterTypeException
from rclpy.node import Node
from rclpy.utilities import remove_ros_args
from std_msgs.msg import String


@pytest.fixture
def start(domain_id):
    """Start a context with a command line and make nodes in it."""
    contexts = []

    def start(*arguments):
        context = Context()
        rclpy.init(args=["program", *arguments], context=context, domain_id=domain_id)
        contexts.append(context)
        return lambda name="tester", **options: Node(name, context=context, **options)

    yield start
    for context in contexts:
        context.try_shutdown()


def value_of(node, text_default):
    return node.declare_parameter("p", text_default).value


@pytest.mark.parametrize(
    ("text", "default", "expected"),
    [
        ("true", False, True),
        ("no", True, False),
        ("on", False, True),
        ("5", 0, 5),
        ("-3", 0, -3),
        ("0x1F", 0, 31),
        ("010", 0, 8),
        ("5.0", 0.0, 5.0),
        ("1e3", 0.0, 1000.0),
        (".5", 0.0, 0.5),
        ("-.inf", 0.0, -math.inf),
        ("text", "", "text"),
        ("two words", "", "two words"),
        ("'5'", "", "5"),
        ('"true"', "", "true"),
        ("[1, 2]", [0], [1, 2]),
        ("[1.0, 2.5]", [0.0], [1.0, 2.5]),
        ("[true, off]", [True], [True, False]),
        ("[a, '1']", [""], ["a", "1"]),
    ],
)
def test_parameter_values(text, default, expected, start):
    node = start("--ros-args", "-p", f"p:={text}")()
    value = value_of(node, default)
    assert value == expected
    assert type(value) is type(expected)


def test_nan(start):
    assert math.isnan(value_of(start("--ros-args", "-p", "p:=.nan")(), 0.0))


def test_integer_is_no_double(start):
    with pytest.raises(InvalidParameterTypeException):
        value_of(start("--ros-args", "-p", "p:=5")(), 1.0)


def test_long_options(start):
    node = start("--ros-args", "--param", "p:=5", "--remap", "__node:=renamed")()
    assert value_of(node, 0) == 5
    assert node.get_name() == "renamed"


def test_later_value_wins(start):
    assert value_of(start("--ros-args", "-p", "p:=1", "-p", "p:=2")(), 0) == 2


def test_parameter_of_one_node(start):
    make = start("--ros-args", "-p", "first:p:=1")
    assert value_of(make("first"), 0) == 1
    assert value_of(make("second"), 0) == 0
    assert value_of(make("first", namespace="/space"), 0) == 0


def test_nothing_counts_outside_of_ros_arguments(start):
    make = start("-p", "p:=1", "--ros-args", "-p", "p:=2", "--", "-p", "p:=3")
    assert value_of(make(), 0) == 2


def test_global_arguments_can_be_ignored(start):
    node = start("--ros-args", "-p", "p:=1", "-r", "__node:=renamed")(use_global_arguments=False)
    assert value_of(node, 0) == 0
    assert node.get_name() == "tester"


def test_arguments_of_a_node_win(start):
    node = start("--ros-args", "-p", "p:=1")(cli_args=["--ros-args", "-p", "p:=2"])
    assert value_of(node, 0) == 2


@pytest.mark.parametrize(
    "arguments",
    [
        ["--unknown"],
        ["stray"],
        ["-p"],
        ["-p", "no_value"],
        ["-p", "p:="],
        ["-p", "p:=[1, 2.0]"],
        ["-p", "/space/node:p:=1"],
        ["-p", "1st:=1"],
        ["-r"],
        ["-r", "no_target"],
        ["-r", "__node:=bad/name"],
        ["-r", "__ns:=relative"],
        ["--log-level"],
        ["--log-level", "loud"],
        ["--params-file", "/nowhere/parameters.yaml"],
    ],
)
def test_wrong_arguments_are_refused(arguments, start):
    with pytest.raises(RuntimeError):
        start("--ros-args", *arguments)


def test_parameter_file(start, tmp_path):
    path = tmp_path / "parameters.yaml"
    path.write_text(
        """
/**:
  ros__parameters:
    everywhere: 1
    overruled: 1
/space/*:
  ros__parameters:
    in_space: true
/space:
  tracker:
    ros__parameters:
      gate:
        size: 2.5
        names: [a, b]
      overruled: 2
other:
  ros__parameters:
    everywhere: 7
"""
    )
    make = start("--ros-args", "--params-file", str(path))
    tracker = make(
        "tracker", namespace="/space", automatically_declare_parameters_from_overrides=True
    )
    values = {
        name: tracker.get_parameter(name).value
        for name in ("everywhere", "in_space", "gate.size", "gate.names", "overruled")
    }
    assert values == {
        "everywhere": 1,
        "in_space": True,
        "gate.size": 2.5,
        "gate.names": ["a", "b"],
        "overruled": 2,
    }
    other = make("other")
    assert other.declare_parameter("everywhere", 0).value == 7
    assert other.declare_parameter("in_space", False).value is False


@pytest.mark.parametrize(
    "text",
    [
        "node: 5",
        "node: {value: 1}",
        "ros__parameters: {a: 1}",
        "node: [",
        "node: {ros__parameters: {a: &a 1, b: *a}}",
        "node: {ros__parameters: {a: [1, 2.0]}}",
        "node: {ros__parameters: {a: }}",
    ],
)
def test_wrong_parameter_files_are_refused(text, start, tmp_path):
    path = tmp_path / "parameters.yaml"
    path.write_text(text)
    with pytest.raises(RuntimeError):
        start("--ros-args", "--params-file", str(path))


def test_node_and_namespace(start):
    node = start("--ros-args", "-r", "__node:=renamed", "-r", "__ns:=/moved")(namespace="/old")
    assert node.get_fully_qualified_name() == "/moved/renamed"
    assert node.get_logger().name == "moved.renamed"


def test_node_qualified_rename(start):
    make = start("--ros-args", "-r", "first:__node:=renamed")
    assert make("first").get_name() == "renamed"
    assert make("second").get_name() == "second"


@pytest.mark.parametrize(
    ("rule", "used", "expected"),
    [
        ("plots:=tracks", "plots", "/site/tracks"),
        ("plots:=/tracks", "plots", "/tracks"),
        ("/site/plots:=/tracks", "plots", "/tracks"),
        ("plots:=tracks", "/plots", "/plots"),
        ("plots:=~/own", "plots", "/site/tester/own"),
        ("~/plots:=tracks", "~/plots", "/site/tracks"),
        ("tester:plots:=tracks", "plots", "/site/tracks"),
        ("someone:plots:=tracks", "plots", "/site/plots"),
        ("rostopic://plots:=tracks", "plots", "/site/tracks"),
        ("rosservice://plots:=tracks", "plots", "/site/plots"),
    ],
)
def test_remapped_topics(rule, used, expected, start):
    node = start("--ros-args", "-r", rule)(namespace="/site")
    assert node.resolve_topic_name(used) == expected
    assert node.create_publisher(String, used, 10).topic_name == expected


def test_remapped_service(start):
    node = start("--ros-args", "-r", "reset:=/clear")()
    assert node.resolve_service_name("reset") == "/clear"
    assert node.resolve_service_name("reset", only_expand=True) == "/reset"


def test_first_rule_wins(start):
    node = start("--ros-args", "-r", "a:=b", "-r", "a:=c")()
    assert node.resolve_topic_name("a") == "/b"


def test_rules_are_not_chained(start):
    node = start("--ros-args", "-r", "a:=b", "-r", "b:=c")()
    assert node.resolve_topic_name("a") == "/b"


def test_rules_of_a_node_come_first(start):
    node = start("--ros-args", "-r", "a:=b")(cli_args=["--ros-args", "-r", "a:=c"])
    assert node.resolve_topic_name("a") == "/c"


def test_namespace_moves_relative_names(start):
    node = start("--ros-args", "-r", "__ns:=/site")()
    assert node.resolve_topic_name("plots") == "/site/plots"
    assert node.resolve_topic_name("~/plots") == "/site/tester/plots"


@pytest.mark.parametrize(
    ("arguments", "left"),
    [
        (["program"], ["program"]),
        (["program", "file", "--ros-args", "-p", "a:=1"], ["program", "file"]),
        (["program", "--ros-args", "-r", "a:=b", "--", "file"], ["program", "file"]),
        (["program", "--ros-args"], ["program"]),
        (["program", "--", "file"], ["program", "--", "file"]),
    ],
)
def test_remove_ros_args(arguments, left):
    assert remove_ros_args(arguments) == left
