# SPDX-License-Identifier: Apache-2.0
"""What survives the sudden death of a recorder, and how it is made a bag again."""

from __future__ import annotations

import signal
import subprocess
import sys

import pytest
from rosbags.rosbag2 import Reader
from rosbags.typesys import Stores, get_typestore

from ros2_embedded.cli.main import main

STRING = "std_msgs/msg/String"

# Writes 300 messages, puts them on the disk, writes 50 more and dies.
VICTIM = """
import os, signal, sys
from pathlib import Path
from rosbags.typesys import Stores, get_typestore
from ros2_embedded.cli.bag.recording import Recording
store = get_typestore(Stores.ROS2_JAZZY)
kind = "std_msgs/msg/String"
recording = Recording(Path(sys.argv[1]), sys.argv[2], {})
recording.add_topic("/chatter", kind, "", [])
for index in range(350):
    data = store.serialize_cdr(store.types[kind](data=f"{index} " + "x" * 2000), kind)
    recording.write("/chatter", 1_000_000_000 + index, bytes(data))
    if index == 299:
        recording.checkpoint()
os.kill(os.getpid(), signal.SIGKILL)
"""


@pytest.fixture(params=["mcap", "sqlite3"])
def killed_bag(request, tmp_path):
    path = tmp_path / "rec"
    words = [sys.executable, "-c", VICTIM, str(path), request.param]
    assert subprocess.run(words, check=False).returncode == -signal.SIGKILL
    return path


def test_a_killed_recording_is_refused_with_advice(killed_bag):
    message = main(["bag", "info", str(killed_bag)])
    assert isinstance(message, str)
    assert "ros2 bag reindex" in message


def test_reindex_recovers_all_up_to_the_last_checkpoint(killed_bag, capsys):
    assert main(["bag", "reindex", str(killed_bag)]) is None
    store = get_typestore(Stores.ROS2_JAZZY)
    with Reader(killed_bag) as reader:
        (connection,) = reader.connections
        assert (connection.topic, connection.msgtype) == ("/chatter", STRING)
        assert connection.digest == store.hash_rihs01(STRING)
        texts = [store.deserialize_cdr(data, STRING).data for _, _, data in reader.messages()]
    assert [int(text.split()[0]) for text in texts[:300]] == list(range(300))
    assert f"{len(texts)} messages" in capsys.readouterr().out
    assert main(["bag", "info", str(killed_bag)]) is None
    assert {file.suffix for file in killed_bag.iterdir()} <= {".mcap", ".db3", ".yaml"}


def test_reindex_leaves_a_complete_bag_alone(killed_bag):
    main(["bag", "reindex", str(killed_bag)])
    before = {file: file.read_bytes() for file in killed_bag.iterdir()}
    message = main(["bag", "reindex", str(killed_bag)])
    assert isinstance(message, str)
    assert "already" in message
    assert {file: file.read_bytes() for file in killed_bag.iterdir()} == before
