# SPDX-License-Identifier: Apache-2.0
"""What message classes refuse, with their checks switched on."""

from __future__ import annotations

import array
from collections import UserList

import numpy as np
import pytest
from builtin_interfaces.msg import Duration, Time
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import Point, PoseWithCovariance
from rcl_interfaces.msg import IntegerRange, ParameterDescriptor
from sensor_msgs.msg import Image, JointState, PointCloud2, PointField
from std_msgs.msg import (
    Bool,
    Byte,
    ByteMultiArray,
    Float32,
    Float64,
    Float64MultiArray,
    Header,
    Int8,
    Int64,
    String,
    UInt8,
    UInt64,
)

REFUSED = [
    (Bool, "data", 1),
    (Bool, "data", np.bool_(True)),
    (Float64, "data", 1),
    (Float64, "data", "1.0"),
    (Float64, "data", np.float32(1.0)),
    (Float32, "data", 1e39),
    (Int8, "data", 128),
    (Int8, "data", -129),
    (Int8, "data", 1.0),
    (UInt8, "data", 256),
    (UInt8, "data", -1),
    (UInt8, "data", np.uint8(1)),
    (Int64, "data", 2**63),
    (UInt64, "data", 2**64),
    (UInt64, "data", -1),
    (String, "data", b"bytes"),
    (String, "data", 1),
    (String, "data", None),
    (Byte, "data", 1),
    (Byte, "data", b""),
    (Byte, "data", b"ab"),
    (Time, "sec", 2**31),
    (Time, "nanosec", -1),
    (Duration, "nanosec", 2**32),
    (Header, "stamp", Duration()),
    (Header, "frame_id", None),
    (Point, "x", 0),
    (PointCloud2, "data", "text"),
    (PointCloud2, "data", 5),
    (PointCloud2, "data", [256]),
    (PointCloud2, "data", [0.5]),
    (PointCloud2, "data", np.zeros(3, np.uint8)),
    (PointCloud2, "data", array.array("H", [1])),
    (PointCloud2, "fields", [Header()]),
    (PointCloud2, "fields", PointField()),
    (PointCloud2, "is_dense", 1),
    (Image, "data", array.array("b", [1])),
    (Float64MultiArray, "data", [1]),
    (Float64MultiArray, "data", array.array("f", [1.0])),
    (ByteMultiArray, "data", [1]),
    (ByteMultiArray, "data", b"ab"),
    (JointState, "name", ["a", 1]),
    (JointState, "name", "abc"),
    (JointState, "position", [None]),
    (PoseWithCovariance, "covariance", [0.0] * 35),
    (PoseWithCovariance, "covariance", [0] * 36),
    (PoseWithCovariance, "covariance", np.zeros(36, np.float32)),
    (PoseWithCovariance, "covariance", np.zeros(35)),
    (DiagnosticStatus, "level", 0),
    (DiagnosticArray, "status", [None]),
    (ParameterDescriptor, "integer_range", [IntegerRange(), IntegerRange()]),
]

ACCEPTED = [
    (Bool, "data", True),
    (Float64, "data", np.float64(1.5)),
    (Float64, "data", float("inf")),
    (Float64, "data", float("nan")),
    (Float32, "data", float("-inf")),
    (Int8, "data", -128),
    (Int8, "data", True),
    (UInt64, "data", 2**64 - 1),
    (Byte, "data", bytearray(b"a")),
    (PointCloud2, "data", b"abc"),
    (PointCloud2, "data", bytearray(b"abc")),
    (PointCloud2, "data", (1, 2)),
    (PointCloud2, "data", UserList([1, 2])),
    (PointCloud2, "data", {1, 2}),
    (JointState, "name", ("a", "b")),
    (JointState, "position", array.array("d", [1.0])),
    (PoseWithCovariance, "covariance", (0.5,) * 36),
    (ParameterDescriptor, "integer_range", [IntegerRange()]),
]


def _name(value):
    return getattr(value, "__name__", None) or str(value)[:20]


@pytest.mark.parametrize(("cls", "field", "value"), REFUSED, ids=_name)
def test_assignment_is_refused(cls, field, value):
    message = cls(check_fields=True)
    before = repr(message)
    with pytest.raises(AssertionError):
        setattr(message, field, value)
    assert repr(message) == before


@pytest.mark.parametrize(("cls", "field", "value"), ACCEPTED, ids=_name)
def test_assignment_is_accepted(cls, field, value):
    message = cls(check_fields=True)
    setattr(message, field, value)
    stored = getattr(message, field)
    if isinstance(value, float):
        np.testing.assert_equal(stored, value)
    elif hasattr(value, "__len__") and not isinstance(value, bytearray):
        assert sorted(stored) == sorted(value) if field != "integer_range" else stored == value


@pytest.mark.parametrize(
    ("cls", "keywords"),
    [
        (String, {"text": "x"}),
        (Header, {"frame": "map"}),
        (PointCloud2, {"heigth": 1}),
    ],
)
def test_unknown_keyword_is_refused(cls, keywords):
    with pytest.raises(AssertionError, match=next(iter(keywords))):
        cls(check_fields=True, **keywords)


@pytest.mark.parametrize(
    ("cls", "keywords"),
    [
        (Float64, {"data": 1}),
        (UInt8, {"data": 256}),
        (Header, {"stamp": 1.0}),
        (PoseWithCovariance, {"covariance": [0.0]}),
    ],
)
def test_wrong_keyword_value_is_refused(cls, keywords):
    with pytest.raises(AssertionError):
        cls(check_fields=True, **keywords)


def test_constructor_converts_number_sequences():
    assert Float64MultiArray(check_fields=True, data=[1, 2]).data == array.array("d", [1.0, 2.0])
    with pytest.raises(OverflowError):
        PointCloud2(check_fields=True, data=[256])
    with pytest.raises(TypeError):
        PointCloud2(check_fields=True, data=None)


def test_checks_can_be_switched_off():
    message = Float64(check_fields=False)
    message.data = 1
    assert message.data == 1
