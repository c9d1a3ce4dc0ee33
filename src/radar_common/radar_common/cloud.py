# SPDX-License-Identifier: Apache-2.0
"""Tables as `sensor_msgs/PointCloud2`, in both directions, without a copy where the layout allows it.

The codec knows no message package: the classes are handed in, so that the same code serves a node (`radar_common.ros`)
and a program that reads bags without ROS (`radar_common.bag`).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from radar_common.tables import NANOSECONDS, Table

_DATATYPES: dict[np.dtype[Any], int] = {
    np.dtype(np.int8): 1,
    np.dtype(np.uint8): 2,
    np.dtype(np.int16): 3,
    np.dtype(np.uint16): 4,
    np.dtype(np.int32): 5,
    np.dtype(np.uint32): 6,
    np.dtype(np.float32): 7,
    np.dtype(np.float64): 8,
}
_DTYPES = {number: dtype for dtype, number in _DATATYPES.items()}


class TableError(ValueError):
    """A message does not hold the table that it should."""


@dataclass(frozen=True, slots=True)
class MessageTypes:
    """The classes that a message family offers, and how it wants a byte array."""

    PointCloud2: Callable[..., Any]
    PointField: Callable[..., Any]
    Header: Callable[..., Any]
    Time: Callable[..., Any]
    bytes_of: Callable[[npt.NDArray[np.uint8]], Any]


def encode(table: Table, types: MessageTypes) -> Any:
    """Write a table as a point cloud.

    Args:
        table: rows of any dtype made of PointCloud2's eight number types and one-dimensional arrays of them.
        types: message classes to build with.

    Returns:
        A PointCloud2 of `types`, one row a point.

    Raises:
        TableError: a field has no PointField datatype.
    """
    dtype = table.rows.dtype
    fields = []
    for name in dtype.names or ():
        base, offset, count = _field(dtype, name)
        if base not in _DATATYPES:
            raise TableError(f"field {name!r} of type {base} has no PointField datatype")
        fields.append(
            types.PointField(name=name, offset=offset, datatype=_DATATYPES[base], count=count)
        )
    rows = np.ascontiguousarray(table.rows)
    seconds, nanoseconds = divmod(table.stamp, NANOSECONDS)
    return types.PointCloud2(
        header=types.Header(
            stamp=types.Time(sec=seconds, nanosec=nanoseconds), frame_id=table.frame_id
        ),
        height=1,
        width=len(rows),
        fields=fields,
        is_bigendian=False,
        point_step=dtype.itemsize,
        row_step=dtype.itemsize * len(rows),
        data=types.bytes_of(rows.view(np.uint8).reshape(-1)),
        is_dense=True,
    )


def decode(message: Any, expected: np.dtype[np.void] | None = None) -> Table:
    """Read the table that a point cloud holds, as a view of its data if that has the layout expected.

    Fields may stand in any order and beside others, in either order of bytes; names, types and counts must be those
    of `expected`.

    Args:
        message: PointCloud2 of any message family.
        expected: dtype whose fields are wanted; None takes all fields as they are.

    Returns:
        The table, its rows of dtype `expected`.

    Raises:
        TableError: sizes contradict each other, or a field is missing, has another type or another count.
    """
    stride, width, height = message.point_step, message.width, message.height
    data = np.frombuffer(message.data, np.uint8)
    if height != 1 and message.row_step != stride * width:
        raise TableError(f"row step {message.row_step} is not {width} points of {stride} bytes")
    if stride * width * height != data.size:
        raise TableError(
            f"{width} x {height} points of {stride} bytes announced, {data.size} bytes sent"
        )
    rows = data.view(_layout(message, stride)).reshape(-1) if data.size else _empty(message, stride)
    if expected is not None:
        rows = _select(rows, expected)
    stamp = message.header.stamp
    return Table(stamp.sec * NANOSECONDS + stamp.nanosec, rows, message.header.frame_id)


def require_finite(rows: npt.NDArray[np.void], *names: str) -> npt.NDArray[np.bool_]:
    """Tell which rows hold only finite numbers in the named fields.

    Args:
        rows: structured array, shape (n,).
        names: fields to look at.

    Returns:
        Boolean array, shape (n,).
    """
    good = np.ones(len(rows), dtype=bool)
    for name in names:
        finite = np.isfinite(rows[name])
        good &= finite if finite.ndim == 1 else finite.all(axis=1)
    return good


def _field(dtype: np.dtype[np.void], name: str) -> tuple[np.dtype[Any], int, int]:
    assert dtype.fields is not None
    field, offset = dtype.fields[name][:2]
    return field.base, offset, math.prod(field.shape)


def _layout(message: Any, stride: int) -> np.dtype[np.void]:
    order: Literal["<", ">"] = ">" if message.is_bigendian else "<"
    names, formats, offsets = [], [], []
    for field in message.fields:
        if field.datatype not in _DTYPES:
            raise TableError(f"field {field.name!r} has unknown datatype {field.datatype}")
        base = _DTYPES[field.datatype].newbyteorder(order)
        if field.offset + base.itemsize * field.count > stride:
            raise TableError(
                f"field {field.name!r} reaches beyond the point step of {stride} bytes"
            )
        names.append(field.name)
        formats.append(base if field.count == 1 else (base, (field.count,)))
        offsets.append(field.offset)
    try:
        return np.dtype(
            {"names": names, "formats": formats, "offsets": offsets, "itemsize": stride}
        )
    except (ValueError, TypeError) as error:
        raise TableError(f"fields do not make a row: {error}") from error


def _empty(message: Any, stride: int) -> npt.NDArray[np.void]:
    return np.empty(0, _layout(message, stride))


def _select(rows: npt.NDArray[np.void], expected: np.dtype[np.void]) -> npt.NDArray[np.void]:
    if rows.dtype == expected:
        return rows
    found = rows.dtype.names or ()
    for name in expected.names or ():
        if name not in found:
            raise TableError(f"field {name!r} is missing; the message has {', '.join(found)}")
        base, _, count = _field(rows.dtype, name)
        wanted_base, _, wanted_count = _field(expected, name)
        if base.newbyteorder("=") != wanted_base.newbyteorder("=") or count != wanted_count:
            raise TableError(
                f"field {name!r} is {base}[{count}], expected {wanted_base}[{wanted_count}]"
            )
    return rows[list(expected.names or ())].astype(expected)
