# SPDX-License-Identifier: Apache-2.0
"""`ros2 topic`, as ros2cli documents it."""

from __future__ import annotations

import re
import signal

import pytest

STRING = "std_msgs/msg/String"


@pytest.fixture(scope="module", autouse=True)
def talker(ros2_of_module):
    """A steady publisher of strings on /chatter, for all tests of the module."""
    options = ("-r", "50", "--node-name", "talker")
    ros2_of_module.start("topic", "pub", "/chatter", STRING, "data: hello", *options).wait_for(
        "publishing #1"
    )


def test_list_type_and_info_of_a_topic(ros2):
    line = f"/chatter [{STRING}]"
    ros2.until(lambda out: line in out.splitlines(), "topic", "list", "-t", "--no-daemon")
    verbose = f"Published topics:\n * {line} 1 publisher\n"
    ros2.until(lambda out: verbose in out, "topic", "list", "-v", "--no-daemon")
    ros2.until(lambda out: out == f"{STRING}\n", "topic", "type", "/chatter", "--no-daemon")
    words = ("topic", "info", "-v", "/chatter", "--no-daemon")
    details = ros2.until(lambda out: "Endpoint type: PUBLISHER\n" in out, *words)
    assert f"Type: {STRING}\n\nPublisher count: 1\n\n" in details
    assert "Subscription count: 0\n" in details
    assert "Node name: talker\nNode namespace: /\n" in details
    assert re.search(r"^Topic type hash: RIHS01_[0-9a-f]{64}$", details, re.MULTILINE)
    assert "  Reliability: RELIABLE\n" in details
    assert "  Durability: VOLATILE\n" in details


def test_questions_about_an_unknown_topic(ros2):
    info = ros2("topic", "info", "/nothing", "--no-daemon")
    assert (info.returncode, info.stderr) == (1, "Unknown topic '/nothing'\n")
    echo = ros2("topic", "echo", "/nothing", "--no-daemon")
    assert echo.returncode == 1
    assert "Could not determine the type for the passed topic" in echo.stderr


def test_hidden_topics_are_shown_on_request(ros2):
    ros2.start("topic", "pub", "/_private", STRING).wait_for("publishing #1")
    words = ("topic", "list", "--no-daemon")
    shown = "--include-hidden-topics"
    ros2.until(lambda out: "/_private" in out.split(), *words, shown)
    assert "/_private" not in ros2(*words).stdout.split()


def test_echo_prints_each_message_at_once(ros2):
    echo = ros2.start("topic", "echo", "/chatter", STRING, "--no-daemon")
    echo.wait_for(r"^data: hello\n---\ndata: hello\n---$")
    code, _ = echo.finish(signal.SIGINT)
    assert code == signal.SIGINT


@pytest.mark.parametrize(
    ("options", "printed"),
    [
        (("--field", "data"), "hello\n---\n"),
        (("--csv",), "hello\n"),
        (("--no-str", "--filter", "m.data == 'hello'"), "data: '<string length: <5>>'\n---\n"),
    ],
    ids=["field", "csv", "filter"],
)
def test_echo_once(ros2, options, printed):
    done = ros2("topic", "echo", "/chatter", STRING, "--once", "--no-daemon", *options)
    assert (done.returncode, done.stdout) == (0, printed)


def test_echo_of_serialised_bytes(ros2):
    done = ros2("topic", "echo", "/chatter", STRING, "--once", "--raw", "--no-daemon")
    assert done.stdout.startswith(repr(b"\x00\x01\x00\x00\x06\x00\x00\x00hello\x00")[:-1])


def test_echo_without_arrays(ros2):
    kind = "std_msgs/msg/UInt8MultiArray"
    ros2.start("topic", "pub", "/bytes", kind, "{data: [1, 2, 3]}", "-r", "20")
    done = ros2("topic", "echo", "/bytes", kind, "--once", "--no-daemon", "--no-arr")
    assert "data: '<sequence type: uint8, length: 3>'\n" in done.stdout


def test_echo_gives_up_after_its_timeout(ros2):
    done = ros2("topic", "echo", "/nothing", STRING, "--timeout", "0.2", "--no-daemon")
    assert (done.returncode, done.stdout) == (0, "")


@pytest.mark.parametrize(
    ("words", "error"),
    [
        (("echo", "/chatter", "no_such_msgs/msg/Thing"), "The passed message type is invalid"),
        (("pub", "/chatter", STRING, "just text", "-1", "-w", "0"), "needs to be a dictionary"),
        (("pub", "/other", STRING, "nope: 1", "-1", "-w", "0"), "Failed to populate field"),
        (("echo", "/chatter", STRING, "--field", "nope"), "Invalid field 'nope'"),
    ],
    ids=["type", "yaml", "value", "field"],
)
def test_errors_are_told_on_standard_error(ros2, words, error):
    done = ros2("topic", *words)
    assert done.returncode == 1
    assert error in done.stderr
    assert "Traceback" not in done.stderr


def test_echo_asks_for_the_latched_message_of_a_transient_local_publisher(ros2):
    latched = ("--qos-durability", "transient_local", "--keep-alive", "60", "-w", "0")
    publishing = ros2.start("topic", "pub", "/latched", STRING, "data: kept", "-1", *latched)
    publishing.wait_for("publishing #1")
    words = ("topic", "echo", "/latched", "--once", "--no-daemon")
    # Without a type on the command line, the type is found in the graph as well.
    ros2.until(lambda out: out == "data: kept\n---\n", *words)


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
    done = ros2("topic", "pub", "--once", "--max-wait-time-secs", "0.3", "/nobody", STRING)
    assert done.returncode == 1
    assert "Timed out waiting for subscribers: Expected 1" in done.stderr


def test_pub_stamps_a_header_with_the_present_time(ros2):
    kind = "geometry_msgs/msg/PointStamped"
    ros2.start("topic", "pub", "/point", kind, "{header: auto, point: {x: 1.5}}", "-r", "20")
    printed = ros2("topic", "echo", "/point", kind, "--once", "--no-daemon").stdout
    assert int(re.search(r"sec: (\d+)", printed)[1]) > 1_600_000_000
    assert "  x: 1.5\n" in printed


def test_hz(ros2):
    hz = ros2.start("topic", "hz", "/chatter", "--window", "100")
    rate = hz.wait_for(
        r"^average rate: (\d+\.\d{3})\n"
        r"\tmin: \d+\.\d{3}s max: \d+\.\d{3}s std dev: \d+\.\d{5}s window: \d+$"
    )
    # The mean of a second's intervals of the 50 Hz asked for; a busy machine delays, it does not hasten.
    assert 20 < float(rate[1]) < 65
    code, _ = hz.finish(signal.SIGINT)
    assert code == signal.SIGINT


def test_bw(ros2):
    bandwidth = ros2.start("topic", "bw", "/chatter")
    bandwidth.wait_for(r"^Subscribed to \[/chatter\]$")
    bandwidth.wait_for(
        r"^\d+(\.\d+)? K?B/s from \d+ messages\n\tMessage size mean: .+ min: .+ max: .+$"
    )
