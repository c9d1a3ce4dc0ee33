# SPDX-License-Identifier: Apache-2.0
"""Message classes: construction, defaults, constants, equality, text."""

from __future__ import annotations

import array
import copy
import pickle

import numpy as np
import pytest
from builtin_interfaces.msg import Time
from diagnostic_msgs.msg import DiagnosticStatus, KeyValue
from geometry_msgs.msg import Point, Pose, Quaternion, TransformStamped
from nav_msgs.msg import Odometry
from rcl_interfaces.msg import ParameterDescriptor, ParameterType
from sensor_msgs.msg import Image, NavSatFix, NavSatStatus, PointCloud2, PointField
from std_msgs.msg import (
    Bool,
    Byte,
    ByteMultiArray,
    Char,
    Empty,
    Float32,
    Float64MultiArray,
    Header,
    String,
    UInt8,
)
from std_srvs.srv import SetBool, Trigger
from visualization_msgs.msg import Marker, MarkerArray


@pytest.mark.parametrize(
    ("message", "field", "expected"),
    [
        (Bool(), "data", False),
        (UInt8(), "data", 0),
        (Float32(), "data", 0.0),
        (String(), "data", ""),
        (Byte(), "data", b"\x00"),
        (Char(), "data", 0),
        (Header(), "stamp", Time()),
        (MarkerArray(), "markers", []),
        (Quaternion(), "w", 1.0),
        (Quaternion(), "x", 0.0),
        (DiagnosticStatus(), "level", b"\x00"),
    ],
)
def test_defaults(message, field, expected):
    value = getattr(message, field)
    assert value == expected
    assert type(value) is type(expected)


def test_keywords():
    header = Header(stamp=Time(sec=3, nanosec=5), frame_id="map")
    assert (header.stamp.sec, header.stamp.nanosec, header.frame_id) == (3, 5, "map")


def test_positional_arguments_are_refused():
    with pytest.raises(TypeError):
        String("text")


def test_unknown_attribute_is_refused():
    message = String()
    with pytest.raises(AttributeError):
        message.text = "no such field"


def test_defaults_are_not_shared():
    first, second = Pose(), Pose()
    first.position.x = 1.0
    assert second.position.x == 0.0
    first, second = MarkerArray(), MarkerArray()
    first.markers.append(Marker())
    assert second.markers == []


def test_sub_messages_are_references():
    point = Point(x=1.0)
    pose = Pose(position=point)
    point.x = 2.0
    assert pose.position.x == 2.0


def test_number_sequences_are_arrays():
    cloud = PointCloud2()
    assert isinstance(cloud.data, array.array)
    assert cloud.data.typecode == "B"
    assert Float64MultiArray().data.typecode == "d"


def test_number_sequence_from_list_and_bytes():
    assert Float64MultiArray(data=[1.0, 2.0]).data == array.array("d", [1.0, 2.0])
    cloud = PointCloud2(data=b"\x01\x02")
    assert cloud.data == array.array("B", [1, 2])
    cloud.data = b"\x03"
    assert cloud.data == array.array("B", [3])
    cloud.data = [4, 5]
    assert cloud.data == array.array("B", [4, 5])


def test_assigned_array_is_kept():
    data = array.array("B", b"abc")
    image = Image(check_fields=True)
    image.data = data
    assert image.data is data


def test_fixed_arrays_are_numpy():
    covariance = Odometry().pose.covariance
    assert isinstance(covariance, np.ndarray)
    assert covariance.dtype == np.float64
    assert covariance.shape == (36,)


def test_fixed_array_from_list():
    fix = NavSatFix(position_covariance=[1.0] * 9)
    assert isinstance(fix.position_covariance, np.ndarray)
    np.testing.assert_array_equal(fix.position_covariance, np.ones(9))
    fix.position_covariance = np.arange(9.0)
    assert fix.position_covariance[8] == 8.0


def test_byte_sequence_is_a_list_of_bytes():
    assert ByteMultiArray(data=[b"\x01", b"\xff"]).data == [b"\x01", b"\xff"]


@pytest.mark.parametrize(
    ("holder", "constant", "expected"),
    [
        (PointField, "FLOAT32", 7),
        (PointField, "UINT8", 2),
        (NavSatStatus, "STATUS_NO_FIX", -1),
        (DiagnosticStatus, "ERROR", b"\x02"),
        (ParameterType, "PARAMETER_STRING_ARRAY", 9),
        (Marker, "LINE_STRIP", 4),
    ],
)
def test_constants(holder, constant, expected):
    assert getattr(holder, constant) == expected
    assert getattr(holder(), constant) == expected


def test_constants_are_read_only():
    with pytest.raises(AttributeError):
        PointField.FLOAT32 = 1


def test_fields_and_types():
    assert PointCloud2.get_fields_and_field_types() == {
        "header": "std_msgs/Header",
        "height": "uint32",
        "width": "uint32",
        "fields": "sequence<sensor_msgs/PointField>",
        "is_bigendian": "boolean",
        "point_step": "uint32",
        "row_step": "uint32",
        "data": "sequence<uint8>",
        "is_dense": "boolean",
    }
    assert NavSatFix.get_fields_and_field_types()["position_covariance"] == "double[9]"
    assert DiagnosticStatus.get_fields_and_field_types()["level"] == "octet"
    assert Float32.get_fields_and_field_types() == {"data": "float"}
    descriptor = ParameterDescriptor.get_fields_and_field_types()
    assert descriptor["integer_range"] == "sequence<rcl_interfaces/IntegerRange, 1>"
    assert Empty.get_fields_and_field_types() == {}


def test_fields_and_types_are_a_copy():
    String.get_fields_and_field_types().clear()
    assert String.get_fields_and_field_types() == {"data": "string"}


def test_slots_name_the_fields():
    slots = [slot for slot in Header.__slots__ if slot != "_check_fields"]
    assert slots == ["_stamp", "_frame_id"]


def test_equality():
    assert String(data="a") == String(data="a")
    assert String(data="a") != String(data="b")
    assert String() != Bool()
    assert Odometry() == Odometry()
    assert PointCloud2(data=b"a") != PointCloud2(data=b"b")
    assert Empty() == Empty()


def test_messages_are_not_hashable():
    with pytest.raises(TypeError):
        hash(String())


def test_text():
    assert repr(String(data="x")) == "std_msgs.msg.String(data='x')"
    assert str(Time(sec=1)) == "builtin_interfaces.msg.Time(sec=1, nanosec=0)"
    assert repr(Float64MultiArray(data=[1.0])).endswith("data=[1.0])")
    assert repr(Float64MultiArray()).endswith("data=[])")
    assert repr(SetBool.Request()) == "std_srvs.srv.SetBool_Request(data=False)"


def test_copies_are_independent():
    message = TransformStamped(child_frame_id="radar")
    for duplicate in (copy.deepcopy(message), pickle.loads(pickle.dumps(message))):
        assert duplicate == message
        duplicate.transform.translation.x = 1.0
        assert message.transform.translation.x == 0.0


def test_service_halves():
    assert SetBool.Request(data=True).data is True
    assert Trigger.Response(success=True, message="m").message == "m"
    assert Trigger.Request.get_fields_and_field_types() == {}


def test_service_class_cannot_be_instantiated():
    with pytest.raises(NotImplementedError):
        SetBool()


def test_lists_of_messages_keep_their_elements():
    values = [KeyValue(key="a", value="1")]
    status = DiagnosticStatus(values=values)
    assert status.values[0] is values[0]
