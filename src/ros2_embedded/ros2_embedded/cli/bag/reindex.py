# SPDX-License-Identifier: Apache-2.0
"""`ros2 bag reindex`: complete a bag whose recorder was killed."""

from __future__ import annotations

import argparse
import shutil
from pathlib import Path

from rosbags.interfaces import Connection
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import get_types_from_msg
from rosbags.typesys.store import Typestore

from ros2_embedded.cli.bag.opening import add_bag_arguments, reading
from ros2_embedded.cli.bag.surviving import Topic, surviving_messages

_PLUGINS = {".mcap": StoragePlugin.MCAP, ".db3": StoragePlugin.SQLITE3}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments.

    Args:
        parser: The parser of the verb.
    """
    add_bag_arguments(parser)


def main(args: argparse.Namespace) -> None:
    """Write the bag anew from what can be read of it, metadata included.

    Args:
        args: The parsed arguments.

    Raises:
        RuntimeError: There is nothing to do, or nothing that can be done.
    """
    bag: Path = args.bag_path
    files = sorted(file for file in bag.glob("*") if file.suffix in _PLUGINS)
    if len(files) != 1:
        raise RuntimeError(f"'{bag}' holds {len(files)} storage files; only one can be reindexed")
    if (bag / "metadata.yaml").exists():
        raise RuntimeError(f"'{bag}' has its metadata already")
    # The old file stays until the new one is complete.
    workshop = bag / "reindex.tmp"
    shutil.rmtree(workshop, ignore_errors=True)
    try:
        with reading(bag):
            count = _rewrite(files[0], workshop / bag.resolve().name)
        (new_file,) = (workshop / bag.resolve().name).glob(f"*{files[0].suffix}")
        # A journal belongs to the old database and would spoil a new one of that name.
        files[0].with_name(f"{files[0].name}-journal").unlink(missing_ok=True)
        new_file.replace(bag / new_file.name)
        (new_file.parent / "metadata.yaml").replace(bag / "metadata.yaml")
        if files[0].name != new_file.name:
            files[0].unlink()
    finally:
        shutil.rmtree(workshop, ignore_errors=True)
    print(f"Reindexing complete: {count} messages in '{bag}'")


def _rewrite(file: Path, target: Path) -> int:
    connections: dict[Topic, Connection] = {}
    count = 0
    with Writer(target, version=9, storage_plugin=_PLUGINS[file.suffix]) as writer:
        for topic, stamp, data in surviving_messages(file):
            if topic not in connections:
                connections[topic] = _add_connection(writer, topic)
            writer.write(connections[topic], stamp, data)
            count += 1
    return count


def _add_connection(writer: Writer, topic: Topic) -> Connection:
    store = Typestore()
    store.register(get_types_from_msg(topic.definition, topic.msgtype))
    return writer.add_connection(
        topic.name,
        topic.msgtype,
        msgdef=topic.definition,
        rihs01=store.hash_rihs01(topic.msgtype),
        offered_qos_profiles=topic.offers,
    )
