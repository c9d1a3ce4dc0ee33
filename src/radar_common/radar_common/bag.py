# SPDX-License-Identifier: Apache-2.0
"""Tables and platform states in rosbag2 recordings, read and written without a running ROS.

Needs the package `rosbags` (pip install rosbags), which brings storage and serialisation.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from types import TracebackType
from typing import Any, Final, Self

import numpy as np
from rosbags.highlevel import AnyReader, AnyReaderError
from rosbags.interfaces import (
    Connection,
    Qos,
    QosDurability,
    QosHistory,
    QosLiveliness,
    QosReliability,
    QosTime,
)
from rosbags.rosbag2 import StoragePlugin, Writer, WriterError
from rosbags.serde import SerdeError
from rosbags.typesys import Stores, get_typestore

from radar_common.cloud import MessageTypes, TableError, decode, encode
from radar_common.health import Health
from radar_common.odometry import OdometryTypes, PlatformState, decode_odometry, encode_odometry
from radar_common.tables import NANOSECONDS, Table

CLOUD = "sensor_msgs/msg/PointCloud2"
ODOMETRY = "nav_msgs/msg/Odometry"
STORAGES = {"sqlite3": StoragePlugin.SQLITE3, "mcap": StoragePlugin.MCAP}

_STORE = get_typestore(Stores.ROS2_JAZZY)
_TYPES = MessageTypes(
    PointCloud2=_STORE.types[CLOUD],
    PointField=_STORE.types["sensor_msgs/msg/PointField"],
    Header=_STORE.types["std_msgs/msg/Header"],
    Time=_STORE.types["builtin_interfaces/msg/Time"],
    bytes_of=lambda data: data,
)
_ODOMETRY_TYPES = OdometryTypes(
    Odometry=_STORE.types[ODOMETRY],
    PoseWithCovariance=_STORE.types["geometry_msgs/msg/PoseWithCovariance"],
    Pose=_STORE.types["geometry_msgs/msg/Pose"],
    Point=_STORE.types["geometry_msgs/msg/Point"],
    Quaternion=_STORE.types["geometry_msgs/msg/Quaternion"],
    TwistWithCovariance=_STORE.types["geometry_msgs/msg/TwistWithCovariance"],
    Twist=_STORE.types["geometry_msgs/msg/Twist"],
    Vector3=_STORE.types["geometry_msgs/msg/Vector3"],
    Header=_STORE.types["std_msgs/msg/Header"],
    Time=_STORE.types["builtin_interfaces/msg/Time"],
)
_JAZZY_BAG_VERSION: Final = 9
_FOREVER = QosTime(9223372036, 854775807)
_RELIABLE = Qos(
    QosHistory.KEEP_LAST,
    256,
    QosReliability.RELIABLE,
    QosDurability.VOLATILE,
    _FOREVER,
    _FOREVER,
    QosLiveliness.AUTOMATIC,
    _FOREVER,
    avoid_ros_namespace_conventions=False,
)


class BagError(RuntimeError):
    """A bag cannot be read or written; the text says which and why."""


class BagWriter:
    """Writes tables and platform states into a new bag, as a context manager."""

    def __init__(self, path: str | Path, *, storage: str = "mcap") -> None:
        """Prepare a bag; nothing is written before the context is entered.

        Args:
            path: folder of the bag, which must not exist yet.
            storage: "mcap" or "sqlite3".

        Raises:
            BagError: the storage is neither of the two, or the folder exists.
        """
        if storage not in STORAGES:
            raise BagError(f"storage {storage!r} is none of {', '.join(STORAGES)}")
        try:
            self._writer = Writer(
                Path(path), version=_JAZZY_BAG_VERSION, storage_plugin=STORAGES[storage]
            )
        except WriterError as error:
            raise BagError(str(error)) from error
        self._connections: dict[str, Connection] = {}
        self._latest: dict[str, int] = {}

    def __enter__(self) -> Self:
        """Open the bag."""
        self._writer.open()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Close the bag, also after an error, so that what was written can be read."""
        self._writer.close()

    def write(self, topic: str, table: Table, *, log_time: int | None = None) -> None:
        """Append one table.

        Args:
            topic: name without the leading slash.
            table: what to write.
            log_time: nanoseconds at which the message counts as received; None takes the time of its latest row,
                when a live message would have been sent, but not before the message ahead of it on the topic.
        """
        if log_time is None:
            latest = table.rows["time_offset"].max(initial=0.0)
            log_time = table.stamp + round(float(latest) * NANOSECONDS)
            log_time = max(log_time, self._latest.get(topic, log_time))
        self._latest[topic] = log_time
        self._append(topic, CLOUD, encode(table, _TYPES), log_time)

    def write_odometry(
        self, topic: str, state: PlatformState, *, log_time: int | None = None
    ) -> None:
        """Append a platform's state.

        Args:
            topic: name without the leading slash.
            state: what to write, as nav_msgs/Odometry.
            log_time: nanoseconds at which the message counts as received; None takes its stamp.
        """
        log_time = state.stamp if log_time is None else log_time
        self._append(topic, ODOMETRY, encode_odometry(state, _ODOMETRY_TYPES), log_time)

    def _append(self, topic: str, kind: str, message: Any, log_time: int) -> None:
        if topic not in self._connections:
            self._connections[topic] = self._writer.add_connection(
                f"/{topic}", kind, typestore=_STORE, offered_qos_profiles=[_RELIABLE]
            )
        data = _STORE.serialize_cdr(message, kind)
        self._writer.write(self._connections[topic], log_time, data)


def read_tables(
    path: str | Path,
    expected: Mapping[str, np.dtype[np.void] | None],
    health: Health | None = None,
) -> Iterator[tuple[str, Table]]:
    """Read tables of a bag in order of their log time.

    A message that does not hold its table is dropped and counted, as a live node would.

    Args:
        path: folder of the bag.
        expected: topics without the leading slash, each with the dtype whose fields are wanted or None for all.
        health: where dropped messages are counted.

    Yields:
        (topic, table).

    Raises:
        BagError: the bag is missing, truncated or not readable.
    """
    for topic, content in read_messages(path, expected, health=health):
        if isinstance(content, Table):
            yield topic, content


def read_odometry(
    path: str | Path, topic: str, health: Health | None = None
) -> Iterator[PlatformState]:
    """Read the states of a platform in order of their log time.

    Args:
        path: folder of the bag.
        topic: name without the leading slash.
        health: where messages that hold no state are counted, which are dropped.

    Yields:
        States.

    Raises:
        BagError: the bag is missing, truncated or not readable.
    """
    for _, content in read_messages(path, {}, odometry=topic, health=health):
        if isinstance(content, PlatformState):
            yield content


def read_messages(
    path: str | Path,
    expected: Mapping[str, np.dtype[np.void] | None],
    *,
    odometry: str | None = None,
    health: Health | None = None,
) -> Iterator[tuple[str, Table | PlatformState]]:
    """Read tables and a platform's states together, in order of their log time.

    Args:
        path: folder of the bag.
        expected: topics of tables, as for `read_tables`.
        odometry: topic of the states; None for none.
        health: where dropped messages are counted.

    Yields:
        (topic, table or state).

    Raises:
        BagError: the bag is missing, truncated or not readable.
    """
    wanted = {(f"/{topic}", CLOUD): topic for topic in expected}
    if odometry is not None:
        wanted[f"/{odometry}", ODOMETRY] = odometry
    try:
        with AnyReader([Path(path)], default_typestore=_STORE) as reader:
            connections = [c for c in reader.connections if (c.topic, c.msgtype) in wanted]
            # An empty list would stand for all of them.
            for connection, _, data in reader.messages(connections) if connections else ():
                kind = connection.msgtype
                topic = wanted[connection.topic, kind]
                try:
                    message = reader.deserialize(data, kind)
                    if kind == ODOMETRY:
                        yield topic, decode_odometry(message)
                    else:
                        yield topic, decode(message, expected[topic])
                except (TableError, SerdeError) as error:
                    if health is not None:
                        health.drop(f"{topic}: {error}")
    except (AnyReaderError, OSError) as error:
        raise BagError(f"bag {path}: {error}") from error


def topics(path: str | Path, kind: str = CLOUD) -> dict[str, int]:
    """List the topics of a bag that carry tables, or messages of another type.

    Args:
        path: folder of the bag.
        kind: type of the messages.

    Returns:
        Topic without the leading slash and number of messages.

    Raises:
        BagError: the bag is missing, truncated or not readable.
    """
    try:
        with AnyReader([Path(path)], default_typestore=_STORE) as reader:
            return {
                connection.topic.removeprefix("/"): connection.msgcount
                for connection in reader.connections
                if connection.msgtype == kind
            }
    except (AnyReaderError, OSError) as error:
        raise BagError(f"bag {path}: {error}") from error
