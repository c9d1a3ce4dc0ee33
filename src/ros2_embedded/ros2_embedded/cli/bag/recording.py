# SPDX-License-Identifier: Apache-2.0
"""A bag while it is written."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Literal, Self

from rosbags.interfaces import Connection, Qos
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.rosbag2.storage_mcap import McapWriter
from rosbags.rosbag2.storage_sqlite3 import Sqlite3Writer

from ros2_embedded.messages.definitions import type_store

STORAGES = {"mcap": StoragePlugin.MCAP, "sqlite3": StoragePlugin.SQLITE3}

_METADATA_VERSION_OF_JAZZY: Literal[9] = 9


class Recording:
    """Writes serialised messages to a new bag.

    A context manager: the bag is complete only after the block, which is also when its index
    and metadata are written if the block fails. What `checkpoint` has put on the disk survives a
    kill: of a sqlite3 bag `ros2 bag reindex` recovers it, of an mcap bag the `mcap recover`
    command of Foxglove, as there is no index without a proper end.

    Args:
        path: The directory to create.
        storage: "mcap" or "sqlite3".
        custom_data: Further entries of the metadata.

    Raises:
        OSError: The directory cannot be created.
        rosbags.rosbag2.WriterError: It exists.
    """

    def __init__(self, path: Path, storage: str, custom_data: Mapping[str, str]) -> None:
        self._writer = Writer(
            path, version=_METADATA_VERSION_OF_JAZZY, storage_plugin=STORAGES[storage]
        )
        for key, value in custom_data.items():
            self._writer.set_custom_data(key, value)
        self._writer.open()
        self._connections: dict[str, Connection] = {}
        self._dirty = False

    def __enter__(self) -> Self:
        """Start the block of the recording."""
        return self

    def __exit__(self, *_failure: object) -> None:
        """Complete the bag with its index and metadata."""
        self._writer.close()

    @property
    def messages(self) -> int:
        """Number of messages written so far."""
        return sum(self._writer.counts.values())

    @property
    def topics(self) -> int:
        """Number of topics, those without a message too."""
        return len(self._connections)

    def add_topic(self, topic: str, msgtype: str, type_hash: str, offers: Sequence[Qos]) -> None:
        """Prepare for the messages of a topic.

        Args:
            topic: Its full name.
            msgtype: Its type.
            type_hash: The hash that its publishers announce; empty if they do not.
            offers: What its publishers offer.
        """
        store = type_store()
        definition, _ = store.generate_msgdef(msgtype, ros_version=2)
        self._connections[topic] = self._writer.add_connection(
            topic,
            msgtype,
            msgdef=definition,
            rihs01=type_hash or store.hash_rihs01(msgtype),
            offered_qos_profiles=offers,
        )

    def write(self, topic: str, timestamp: int, data: bytes) -> None:
        """Append a message.

        Args:
            topic: Its topic.
            timestamp: When it was received (ns).
            data: The message, serialised.
        """
        self._writer.write(self._connections[topic], timestamp, data)
        self._dirty = True

    def checkpoint(self) -> None:
        """Put on the disk what has been written, as far as the storage allows."""
        if not self._dirty:
            return
        storage = self._writer.storage
        if isinstance(storage, Sqlite3Writer):
            storage.conn.commit()
        elif isinstance(storage, McapWriter):
            storage.close_chunk()
            storage.bio.flush()
        self._dirty = False
