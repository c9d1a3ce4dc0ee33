# SPDX-License-Identifier: Apache-2.0
"""Opens bags for reading, with one clear error for whatever may be wrong with them."""

from __future__ import annotations

import argparse
import struct
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from rosbags.rosbag2 import Reader


def add_bag_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of a verb that reads a bag.

    Args:
        parser: The parser of the verb.
    """
    parser.add_argument("bag_path", type=_existing_path, help="Bag to open")
    parser.add_argument(
        "-s",
        "--storage",
        choices=("mcap", "sqlite3"),
        help="Accepted; the storage of a bag is always detected",
    )


@contextmanager
def open_bag(path: Path) -> Iterator[Reader]:
    """Open a bag.

    Args:
        path: The bag's directory, or one storage file.

    Yields:
        The open reader.

    Raises:
        RuntimeError: The bag is damaged, its metadata are missing, or it is no bag at all.
            This holds for what the block reads, too.
    """
    if path.is_dir() and not (path / "metadata.yaml").is_file():
        raise RuntimeError(
            f"Could not find metadata.yaml in bag directory '{path}': the recording may have "
            f"been killed. Try 'ros2 bag reindex {path}'."
        )
    with reading(path):
        for database in [path] if path.suffix == ".db3" else path.glob("*.db3"):
            _check_length(database)
        with Reader(path) as reader:
            yield reader


@contextmanager
def reading(path: Path) -> Iterator[None]:
    """Turn whatever goes wrong while a bag is read into one error that names the bag.

    Args:
        path: The bag.

    Raises:
        RuntimeError: The block failed. BrokenPipeError, which is about the output, passes.
    """
    try:
        yield
    except (RuntimeError, BrokenPipeError):
        raise
    except Exception as error:
        # A damaged file can fail anywhere in the parsers of YAML, SQLite, MCAP or zstd.
        reason = " ".join(str(error).split())
        raise RuntimeError(f"Could not read bag '{path}': {reason}") from error


def _check_length(database: Path) -> None:
    """Refuse a database that has lost its end, which SQLite notices only when it gets there."""
    with database.open("rb") as file:
        header = file.read(100)
    page_size, page_count = struct.unpack_from(">16xH10xI", header.ljust(100, b"\0"))
    # The format writes a page of 65536 bytes, too large for its field, as 1.
    expected = (65536 if page_size == 1 else page_size) * page_count
    if not header or database.stat().st_size < expected:
        raise RuntimeError(f"Could not read bag '{database}': the file is truncated")


def _existing_path(text: str) -> Path:
    path = Path(text)
    if not path.exists():
        raise argparse.ArgumentTypeError(f"Bag path '{text}' does not exist!")
    return path
