# SPDX-License-Identifier: Apache-2.0
"""`ros2 bag record`, `play` and `info`, as rosbag2 documents them."""

from __future__ import annotations

import re
import signal
from pathlib import Path

import pytest

COUNT = 20

# Publishes once the recorder listens, and leaves once the recorder has everything.
PUBLISHER = """
import sys
import rclpy
from rclpy.duration import Duration
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import Int32, String
rclpy.init()
node = rclpy.create_node("source")
numbers = node.create_publisher(Int32, sys.argv[1], QoSProfile(depth=100))
latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
label = node.create_publisher(String, sys.argv[2], latched)
label.publish(String(data="latched"))
print("ready", flush=True)
while rclpy.ok() and not (numbers.get_subscription_count() and label.get_subscription_count()):
    rclpy.spin_once(node, timeout_sec=0.02)
for index in range(int(sys.argv[3])):
    numbers.publish(Int32(data=index))
assert numbers.wait_for_all_acked(Duration(seconds=20))
assert label.wait_for_all_acked(Duration(seconds=20))
print("delivered", flush=True)
rclpy.shutdown()
"""

# Prints what arrives on two topics, each on a line of its own.
SUBSCRIBER = """
import sys
import rclpy
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import Int32, String
rclpy.init()
node = rclpy.create_node("sink")
latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
def number(message): print("number", message.data, flush=True)
def text(message): print("label", message.data, flush=True)
node.create_subscription(Int32, sys.argv[1], number, 100)
node.create_subscription(String, sys.argv[2], text, latched)
print("listening", flush=True)
rclpy.spin(node)
"""


def record(ros2, bag, *options, numbers="/numbers", label="/label", end=signal.SIGINT):
    """Record what the publisher sends, to the end; return exit code and output."""
    recording = ros2.start("bag", "record", "-o", str(bag), *options)
    source = ros2.script(PUBLISHER, numbers, label, str(COUNT))
    source.wait_for("delivered")
    return recording.finish(end)


@pytest.fixture(scope="module")
def bags(tmp_path_factory, ros2_of_module) -> dict[str, Path]:
    """Finished recordings of the two topics, one of each storage."""
    folder = tmp_path_factory.mktemp("bags")
    topics = ("--topics", "/numbers", "/label")
    for storage in ("mcap", "sqlite3"):
        code, output = record(ros2_of_module, folder / storage, "-s", storage, *topics)
        assert code == 0, output
        assert "Subscribed to topic '/numbers'" in output
    return {storage: folder / storage for storage in ("mcap", "sqlite3")}


@pytest.fixture
def bag(bags) -> Path:
    """One of the recordings, where the storage does not matter."""
    return bags["mcap"]


def play(ros2, bag, *options, numbers="/numbers", label="/label"):
    """Play to a subscriber; return its output once it has the last number."""
    sink = ros2.script(SUBSCRIBER, numbers, label)
    sink.wait_for("listening")
    # The delay is the documented way to let subscribers find the player.
    playing = ros2.start("bag", "play", str(bag), "--delay", "1.5", *options)
    sink.wait_for(rf"number {COUNT - 1}$")
    code, output = playing.finish()
    assert code == 0, output
    return sink


@pytest.mark.parametrize("storage", ["mcap", "sqlite3"])
def test_info(ros2, bags, storage):
    bag = bags[storage]
    done = ros2("bag", "info", str(bag))
    assert done.returncode == 0
    lines = done.stdout.splitlines()
    fields = dict(re.findall(r"^([A-Z][\w ]+):\s+(\S.*)$", done.stdout, re.MULTILINE))
    assert fields["Storage id"] == bag.name
    assert fields["Files"].endswith({"mcap": ".mcap", "sqlite3": ".db3"}[bag.name])
    assert fields["Messages"] == str(COUNT + 1)
    assert re.fullmatch(r"\d+\.\d{9}s", fields["Duration"])
    assert re.fullmatch(r"\w{3} [ \d]\d \d{4} [\d:]{8}\.\d{9} \(\d+\.\d{9}\)", fields["Start"])
    assert any(
        f"Topic: /numbers | Type: std_msgs/msg/Int32 | Count: {COUNT} | "
        "Serialization Format: cdr" in line
        for line in lines
    )


@pytest.mark.parametrize("storage", ["mcap", "sqlite3"])
def test_play_delivers_everything_in_order(ros2, bags, storage):
    sink = play(ros2, bags[storage])
    _, output = sink.finish(signal.SIGINT)
    numbers = [int(text) for text in re.findall(r"^number (\d+)$", output, re.MULTILINE)]
    assert numbers == list(range(COUNT))
    assert "label latched\n" in output


def test_play_only_some_topics_under_another_name(ros2, bag):
    choice = ("--topics", "/numbers", "--remap", "/numbers:=/renamed")
    sink = play(ros2, bag, *choice, numbers="/renamed")
    _, output = sink.finish(signal.SIGINT)
    assert "label" not in output


def test_play_publishes_the_time_of_the_bag(ros2, bag):
    start = re.search(r"Start:.*\((\d+)\.\d+\)", ros2("bag", "info", str(bag)).stdout)[1]
    clock = ("topic", "echo", "/clock", "rosgraph_msgs/msg/Clock", "--field", "clock.sec")
    echo = ros2.start(*clock, "--no-daemon")
    playing = ros2.start("bag", "play", str(bag), "--clock", "100", "-r", "0.01", "--delay", "1.5")
    seconds = int(echo.wait_for(r"^(\d+)$")[1])
    assert abs(seconds - int(start)) <= 1
    code, _ = playing.finish(signal.SIGINT)
    assert code == 0


def test_play_in_a_loop_until_interrupted(ros2, bag):
    sink = ros2.script(SUBSCRIBER, "/numbers", "/label")
    sink.wait_for("listening")
    playing = ros2.start("bag", "play", str(bag), "--loop", "-r", "10")
    sink.wait_for(rf"(?s)number {COUNT - 1}\n.*number {COUNT - 1}\n")
    code, _ = playing.finish(signal.SIGINT)
    assert code == 0


def test_topics_that_appear_later_join_the_recording(ros2, tmp_path, publisher):
    words = ("-e", "^/lab/", "--exclude-regex", "secret", "-o", str(tmp_path / "bag"))
    recording = ros2.start("bag", "record", *words)
    recording.wait_for("Listening for topics")
    for topic in ("/lab/early", "/lab/secret", "/other"):
        publisher(topic)
    recording.wait_for("Subscribed to topic '/lab/early'")
    publisher("/lab/late")
    recording.wait_for("Subscribed to topic '/lab/late'")
    code, _ = recording.finish(signal.SIGTERM)
    assert code == 0
    names = ros2("bag", "info", "-t", str(tmp_path / "bag")).stdout.split()
    assert sorted(names) == ["/lab/early", "/lab/late"]


def test_an_existing_folder_is_not_touched(ros2, tmp_path):
    (tmp_path / "bag").mkdir()
    done = ros2("bag", "record", "-a", "-o", str(tmp_path / "bag"))
    assert done.returncode == 1
    assert "already exists" in done.stderr
    assert not list((tmp_path / "bag").iterdir())


def test_a_recording_needs_a_selection(ros2, tmp_path):
    done = ros2("bag", "record", "-o", str(tmp_path / "bag"))
    assert done.returncode == 1
    assert "Need to specify at least one option" in done.stderr
    assert not (tmp_path / "bag").exists()


def test_a_bag_that_does_not_exist(ros2, tmp_path):
    done = ros2("bag", "play", str(tmp_path / "nothing"))
    assert done.returncode == 2
    assert "does not exist" in done.stderr


def test_the_rate_must_be_positive(ros2, bag):
    assert ros2("bag", "play", str(bag), "-r", "0").returncode == 2
