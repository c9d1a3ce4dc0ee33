# SPDX-License-Identifier: Apache-2.0
"""What can still be read of a storage file that was never completed."""

from __future__ import annotations

import io
import sqlite3
import struct
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO

from rosbags.interfaces import Connection, ConnectionExtRosbag2, Qos
from rosbags.rosbag2 import Reader
from rosbags.rosbag2.metadata import parse_qos

_MAGIC = b"\x89MCAP0\r\n"
_SCHEMA, _CHANNEL, _MESSAGE, _CHUNK, _DATA_END = 3, 4, 5, 6, 15


@dataclass(frozen=True)
class Topic:
    """A topic of the file.

    Attributes:
        name: Its full name.
        msgtype: Its type.
        definition: The text of the type's definition.
        offers: What its publishers offered.
    """

    name: str
    msgtype: str
    definition: str
    offers: tuple[Qos, ...]


def surviving_messages(file: Path) -> Iterator[tuple[Topic, int, bytes]]:
    """Read every message that reached the disk whole.

    A database is rolled back to its last commit first.

    Args:
        file: The storage file.

    Yields:
        Topic, time stamp (ns) and serialised message, in the order of the file.

    Raises:
        RuntimeError: The file is no storage of a bag.
    """
    yield from _of_mcap(file) if file.suffix == ".mcap" else _of_sqlite(file)


def _of_sqlite(file: Path) -> Iterator[tuple[Topic, int, bytes]]:
    # Opened for writing and read once, a database undoes the transaction it was killed in.
    database = sqlite3.connect(file)
    database.execute("SELECT count(*) FROM sqlite_master").fetchone()
    database.close()
    with Reader(file) as reader:
        topics = {connection.id: _topic_of(connection) for connection in reader.connections}
        for connection, stamp, data in reader.messages():
            yield topics[connection.id], stamp, data


def _topic_of(connection: Connection) -> Topic:
    assert isinstance(connection.ext, ConnectionExtRosbag2)
    offers = tuple(connection.ext.offered_qos_profiles)
    return Topic(connection.topic, connection.msgtype, connection.msgdef.data, offers)


def _of_mcap(file: Path) -> Iterator[tuple[Topic, int, bytes]]:
    schemas: dict[int, tuple[str, str]] = {}
    topics: dict[int, Topic] = {}
    with file.open("rb") as stream:
        if stream.read(len(_MAGIC)) != _MAGIC:
            raise RuntimeError(f"'{file}' is not an mcap file")
        for code, body in _records(stream):
            if code == _SCHEMA:
                (number,) = struct.unpack_from("<H", body)
                name, at = _string(body, 2)
                _encoding, at = _string(body, at)
                schemas[number] = (name, _string(body, at)[0])
            elif code == _CHANNEL:
                number, schema = struct.unpack_from("<HH", body)
                name, at = _string(body, 4)
                _encoding, at = _string(body, at)
                offers = parse_qos(_map(body, at).get("offered_qos_profiles", ""))
                topics[number] = Topic(name, *schemas[schema], tuple(offers))
            elif code == _MESSAGE:
                number, stamp = struct.unpack_from("<HxxxxQ", body)
                yield topics[number], stamp, body[22:]


def _records(stream: BinaryIO) -> Iterator[tuple[int, bytes]]:
    """Read records up to the end of the data or the first incomplete one, inside chunks too."""
    while len(head := stream.read(9)) == 9:
        code, length = struct.unpack("<BQ", head)
        body = stream.read(length)
        if len(body) < length or code == _DATA_END:
            return
        if code == _CHUNK:
            compression, at = _string(body, 28)
            if compression:
                raise RuntimeError(f"The bag is compressed by {compression}; use 'mcap recover'")
            yield from _records(io.BytesIO(body[at + 8 :]))
        else:
            yield code, body


def _string(body: bytes, at: int) -> tuple[str, int]:
    (length,) = struct.unpack_from("<I", body, at)
    end = at + 4 + length
    return body[at + 4 : end].decode(), end


def _map(body: bytes, at: int) -> dict[str, str]:
    entries = {}
    end = at + 4 + struct.unpack_from("<I", body, at)[0]
    at += 4
    while at < end:
        key, at = _string(body, at)
        entries[key], at = _string(body, at)
    return entries
