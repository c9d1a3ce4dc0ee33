# SPDX-License-Identifier: Apache-2.0
"""Parameters: declaring and getting them."""

from __future__ import annotations

import array

import pytest
from rcl_interfaces.msg import (
    FloatingPointRange,
    IntegerRange,
    ParameterDescriptor,
    ParameterType,
    ParameterValue,
)
from rclpy.exceptions import (
    InvalidParameterException,
    InvalidParameterTypeException,
    InvalidParameterValueException,
    ParameterAlreadyDeclaredException,
    ParameterImmutableException,
    ParameterNotDeclaredException,
    ParameterUninitializedException,
)
from rclpy.parameter import Parameter, get_parameter_value, parameter_value_to_python

VALUES = [
    (True, Parameter.Type.BOOL),
    (5, Parameter.Type.INTEGER),
    (2.5, Parameter.Type.DOUBLE),
    ("text", Parameter.Type.STRING),
    ([b"\x01", b"\x02"], Parameter.Type.BYTE_ARRAY),
    ([True, False], Parameter.Type.BOOL_ARRAY),
    ([1, 2], Parameter.Type.INTEGER_ARRAY),
    ((1.0, 2.0), Parameter.Type.DOUBLE_ARRAY),
    (array.array("d", [1.0]), Parameter.Type.DOUBLE_ARRAY),
    (["a", "b"], Parameter.Type.STRING_ARRAY),
]


@pytest.mark.parametrize(("value", "kind"), VALUES)
def test_declared_value_is_got(value, kind, node):
    declared = node.declare_parameter("name", value)
    got = node.get_parameter("name")
    assert declared.value == got.value == value
    assert got.type_ is kind
    assert got.name == "name"
    assert node.has_parameter("name")
    assert node.get_parameter_type("name") == kind.value
    assert node.describe_parameter("name").type == kind.value


@pytest.mark.parametrize(("value", "kind"), VALUES)
def test_parameter_message_round_trip(value, kind):
    parameter = Parameter("name", value=value)
    assert parameter.type_ is kind
    message = parameter.to_parameter_msg()
    assert message.value.type == kind.value
    again = Parameter.from_parameter_msg(message)
    assert again.type_ is kind
    assert list(again.value) == list(value) if hasattr(value, "__len__") else again.value == value


@pytest.mark.parametrize("value", [{"a": 1}, [1, 2.0], [1, "a"], object(), 1 + 2j])
def test_other_values_are_refused(value, node):
    with pytest.raises(TypeError):
        Parameter("name", value=value)
    with pytest.raises(TypeError):
        node.declare_parameter("name", value)


def test_type_and_value_must_agree():
    with pytest.raises(ValueError, match="agree"):
        Parameter("name", Parameter.Type.DOUBLE, 1)
    with pytest.raises(TypeError):
        Parameter("name", "double", 1.0)


def test_undeclared_parameter_is_refused(node):
    assert not node.has_parameter("name")
    with pytest.raises(ParameterNotDeclaredException):
        node.get_parameter("name")
    with pytest.raises(ParameterNotDeclaredException):
        node.describe_parameter("name")
    with pytest.raises(ParameterNotDeclaredException):
        node.set_parameters([Parameter("name", value=1)])
    with pytest.raises(ParameterNotDeclaredException):
        node.undeclare_parameter("name")


def test_second_declaration_is_refused(node):
    node.declare_parameter("name", 1)
    with pytest.raises(ParameterAlreadyDeclaredException):
        node.declare_parameter("name", 1)


def test_empty_name_is_refused(node):
    with pytest.raises(InvalidParameterException):
        node.declare_parameter("", 1)


def test_declaration_without_type_is_refused(node):
    with pytest.raises(ValueError, match="NOT_SET"):
        node.declare_parameter("name", None, ParameterDescriptor())
    with pytest.raises(ValueError, match="NOT_SET"):
        node.declare_parameter("name", Parameter.Type.NOT_SET)


def test_declaration_by_type(node):
    node.declare_parameter("rate", Parameter.Type.DOUBLE)
    with pytest.raises(ParameterUninitializedException):
        node.get_parameter("rate")
    assert node.get_parameter_or("rate", Parameter("rate", value=2.0)).value == 2.0
    assert node.set_parameters([Parameter("rate", value=1.0)])[0].successful
    assert node.get_parameter("rate").value == 1.0
    assert not node.set_parameters([Parameter("rate", value=1)])[0].successful


def test_declaration_by_type_excludes_dynamic_typing(node):
    with pytest.raises(ValueError, match="dynamic_typing"):
        node.declare_parameter(
            "rate", Parameter.Type.DOUBLE, ParameterDescriptor(dynamic_typing=True)
        )


def test_dynamic_typing(node):
    node.declare_parameter("name", None, ParameterDescriptor(dynamic_typing=True))
    assert node.get_parameter("name").type_ is Parameter.Type.NOT_SET
    for value in (1, "text", [1.0]):
        assert node.set_parameters([Parameter("name", value=value)])[0].successful
        assert node.get_parameter("name").value == value


def test_declare_several(node):
    declared = node.declare_parameters(
        "gate", [("size", 3.0), ("name", "oval", ParameterDescriptor(description="Shape"))]
    )
    assert [parameter.name for parameter in declared] == ["gate.size", "gate.name"]
    assert node.describe_parameter("gate.name").description == "Shape"
    by_prefix = node.get_parameters_by_prefix("gate")
    assert {name: parameter.value for name, parameter in by_prefix.items()} == {
        "size": 3.0,
        "name": "oval",
    }
    got = node.get_parameters(["gate.size", "gate.name"])
    assert [parameter.value for parameter in got] == [3.0, "oval"]


@pytest.mark.parametrize(
    "declaration", [(), ("a", 1, ParameterDescriptor(), 2), (5, 1), ("a", 1, "description")]
)
def test_wrong_declarations_are_refused(declaration, node):
    with pytest.raises(TypeError):
        node.declare_parameters("", [declaration])


def test_undeclare(node):
    node.declare_parameter("name", 1)
    node.undeclare_parameter("name")
    assert not node.has_parameter("name")
    node.declare_parameter("name", "now a text")


def test_read_only_is_not_undeclared(node):
    node.declare_parameter("name", 1, ParameterDescriptor(read_only=True))
    with pytest.raises(ParameterImmutableException):
        node.undeclare_parameter("name")


def test_overrides_win_over_defaults(make_node):
    node = make_node(parameter_overrides=[Parameter("name", value=7)])
    assert not node.has_parameter("name")
    assert node.declare_parameter("name", 1).value == 7
    assert node.declare_parameter("other", 1).value == 1


def test_overrides_can_be_ignored(make_node):
    node = make_node(parameter_overrides=[Parameter("name", value=7)])
    assert node.declare_parameter("name", 1, ignore_override=True).value == 1


def test_override_of_another_type_is_refused(make_node):
    node = make_node(parameter_overrides=[Parameter("rate", value=7)])
    with pytest.raises(InvalidParameterTypeException):
        node.declare_parameter("rate", 1.0)
    assert not node.has_parameter("rate")


def test_override_out_of_range_is_refused(make_node):
    node = make_node(parameter_overrides=[Parameter("rate", value=7.0)])
    limits = FloatingPointRange(from_value=0.0, to_value=5.0)
    with pytest.raises(InvalidParameterValueException):
        node.declare_parameter("rate", 1.0, ParameterDescriptor(floating_point_range=[limits]))


def test_default_out_of_range_is_refused(node):
    limits = IntegerRange(from_value=0, to_value=5)
    with pytest.raises(InvalidParameterValueException):
        node.declare_parameter("depth", 6, ParameterDescriptor(integer_range=[limits]))


def test_overrides_declared_automatically(make_node):
    node = make_node(
        parameter_overrides=[Parameter("a", value=1), Parameter("b.c", value="x")],
        automatically_declare_parameters_from_overrides=True,
    )
    assert node.get_parameter("a").value == 1
    assert node.get_parameter("b.c").value == "x"
    with pytest.raises(ParameterAlreadyDeclaredException):
        node.declare_parameter("a", 2)


def test_undeclared_allowed(make_node):
    node = make_node(allow_undeclared_parameters=True)
    assert node.get_parameter("name").type_ is Parameter.Type.NOT_SET
    assert node.describe_parameter("name") == ParameterDescriptor()
    assert node.set_parameters([Parameter("name", value=1)])[0].successful
    assert node.get_parameter("name").value == 1
    assert node.set_parameters([Parameter("name", value="text")])[0].successful


def test_get_parameter_or(node):
    node.declare_parameter("here", 1)
    other = Parameter("there", value=2)
    assert node.get_parameter_or("here", other).value == 1
    assert node.get_parameter_or("there", other) is other
    assert node.get_parameter_or("there").type_ is Parameter.Type.NOT_SET


def test_names_must_be_text(node):
    with pytest.raises(TypeError):
        node.get_parameters([1])
    with pytest.raises(TypeError):
        node.get_parameter_types([None])


def test_every_node_has_use_sim_time(node):
    assert node.get_parameter("use_sim_time").value is False


@pytest.mark.parametrize(
    ("text", "kind", "value"),
    [
        ("true", ParameterType.PARAMETER_BOOL, True),
        ("5", ParameterType.PARAMETER_INTEGER, 5),
        ("5.0", ParameterType.PARAMETER_DOUBLE, 5.0),
        ("five", ParameterType.PARAMETER_STRING, "five"),
        ("'5'", ParameterType.PARAMETER_STRING, "5"),
        ("[1, 2]", ParameterType.PARAMETER_INTEGER_ARRAY, [1, 2]),
        ("[1.5]", ParameterType.PARAMETER_DOUBLE_ARRAY, [1.5]),
        ("[true]", ParameterType.PARAMETER_BOOL_ARRAY, [True]),
        ("[a, b]", ParameterType.PARAMETER_STRING_ARRAY, ["a", "b"]),
        ("[1, a]", ParameterType.PARAMETER_STRING, "[1, a]"),
    ],
)
def test_value_of_text(text, kind, value):
    message = get_parameter_value(text)
    assert message.type == kind
    assert parameter_value_to_python(message) == value


def test_value_that_is_not_set():
    assert parameter_value_to_python(ParameterValue()) is None
    with pytest.raises(RuntimeError):
        parameter_value_to_python(ParameterValue(type=42))
