# SPDX-License-Identifier: Apache-2.0
"""`ros2 topic`, as ros2cli documents it."""

from __future__ import annotations

import re
import signal

import pytest

STRING = "std_msgs/msg/String"
DIRECT = ("--no-daemon", "--spin-time", "1")


def test_list_type_and_info_of_a_topic(ros2, publisher):
    publisher("/chatter", "--node-name", "talker")
    ros2.until(lambda out: "/chatter" in out.split(), "topic", "list", "--no-daemon")

    with_types = ros2("topic", "list", "-t", *DIRECT).stdout.splitlines()
    assert f"/chatter [{STRING}]" in with_types
    assert int(ros2("topic", "list", "-c", *DIRECT).stdout) == len(with_types)
    verbose = ros2("topic", "list", "-v", *DIRECT).stdout
    assert f"Published topics:\n * /chatter [{STRING}] 1 publisher\n" in verbose
    assert "Subscribed topics:\n" in verbose

    assert ros2("topic", "type", "/chatter", *DIRECT).stdout == f"{STRING}\n"

    assert ros2("topic", "info", "/chatter", *DIRECT).stdout == (
        f"Type: {STRING}\nPublisher count: 1\nSubscription count: 0\n"
    )
    details = ros2("topic", "info", "-v", "/chatter", *DIRECT).stdout
    assert "Node name: talker\nNode namespace: /\n" in details
    assert re.search(r"^Topic type hash: RIHS01_[0-9a-f]{64}$", details, re.MULTILINE)
    assert "Endpoint type: PUBLISHER\n" in details
    assert "  Reliability: RELIABLE\n" in details
    assert "  Durability: VOLATILE\n" in details


def test_questions_about_an_unknown_topic(ros2):
    info = ros2("topic", "info", "/nothing", "--no-daemon")
    assert (info.returncode, info.stderr) == (1, "Unknown topic '/nothing'\n")
    assert ros2("topic", "type", "/nothing", "--no-daemon").returncode == 1
    echo = ros2("topic", "echo", "/nothing", "--no-daemon")
    assert echo.returncode == 1
    assert "Could not determine the type for the passed topic" in echo.stderr


def test_hidden_topics_are_shown_on_request(ros2, publisher):
    publisher("/_private")
    shown = ("topic", "list", "--include-hidden-topics", "--no-daemon")
    ros2.until(lambda out: "/_private" in out.split(), *shown)
    assert "/_private" not in ros2("topic", "list", *DIRECT).stdout.split()


def test_echo_prints_each_message_at_once(ros2, publisher):
    publisher("/chatter")
    echo = ros2.start("topic", "echo", "/chatter", STRING, "--no-daemon")
    echo.wait_for(r"^data: hello\n---\ndata: hello\n---$")
    code, _ = echo.finish(signal.SIGINT)
    assert code == signal.SIGINT


@pytest.mark.parametrize(
    ("options", "printed"),
    [
        ((), "data: hello\n---\n"),
        (("--field", "data"), "hello\n---\n"),
        (("--csv",), "hello\n"),
        (("--flow-style",), "{data: hello}\n---\n"),
        (("--no-str",), "data: '<string length: <5>>'\n---\n"),
        (("--truncate-length", "2"), "data: he...\n---\n"),
        (("--filter", "m.data == 'hello'"), "data: hello\n---\n"),
    ],
    ids=lambda value: value[0] if isinstance(value, tuple) and value else None,
)
def test_echo_once(ros2, publisher, options, printed):
    publisher("/chatter")
    done = ros2("topic", "echo", "/chatter", STRING, "--once", "--no-daemon", *options)
    assert (done.returncode, done.stdout) == (0, printed)


def test_echo_finds_the_type_by_itself(ros2, publisher):
    publisher("/chatter")
    ros2.until(lambda out: "/chatter" in out.split(), "topic", "list", "--no-daemon")
    done = ros2("topic", "echo", "/chatter", "--once", *DIRECT)
    assert done.stdout == "data: hello\n---\n"


def test_echo_of_serialised_bytes(ros2, publisher):
    publisher("/chatter")
    done = ros2("topic", "echo", "/chatter", STRING, "--once", "--raw", "--no-daemon")
    assert done.stdout.startswith(repr(b"\x00\x01\x00\x00\x06\x00\x00\x00hello\x00")[:-1])


def test_echo_without_arrays(ros2):
    values = "{data: [1, 2, 3]}"
    ros2.start("topic", "pub", "/bytes", "std_msgs/msg/UInt8MultiArray", values, "-r", "20")
    words = ("topic", "echo", "/bytes", "std_msgs/msg/UInt8MultiArray", "--once", "--no-daemon")
    assert "data: '<sequence type: uint8, length: 3>'\n" in ros2(*words, "--no-arr").stdout
    assert "data:\n- 1\n- 2\n- 3\n" in ros2(*words).stdout


def test_echo_gives_up_after_its_timeout(ros2):
    done = ros2("topic", "echo", "/nothing", STRING, "--timeout", "0.2", "--no-daemon")
    assert (done.returncode, done.stdout) == (0, "")


@pytest.mark.parametrize(
    ("words", "error"),
    [
        (("echo", "/chatter", "no_such_msgs/msg/Thing"), "The passed message type is invalid"),
        (("pub", "/chatter", "no_such_msgs/msg/Thing"), "The passed message type is invalid"),
        (("pub", "/chatter", STRING, "just text", "-1", "-w", "0"), "needs to be a dictionary"),
        (("pub", "/chatter", STRING, "nope: 1", "-1", "-w", "0"), "Failed to populate field"),
    ],
)
def test_errors_are_one_line_on_standard_error(ros2, words, error):
    done = ros2("topic", *words)
    assert done.returncode == 1
    assert error in done.stderr
    assert "Traceback" not in done.stderr


def test_echo_of_a_field_that_is_not_there(ros2, publisher):
    publisher("/chatter")
    done = ros2("topic", "echo", "/chatter", STRING, "--once", "--field", "nope", "--no-daemon")
    assert done.returncode == 1
    assert "Invalid field 'nope'" in done.stderr


def test_echo_asks_for_the_latched_message_of_a_transient_local_publisher(ros2):
    latched = ("--qos-durability", "transient_local", "--keep-alive", "60", "-w", "0")
    publishing = ros2.start("topic", "pub", "/latched", STRING, "data: kept", "-1", *latched)
    publishing.wait_for("publishing #1")
    done = ros2("topic", "echo", "/latched", "--once", *DIRECT)
    assert done.stdout == "data: kept\n---\n"


def test_pub_once_waits_for_its_subscription(ros2):
    publishing = ros2.start("topic", "pub", "--once", "/greeting", STRING, "{data: hi there}")
    publishing.wait_for(r"^Waiting for at least 1 matching subscription\(s\)\.\.\.$")
    echo = ros2.start("topic", "echo", "/greeting", STRING, "--once", "--no-daemon")
    publishing.wait_for("^publisher: beginning loop$")
    code, output = publishing.finish()
    assert code == 0
    assert "publishing #1: std_msgs.msg.String(data='hi there')\n" in output
    assert echo.finish() == (0, "data: hi there\n---\n")


def test_pub_a_number_of_times(ros2):
    done = ros2("topic", "pub", "-t", "3", "-w", "0", "-r", "100", "-p", "2", "/n", STRING)
    assert done.returncode == 0
    assert re.findall(r"publishing #(\d+)", done.stdout) == ["2"]


def test_pub_gives_up_waiting(ros2):
    words = ("topic", "pub", "--once", "--max-wait-time-secs", "0.3", "/nobody", STRING)
    done = ros2(*words)
    assert done.returncode == 1
    assert "Timed out waiting for subscribers: Expected 1" in done.stderr


def test_pub_stamps_a_header_with_the_present_time(ros2):
    values = "{header: auto, point: {x: 1.5}}"
    ros2.start("topic", "pub", "/point", "geometry_msgs/msg/PointStamped", values, "-r", "20")
    words = ("topic", "echo", "/point", "geometry_msgs/msg/PointStamped", "--once", "--no-daemon")
    printed = ros2(*words).stdout
    assert int(re.search(r"sec: (\d+)", printed)[1]) > 1_600_000_000
    assert "  x: 1.5\n" in printed


def test_hz(ros2, publisher):
    publisher("/chatter", rate="50")
    hz = ros2.start("topic", "hz", "/chatter", "--window", "100")
    rate = hz.wait_for(
        r"^average rate: (\d+\.\d{3})\n"
        r"\tmin: \d+\.\d{3}s max: \d+\.\d{3}s std dev: \d+\.\d{5}s window: \d+$"
    )
    # The mean of a second's intervals; a busy machine delays, but the number stays near.
    assert 35 < float(rate[1]) < 65
    code, _ = hz.finish(signal.SIGINT)
    assert code == signal.SIGINT


def test_bw(ros2, publisher):
    publisher("/chatter", rate="50")
    bandwidth = ros2.start("topic", "bw", "/chatter")
    bandwidth.wait_for(r"^Subscribed to \[/chatter\]$")
    bandwidth.wait_for(
        r"^\d+(\.\d+)? K?B/s from \d+ messages\n\tMessage size mean: .+ min: .+ max: .+$"
    )
