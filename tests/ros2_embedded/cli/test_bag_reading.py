# SPDX-License-Identifier: Apache-2.0
"""`ros2 bag info` of good, empty, damaged and incomplete bags; what is selected of a bag."""

from __future__ import annotations

import re

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from rosbags.rosbag2 import Reader, StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore

from ros2_embedded.cli.bag.opening import open_bag
from ros2_embedded.cli.bag.selection import TopicSelection
from ros2_embedded.cli.bag.summary import BagSummary
from ros2_embedded.cli.main import main

STORE = get_typestore(Stores.ROS2_JAZZY)
STRING = "std_msgs/msg/String"
START = 1_700_000_000_123_456_789
STORAGES = {"mcap": StoragePlugin.MCAP, "sqlite3": StoragePlugin.SQLITE3}


def write_bag(path, storage, count=200, period=10_000_000):
    with Writer(path, version=9, storage_plugin=STORAGES[storage]) as writer:
        chatter = writer.add_connection("/chatter", STRING, typestore=STORE)
        writer.add_connection("/silent", STRING, typestore=STORE)
        for index in range(count):
            message = STORE.types[STRING](data=f"message {index} " + "x" * 100)
            data = STORE.serialize_cdr(message, STRING)
            writer.write(chatter, START + index * period, data)
    return path


def failure_to_read(bag):
    """Read a whole bag; any exception but the one that is promised passes through."""
    try:
        with open_bag(bag) as reader:
            BagSummary.of(reader)
            for _message in reader.messages():
                pass
    except RuntimeError as error:
        return str(error)
    return None


@pytest.fixture(params=sorted(STORAGES))
def storage(request):
    return request.param


def test_info_of_a_bag(tmp_path, storage, capsys, monkeypatch):
    monkeypatch.setenv("TZ", "UTC")
    bag = write_bag(tmp_path / "rec", storage)
    assert main(["bag", "info", str(bag)]) is None
    lines = capsys.readouterr().out.splitlines()
    suffix = {"mcap": "mcap", "sqlite3": "db3"}[storage]
    size = (bag / f"rec.{suffix}").stat().st_size
    assert lines == [
        "",
        f"Files:             rec.{suffix}",
        f"Bag size:          {size / 1024:.1f} KiB",
        f"Storage id:        {storage}",
        "ROS Distro:        rosbags",
        "Duration:          1.990000000s",
        "Start:             Nov 14 2023 22:13:20.123456789 (1700000000.123456789)",
        "End:               Nov 14 2023 22:13:22.113456789 (1700000002.113456789)",
        "Messages:          200",
        "Topic information: Topic: /chatter | Type: std_msgs/msg/String | Count: 200 | "
        "Serialization Format: cdr",
        "                   Topic: /silent | Type: std_msgs/msg/String | Count: 0 | "
        "Serialization Format: cdr",
        "Service:           0",
        "Service information: ",
        "",
    ]


def test_info_of_topic_names(tmp_path, storage, capsys):
    bag = write_bag(tmp_path / "rec", storage)
    main(["bag", "info", "-t", str(bag)])
    assert capsys.readouterr().out == "/chatter\n/silent\n"


def test_info_of_a_single_storage_file(tmp_path, storage):
    (file,) = write_bag(tmp_path / "rec", storage).glob("rec.*")
    with open_bag(file) as reader:
        summary = BagSummary.of(reader)
    assert (summary.storage, summary.messages) == (storage, 200)


def test_info_of_an_empty_bag(tmp_path, storage):
    with open_bag(write_bag(tmp_path / "rec", storage, count=0)) as reader:
        summary = BagSummary.of(reader)
    assert (summary.messages, summary.duration) == (0, 0)
    assert "Messages:          0" in str(summary)


def test_a_path_that_does_not_exist_is_a_usage_error(tmp_path, capsys):
    with pytest.raises(SystemExit) as exit_:
        main(["bag", "info", str(tmp_path / "nothing")])
    assert exit_.value.code == 2
    assert "does not exist" in capsys.readouterr().err


def test_a_folder_without_metadata_says_so(tmp_path, storage):
    bag = write_bag(tmp_path / "rec", storage)
    (bag / "metadata.yaml").unlink()
    message = main(["bag", "info", str(bag)])
    assert isinstance(message, str)
    assert "metadata.yaml" in message


def test_a_missing_storage_file_says_so(tmp_path, storage):
    bag = write_bag(tmp_path / "rec", storage)
    next(bag.glob("rec.*")).unlink()
    message = main(["bag", "info", str(bag)])
    assert isinstance(message, str)
    assert "missing" in message


@pytest.mark.parametrize("text", ["", "[]", "rosbag2_bagfile_information: 3", "a: [", "\0"])
def test_metadata_that_make_no_sense_are_one_error(tmp_path, storage, text):
    bag = write_bag(tmp_path / "rec", storage)
    (bag / "metadata.yaml").write_text(text)
    message = main(["bag", "info", str(bag)])
    assert isinstance(message, str)
    assert str(bag) in message


@pytest.mark.parametrize("fraction", [0.0, 0.05, 0.5, 0.99])
def test_a_truncated_bag_is_one_error(tmp_path, storage, fraction):
    bag = write_bag(tmp_path / "rec", storage)
    (file,) = bag.glob("rec.*")
    file.write_bytes(file.read_bytes()[: int(fraction * file.stat().st_size)])
    message = main(["bag", "info", str(bag)])
    assert isinstance(message, str)
    assert str(bag) in message
    assert "\n" not in message


@settings(
    max_examples=25, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(data=st.data())
def test_a_damaged_bag_is_read_or_refused_but_nothing_else(tmp_path_factory, storage, data):
    bag = tmp_path_factory.mktemp("damaged") / "rec"
    write_bag(bag, storage, count=20)
    (file,) = bag.glob("rec.*")
    content = bytearray(file.read_bytes())
    for _ in range(data.draw(st.integers(1, 20))):
        content[data.draw(st.integers(0, len(content) - 1))] = data.draw(st.integers(0, 255))
    file.write_bytes(content)
    error = failure_to_read(bag)
    assert error is None or str(bag) in error


def test_the_reader_s_own_summary_agrees(tmp_path, storage):
    bag = write_bag(tmp_path / "rec", storage)
    with Reader(bag) as reader:
        stamps = [stamp for _, stamp, _ in reader.messages()]
        summary = BagSummary.of(reader)
    assert summary.start == min(stamps)
    assert summary.duration == max(stamps) - min(stamps)


@pytest.mark.parametrize(
    ("selection", "taken"),
    [
        (TopicSelection(everything=True), {"/a", "/b/c"}),
        (TopicSelection(everything=True, hidden=True), {"/a", "/b/c", "/b/_d"}),
        (TopicSelection(topics=frozenset({"/a", "/b/_d"})), {"/a"}),
        (TopicSelection(pattern=re.compile("^/b")), {"/b/c"}),
        (TopicSelection(types=frozenset({"x/msg/C"})), {"/b/c"}),
        (TopicSelection(everything=True, excluded_topics=frozenset({"/a"})), {"/b/c"}),
        (TopicSelection(everything=True, excluded_types=frozenset({"x/msg/C"})), {"/a"}),
        (TopicSelection(everything=True, excluded_pattern=re.compile("c$")), {"/a"}),
        (TopicSelection(), set()),
    ],
)
def test_selection(selection, taken):
    topics = {"/a": "x/msg/A", "/b/c": "x/msg/C", "/b/_d": "x/msg/D"}
    assert {topic for topic, kind in topics.items() if selection.takes(topic, kind)} == taken
