# SPDX-License-Identifier: Apache-2.0
"""Messages as YAML and CSV, and from YAML."""

from __future__ import annotations

import pytest
import yaml
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import PoseStamped, PoseWithCovariance
from hypothesis import given
from hypothesis import strategies as st
from sensor_msgs.msg import PointCloud2
from std_msgs.msg import Float32, String, UInt8MultiArray

from ros2_embedded.cli.message_fill import fill_message
from ros2_embedded.cli.message_text import TextOptions, message_to_csv, message_to_yaml

ALL = TextOptions()


def test_yaml_keeps_the_order_of_the_definition():
    assert message_to_yaml(PoseStamped(), ALL) == (
        "header:\n  stamp:\n    sec: 0\n    nanosec: 0\n  frame_id: ''\n"
        "pose:\n  position:\n    x: 0.0\n    y: 0.0\n    z: 0.0\n"
        "  orientation:\n    x: 0.0\n    y: 0.0\n    z: 0.0\n    w: 1.0\n"
    )


def test_flow_style_is_one_line():
    message = String(data="a")
    assert message_to_yaml(message, TextOptions(flow_style=True)) == "{data: a}\n"


def test_a_float32_shows_the_value_that_it_has():
    message = Float32()
    fill_message(message, {"data": 0.5})
    assert message_to_yaml(message, ALL) == "data: 0.5\n"


def test_long_fields_are_cut():
    options = TextOptions(truncate_length=3)
    assert message_to_yaml(String(data="abcd"), options) == "data: abc...\n"
    message = UInt8MultiArray(data=[1, 2, 3, 4])
    assert "data:\n- 1\n- 2\n- 3\n- '...'\n" in message_to_yaml(message, options)
    assert message_to_csv(message, options) == "0,1,2,3,..."


def test_arrays_and_strings_can_be_left_out():
    text = message_to_yaml(PoseWithCovariance(), TextOptions(no_arr=True))
    assert "covariance: '<array type: double[36]>'" in text
    text = message_to_yaml(PointCloud2(), TextOptions(no_arr=True, no_str=True))
    assert "fields: '<sequence type: sensor_msgs/msg/PointField, length: 0>'" in text
    assert "frame_id: '<string length: <0>>'" in text
    assert message_to_csv(String(data="ab"), TextOptions(no_str=True)) == "<string length: <2>>"


def test_csv_is_flat():
    message = PoseStamped()
    fill_message(message, {"header": {"frame_id": "map"}, "pose": {"position": {"y": 2}}})
    assert message_to_csv(message, ALL) == "0,0,map,0.0,2.0,0.0,0.0,0.0,0.0,1.0"


@given(st.text(alphabet=st.characters(codec="utf-8", exclude_categories=("Cs", "Cc")), max_size=40))
def test_what_is_printed_can_be_filled_in_again(text):
    printed = message_to_yaml(String(data=text), ALL)
    again = String()
    fill_message(again, yaml.safe_load(printed))
    assert again == String(data=text)


def test_nested_sequences_of_messages_are_filled():
    values = yaml.safe_load(
        "{header: auto, status: [{name: a, values: [{key: k, value: v}]}, {name: b}]}"
    )
    message = DiagnosticArray()
    (set_stamp,) = fill_message(message, values)
    assert [status.name for status in message.status] == ["a", "b"]
    assert message.status[0].values[0].value == "v"
    stamp = message.header.stamp.__class__(sec=5)
    set_stamp(stamp)
    assert message.header.stamp.sec == 5


@pytest.mark.parametrize(
    ("values", "error"),
    [
        ({"nothing": 1}, AttributeError),
        ({"header": 3}, TypeError),
        ({"pose": {"position": {"x": "far"}}}, ValueError),
    ],
)
def test_values_that_do_not_fit_are_refused(values, error):
    with pytest.raises(error):
        fill_message(PoseStamped(), values)
