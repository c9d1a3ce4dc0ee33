# SPDX-License-Identifier: Apache-2.0
"""Parameters: setting them, callbacks, events, listing."""

from __future__ import annotations

import pytest
from rcl_interfaces.msg import (
    FloatingPointRange,
    IntegerRange,
    ParameterDescriptor,
    ParameterEvent,
    ParameterValue,
    SetParametersResult,
)
from rclpy.exceptions import (
    InvalidParameterValueException,
    ParameterImmutableException,
    ParameterNotDeclaredException,
)
from rclpy.parameter import Parameter
from rclpy.qos import qos_profile_parameter_events


def set_one(node, name, value):
    (result,) = node.set_parameters([Parameter(name, value=value)])
    return result


def test_set_changes_the_value(node):
    node.declare_parameter("name", 1)
    assert set_one(node, "name", 2).successful
    assert node.get_parameter("name").value == 2


@pytest.mark.parametrize("value", [1.0, "1", True, [1]])
def test_other_type_is_refused(value, node):
    node.declare_parameter("name", 1)
    result = set_one(node, "name", value)
    assert not result.successful
    assert result.reason
    assert node.get_parameter("name").value == 1


def test_integer_is_no_double(node):
    node.declare_parameter("rate", 1.0)
    assert not set_one(node, "rate", 1).successful


def test_read_only_is_refused(node):
    node.declare_parameter("name", 1, ParameterDescriptor(read_only=True))
    result = set_one(node, "name", 2)
    assert not result.successful
    assert "read-only" in result.reason


def test_static_parameter_is_not_unset(node):
    node.declare_parameter("name", 1)
    result = node.set_parameters([Parameter("name", Parameter.Type.NOT_SET)])[0]
    assert not result.successful


def test_unsetting_a_dynamic_parameter_undeclares_it(node):
    node.declare_parameter("name", 1, ParameterDescriptor(dynamic_typing=True))
    assert node.set_parameters([Parameter("name", Parameter.Type.NOT_SET)])[0].successful
    assert not node.has_parameter("name")


@pytest.mark.parametrize(
    ("value", "accepted"), [(-10, True), (10, True), (0, True), (-8, True), (1, False), (11, False)]
)
def test_integer_range(value, accepted, node):
    limits = IntegerRange(from_value=-10, to_value=10, step=2)
    node.declare_parameter("depth", 0, ParameterDescriptor(integer_range=[limits]))
    assert set_one(node, "depth", value).successful is accepted


@pytest.mark.parametrize("value", [5, 7])
def test_end_of_range_needs_no_step(value, node):
    limits = IntegerRange(from_value=0, to_value=7, step=5)
    node.declare_parameter("depth", 0, ParameterDescriptor(integer_range=[limits]))
    assert set_one(node, "depth", value).successful


@pytest.mark.parametrize(
    ("value", "accepted"),
    [(0.0, True), (1.0, True), (0.5, True), (1.0 + 1e-9, True), (0.3, False), (1.1, False)],
)
def test_floating_point_range(value, accepted, node):
    limits = FloatingPointRange(from_value=0.0, to_value=1.0, step=0.25)
    node.declare_parameter("rate", 0.0, ParameterDescriptor(floating_point_range=[limits]))
    assert set_one(node, "rate", value).successful is accepted


def test_parameters_before_a_refused_one_stay_set(node):
    node.declare_parameters("", [("a", 1), ("b", 1)])
    results = node.set_parameters(
        [Parameter("a", value=2), Parameter("b", value="no"), Parameter("a", value=3)]
    )
    assert [result.successful for result in results] == [True, False, True]
    assert node.get_parameter("a").value == 3


def test_atomic_setting_sets_all_or_none(node):
    node.declare_parameters("", [("a", 1), ("b", 1)])
    refused = node.set_parameters_atomically([Parameter("a", value=2), Parameter("b", value=0.5)])
    assert not refused.successful
    assert node.get_parameter("a").value == 1
    both = node.set_parameters_atomically([Parameter("a", value=2), Parameter("b", value=3)])
    assert both.successful
    assert [p.value for p in node.get_parameters(["a", "b"])] == [2, 3]


def test_only_parameters_can_be_set(node):
    with pytest.raises(TypeError):
        node.set_parameters(["name"])


def test_on_set_callback_decides(node):
    node.declare_parameter("name", 1)
    seen = []

    def decide(parameters):
        seen.append([(parameter.name, parameter.value) for parameter in parameters])
        ok = all(parameter.value < 5 for parameter in parameters)
        return SetParametersResult(successful=ok, reason="" if ok else "five is too many")

    node.add_on_set_parameters_callback(decide)
    assert set_one(node, "name", 4).successful
    result = set_one(node, "name", 5)
    assert (result.successful, result.reason) == (False, "five is too many")
    assert node.get_parameter("name").value == 4
    assert seen == [[("name", 4)], [("name", 5)]]
    with pytest.raises(InvalidParameterValueException, match="five is too many"):
        node.declare_parameter("other", 6)
    node.remove_on_set_parameters_callback(decide)
    assert set_one(node, "name", 5).successful
    with pytest.raises(ValueError, match="not in list"):
        node.remove_on_set_parameters_callback(decide)


def test_last_added_callback_is_asked_first(node):
    node.declare_parameter("name", 1)
    order = []

    def make(number):
        def note(parameters):
            order.append(number)
            return SetParametersResult(successful=True)

        return note

    for number in (1, 2):
        node.add_on_set_parameters_callback(make(number))
    set_one(node, "name", 2)
    assert order == [2, 1]


def test_pre_set_callback_changes_what_is_set(node):
    node.declare_parameters("", [("a", 1), ("b", 1)])

    def also_b(parameters):
        return [*parameters, Parameter("b", value=parameters[0].value * 10)]

    node.add_pre_set_parameters_callback(also_b)
    assert set_one(node, "a", 2).successful
    assert node.get_parameter("b").value == 20
    node.remove_pre_set_parameters_callback(also_b)
    node.add_pre_set_parameters_callback(lambda parameters: [])
    assert not set_one(node, "a", 3).successful


def test_post_set_callback_sees_the_new_value(node):
    node.declare_parameter("name", 1)
    seen = []

    def note(parameters):
        seen.append((parameters[0].name, node.get_parameter("name").value))

    node.add_post_set_parameters_callback(note)
    set_one(node, "name", 2)
    set_one(node, "name", "refused")
    assert seen == [("name", 2)]
    node.remove_post_set_parameters_callback(note)
    set_one(node, "name", 3)
    assert len(seen) == 1


def test_descriptor_can_be_changed(node):
    node.declare_parameter("depth", 8)
    limits = ParameterDescriptor(
        type=2, integer_range=[IntegerRange(from_value=0, to_value=5)], description="Depth"
    )
    with pytest.raises(InvalidParameterValueException):
        node.set_descriptor("depth", limits)
    value = node.set_descriptor("depth", limits, ParameterValue(type=2, integer_value=3))
    assert value.integer_value == 3
    assert node.get_parameter("depth").value == 3
    assert node.describe_parameter("depth").description == "Depth"
    with pytest.raises(ParameterNotDeclaredException):
        node.set_descriptor("unknown", limits)


def test_descriptor_of_read_only_is_kept(node):
    node.declare_parameter("name", 1, ParameterDescriptor(read_only=True))
    with pytest.raises(ParameterImmutableException):
        node.set_descriptor("name", ParameterDescriptor())


def test_listing(node):
    node.declare_parameters("", [("a", 1), ("b.c", 1), ("b.d.e", 1)])
    everything = node.list_parameters([], 0)
    assert {"a", "b.c", "b.d.e", "use_sim_time"} <= set(everything.names)
    assert set(everything.prefixes) == {"b", "b.d"}
    assert node.list_parameters(["b"], 0).names == ["b.c", "b.d.e"]
    assert node.list_parameters(["b"], 1).names == ["b.c"]
    assert "b.c" not in node.list_parameters([], 1).names
    with pytest.raises(TypeError):
        node.list_parameters("b", 0)
    with pytest.raises(ValueError, match="depth"):
        node.list_parameters([], -1)


def test_changes_are_published(make_node, executor, spin_until):
    watcher, node = make_node("watcher"), make_node("watched", namespace="/site")
    events = []
    watcher.create_subscription(
        ParameterEvent,
        "/parameter_events",
        lambda event: events.append(event) if event.node == "/site/watched" else None,
        qos_profile_parameter_events,
    )
    executor.add_node(watcher)
    spin_until(executor, lambda: watcher.count_publishers("/parameter_events") == 2)
    node.declare_parameter("probe", 0, ParameterDescriptor(dynamic_typing=True))

    def probe_arrived():
        set_one(node, "probe", 1)
        return events

    spin_until(executor, probe_arrived)
    events.clear()
    node.declare_parameter("name", 1, ParameterDescriptor(dynamic_typing=True))
    set_one(node, "name", 2)
    node.set_parameters([Parameter("name", Parameter.Type.NOT_SET)])

    def names(kind):
        return [p.name for event in events for p in getattr(event, kind) if p.name == "name"]

    spin_until(executor, lambda: names("deleted_parameters"))
    assert names("new_parameters") == ["name"]
    assert names("changed_parameters") == ["name"]
    assert all(event.stamp.sec > 0 for event in events)
