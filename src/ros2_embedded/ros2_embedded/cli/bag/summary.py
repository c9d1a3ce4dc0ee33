# SPDX-License-Identifier: Apache-2.0
"""What `ros2 bag info` tells about a bag."""

from __future__ import annotations

import time
from dataclasses import dataclass
from pathlib import Path

import yaml
from rosbags.interfaces import ConnectionExtRosbag2
from rosbags.rosbag2 import Reader

_INDENT = " " * 19
_UNITS = ("B", "KiB", "MiB", "GiB", "TiB")


@dataclass(frozen=True, kw_only=True)
class TopicSummary:
    """One topic of a bag.

    Attributes:
        name: Its name.
        msgtype: Its type.
        count: Number of messages.
        serialization: Their serialization format.
    """

    name: str
    msgtype: str
    count: int
    serialization: str

    def __str__(self) -> str:
        """Return the line of the topic."""
        return (
            f"Topic: {self.name} | Type: {self.msgtype} | Count: {self.count} | "
            f"Serialization Format: {self.serialization}"
        )


@dataclass(frozen=True, kw_only=True)
class BagSummary:
    """A bag at a glance.

    Attributes:
        files: Names of the storage files.
        size: Their total size (bytes).
        storage: Identifier of the storage plugin.
        distro: ROS distribution of the recorder.
        start: Time of the first message (ns).
        duration: Time from the first to the last message (ns).
        messages: Number of messages.
        topics: The topics.
    """

    files: tuple[str, ...]
    size: int
    storage: str
    distro: str
    start: int
    duration: int
    messages: int
    topics: tuple[TopicSummary, ...]

    @classmethod
    def of(cls, reader: Reader) -> BagSummary:
        """Summarise an open bag.

        Args:
            reader: The open bag.
        """
        storage, files = _storage(Path(str(reader.path)))
        empty = reader.message_count == 0
        return cls(
            files=tuple(file.name for file in files),
            size=sum(file.stat().st_size for file in files),
            storage=storage,
            distro=reader.ros_distro or "unknown",
            start=0 if empty else reader.start_time,
            # The reader's duration reaches one nanosecond past the last message.
            duration=0 if empty else reader.duration - 1,
            messages=reader.message_count,
            topics=tuple(
                TopicSummary(
                    name=connection.topic,
                    msgtype=connection.msgtype,
                    count=connection.msgcount,
                    serialization=connection.ext.serialization_format,
                )
                for connection in sorted(reader.connections, key=lambda entry: entry.topic)
                if isinstance(connection.ext, ConnectionExtRosbag2)
            ),
        )

    def __str__(self) -> str:
        """Return the table that `ros2 bag info` prints."""
        end = self.start + self.duration
        rows = (
            ("Files", f"\n{_INDENT}".join(self.files)),
            ("Bag size", _size(self.size)),
            ("Storage id", self.storage),
            ("ROS Distro", self.distro),
            ("Duration", f"{_seconds(self.duration)}s"),
            ("Start", _time_point(self.start)),
            ("End", _time_point(end)),
            ("Messages", str(self.messages)),
            ("Topic information", f"\n{_INDENT}".join(str(topic) for topic in self.topics)),
            ("Service", "0"),
        )
        table = "\n".join(f"{name + ':':<18} {value}" for name, value in rows)
        return f"\n{table}\nService information: \n"


def _storage(path: Path) -> tuple[str, list[Path]]:
    """Return the storage identifier and the files of a bag."""
    if path.is_file():
        return "mcap" if path.suffix == ".mcap" else "sqlite3", [path]
    metadata = yaml.safe_load((path / "metadata.yaml").read_text())["rosbag2_bagfile_information"]
    # Old recorders wrote the paths relative to the parent of the bag.
    files = [path / Path(name).name for name in metadata["relative_file_paths"]]
    return metadata["storage_identifier"], files


def _size(count: int) -> str:
    size = float(count)
    index = 0
    while size >= 1024 and index < len(_UNITS) - 1:
        size /= 1024
        index += 1
    return f"{size:.{1 if index else 0}f} {_UNITS[index]}"


def _seconds(nanoseconds: int) -> str:
    return "{}.{:09d}".format(*divmod(nanoseconds, 1_000_000_000))


def _time_point(nanoseconds: int) -> str:
    seconds, fraction = divmod(nanoseconds, 1_000_000_000)
    local = time.strftime("%b %e %Y %H:%M:%S", time.localtime(seconds))
    return f"{local}.{fraction:09d} ({_seconds(nanoseconds)})"
