# SPDX-License-Identifier: Apache-2.0
"""Parameters of other nodes, through services."""

from __future__ import annotations

import pytest
from rcl_interfaces.msg import IntegerRange, ParameterDescriptor, ParameterType
from rcl_interfaces.srv import (
    DescribeParameters,
    GetParameters,
    GetParameterTypes,
    ListParameters,
    SetParameters,
    SetParametersAtomically,
)
from rclpy.parameter import Parameter


@pytest.fixture
def ask(make_node, executor):
    """Call a parameter service of a node with some parameters."""
    owner, asker = make_node("owner", namespace="/site"), make_node("asker")
    limits = IntegerRange(from_value=0, to_value=9)
    owner.declare_parameter("gate.size", 3, ParameterDescriptor(integer_range=[limits]))
    owner.declare_parameter("gate.names", ["a"])
    executor.add_node(owner)
    executor.add_node(asker)

    def ask(srv_type, name, **fields):
        client = asker.create_client(srv_type, f"/site/owner/{name}")
        assert client.wait_for_service(timeout_sec=20.0)
        future = client.call_async(srv_type.Request(**fields))
        executor.spin_until_future_complete(future, timeout_sec=20.0)
        return future.result()

    ask.owner = owner
    return ask


def test_get(ask):
    response = ask(GetParameters, "get_parameters", names=["gate.size", "gate.names"])
    size, names = response.values
    assert (size.type, size.integer_value) == (ParameterType.PARAMETER_INTEGER, 3)
    assert list(names.string_array_value) == ["a"]


def test_types(ask):
    response = ask(GetParameterTypes, "get_parameter_types", names=["gate.names"])
    assert list(response.types) == [ParameterType.PARAMETER_STRING_ARRAY]


def test_describe(ask):
    response = ask(DescribeParameters, "describe_parameters", names=["gate.size"])
    (descriptor,) = response.descriptors
    assert descriptor.name == "gate.size"
    assert descriptor.integer_range[0].to_value == 9


def test_list(ask):
    response = ask(ListParameters, "list_parameters", prefixes=["gate"], depth=0)
    assert sorted(response.result.names) == ["gate.names", "gate.size"]
    assert list(response.result.prefixes) == ["gate"]


def test_set(ask):
    parameters = [
        Parameter("gate.size", value=value).to_parameter_msg() for value in (5, 50, "text")
    ] + [Parameter("unknown", value=1).to_parameter_msg()]
    response = ask(SetParameters, "set_parameters", parameters=parameters)
    assert [result.successful for result in response.results] == [True, False, False, False]
    assert all(result.reason for result in response.results[1:])
    assert ask.owner.get_parameter("gate.size").value == 5


def test_set_arrays(ask):
    message = Parameter("gate.names", value=["b", "c"]).to_parameter_msg()
    assert ask(SetParameters, "set_parameters", parameters=[message]).results[0].successful
    assert list(ask.owner.get_parameter("gate.names").value) == ["b", "c"]


def test_set_atomically(ask):
    parameters = [
        Parameter("gate.size", value=6).to_parameter_msg(),
        Parameter("gate.names", value=7).to_parameter_msg(),
    ]
    response = ask(SetParametersAtomically, "set_parameters_atomically", parameters=parameters)
    assert not response.result.successful
    assert ask.owner.get_parameter("gate.size").value == 3


def test_unknown_names_give_nothing(ask):
    assert list(ask(GetParameters, "get_parameters", names=["unknown"]).values) == []
    assert list(ask(DescribeParameters, "describe_parameters", names=["no"]).descriptors) == []
    assert list(ask(GetParameterTypes, "get_parameter_types", names=["no"]).types) == []


def test_services_can_be_left_out(make_node):
    node = make_node("quiet", start_parameter_services=False)
    names = [name for name, _ in node.get_service_names_and_types_by_node("quiet", "/")]
    assert "/quiet/get_parameters" not in names
