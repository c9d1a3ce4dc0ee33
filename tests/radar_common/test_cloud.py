# SPDX-License-Identifier: Apache-2.0
"""Tables survive the trip through PointCloud2 in both message families, and nothing else passes for one."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from radar_common import bag
from radar_common.cloud import TableError, decode, encode, require_finite
from radar_common.ros.messages import TYPES as ROS_TYPES
from radar_common.tables import BEARING, PLOT, TRACK, TRUTH, Table, sweep_dtype

LAYOUTS = {
    "plots": PLOT,
    "tracks": TRACK,
    "bearings": BEARING,
    "truth": TRUTH,
    "float sweeps": sweep_dtype(7),
    "8 bit sweeps": sweep_dtype(7, np.uint8),
    "16 bit sweeps": sweep_dtype(3, np.uint16),
}
FAMILIES = {"rosidl": ROS_TYPES, "rosbags": bag._TYPES}


@pytest.fixture(params=FAMILIES.values(), ids=FAMILIES.keys())
def types(request):
    return request.param


def rows_of(dtype, count=3):
    return np.arange(count * dtype.itemsize, dtype=np.uint8).view(dtype)


@pytest.mark.parametrize("dtype", LAYOUTS.values(), ids=LAYOUTS.keys())
@pytest.mark.parametrize("family", FAMILIES.values(), ids=FAMILIES.keys())
@given(data=st.data())
def test_round_trip(dtype, family, data):
    raw = data.draw(hnp.arrays(np.uint8, st.integers(0, 5).map(lambda n: n * dtype.itemsize)))
    stamp = data.draw(st.integers(0, 2**31 * 10**9 - 1))
    table = Table(stamp, raw.view(dtype), "radar")
    back = decode(encode(table, family), dtype)
    assert back.stamp == stamp
    assert back.frame_id == "radar"
    assert back.rows.dtype == dtype
    assert back.rows.tobytes() == raw.tobytes()


def test_decoding_copies_nothing(types):
    message = encode(Table(0, rows_of(PLOT)), types)
    rows = decode(message, PLOT).rows
    assert np.shares_memory(rows, np.frombuffer(message.data, np.uint8))


def test_fields_may_stand_in_any_order_beside_others(types):
    wider = np.dtype([("extra", "<u1"), *reversed([(n, PLOT[n]) for n in PLOT.names])])
    rows = np.zeros(2, wider)
    rows["range"] = [10.0, 20.0]
    back = decode(encode(Table(5, rows), types), PLOT)
    assert back.rows.dtype == PLOT
    np.testing.assert_array_equal(back.rows["range"], [10.0, 20.0])


def test_big_endian_messages_are_read(types):
    rows = rows_of(PLOT)
    message = encode(Table(0, rows), types)
    message.is_bigendian = True
    message.data = types.bytes_of(rows.astype(PLOT.newbyteorder(">")).view(np.uint8))
    back = decode(message, PLOT)
    assert back.rows.dtype == PLOT
    assert back.rows.tobytes() == rows.tobytes()


def test_an_organised_cloud_is_read_row_by_row(types):
    message = encode(Table(0, rows_of(PLOT, 6)), types)
    message.height, message.width, message.row_step = 2, 3, 3 * PLOT.itemsize
    assert decode(message, PLOT).rows.tobytes() == rows_of(PLOT, 6).tobytes()
    message.row_step += 1
    with pytest.raises(TableError, match="row step"):
        decode(message, PLOT)


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        ({"width": 4}, "announced"),
        ({"point_step": 0}, "announced"),
        ({"point_step": 10, "width": 3 * PLOT.itemsize // 10}, "announced|beyond"),
    ],
)
def test_contradicting_sizes_are_refused(types, change, reason):
    message = encode(Table(0, rows_of(PLOT)), types)
    for name, value in change.items():
        setattr(message, name, value)
    with pytest.raises(TableError, match=reason):
        decode(message, PLOT)


@pytest.mark.parametrize(
    ("attribute", "value", "reason"),
    [
        ("name", "rnage", "missing"),
        ("datatype", 7, "expected"),
        ("datatype", 99, "unknown datatype"),
        ("count", 2, "expected|beyond"),
        ("offset", 10_000, "beyond"),
        ("name", "azimuth", "row|missing"),
    ],
)
def test_wrong_fields_are_refused(types, attribute, value, reason):
    message = encode(Table(0, rows_of(PLOT)), types)
    field = next(f for f in message.fields if f.name == "range")
    setattr(field, attribute, value)
    with pytest.raises(TableError, match=reason):
        decode(message, PLOT)


def test_an_empty_message_still_has_to_have_the_fields(types):
    message = encode(Table(0, np.empty(0, PLOT)), types)
    assert len(decode(message, PLOT).rows) == 0
    message.fields = message.fields[1:]
    with pytest.raises(TableError, match="missing"):
        decode(message, PLOT)


def test_a_type_without_a_datatype_is_not_encoded(types):
    with pytest.raises(TableError, match="no PointField"):
        encode(Table(0, np.zeros(1, [("id", "<u8")])), types)


def test_sweeps_of_impossible_shape_are_refused():
    with pytest.raises(ValueError, match="at least one"):
        sweep_dtype(0)
    with pytest.raises(ValueError, match="float32"):
        sweep_dtype(5, np.float64)


def test_rows_with_anything_not_finite_are_found():
    rows = np.zeros(4, TRACK)
    rows["x"][1] = np.nan
    rows["covariance"][2, 5] = np.inf
    np.testing.assert_array_equal(
        require_finite(rows, "x", "covariance"), [True, False, False, True]
    )


def test_times_are_the_stamp_plus_the_offset():
    rows = np.zeros(2, PLOT)
    rows["time_offset"] = [0.25, 0.5]
    table = Table(3_000_000_000, rows)
    np.testing.assert_array_equal(table.times, [3.25, 3.5])
    with pytest.raises(dataclasses.FrozenInstanceError):
        table.stamp = 4
