# SPDX-License-Identifier: Apache-2.0
"""Initialisation and shutdown."""

from __future__ import annotations

import contextlib

import pytest
import rclpy
from rclpy.context import Context
from rclpy.exceptions import NotInitializedException
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node


@pytest.fixture
def default_context(domain_id):
    """Initialise the default context."""
    rclpy.init(args=[], domain_id=domain_id)
    yield rclpy.get_default_context()
    rclpy.try_shutdown()


def test_ok_between_init_and_shutdown(domain_id):
    assert not rclpy.ok()
    rclpy.init(args=[], domain_id=domain_id)
    assert rclpy.ok()
    rclpy.shutdown()
    assert not rclpy.ok()


def test_init_again_after_shutdown(domain_id):
    for _ in range(3):
        rclpy.init(args=[], domain_id=domain_id)
        node = rclpy.create_node("again")
        rclpy.spin_once(node, timeout_sec=0.0)
        node.destroy_node()
        rclpy.shutdown()


def test_second_init_is_refused(default_context):
    with pytest.raises(RuntimeError):
        rclpy.init(args=[])


def test_shutdown_without_init_is_refused():
    with pytest.raises(RuntimeError):
        rclpy.shutdown()


def test_second_shutdown_of_a_context_is_refused(context):
    rclpy.shutdown(context=context)
    with pytest.raises(RuntimeError):
        rclpy.shutdown(context=context)


def test_try_shutdown_may_be_repeated(context):
    rclpy.try_shutdown(context=context)
    rclpy.try_shutdown(context=context)
    assert not context.ok()


def test_try_shutdown_without_init():
    rclpy.try_shutdown()
    assert not rclpy.ok()


def test_context_is_not_used_twice(context, domain_id):
    context.shutdown()
    with pytest.raises(RuntimeError):
        context.init(args=[], domain_id=domain_id)


def test_negative_domain_is_refused():
    with pytest.raises(RuntimeError):
        rclpy.init(args=[], context=Context(), domain_id=-1)


def test_domain_of_context(context, domain_id):
    assert context.get_domain_id() == domain_id


def test_domain_from_environment(monkeypatch, domain_id):
    monkeypatch.setenv("ROS_DOMAIN_ID", str(domain_id))
    context = Context()
    rclpy.init(args=[], context=context)
    assert context.get_domain_id() == domain_id
    context.shutdown()


def test_domain_before_init_is_refused():
    with pytest.raises(RuntimeError):
        Context().get_domain_id()


def test_node_without_init_is_refused():
    with pytest.raises(NotInitializedException):
        Node("lonely")


def test_node_after_shutdown_is_refused(context):
    context.shutdown()
    with pytest.raises(NotInitializedException):
        Node("late", context=context)


def test_contexts_are_independent(context, domain_id):
    other = Context()
    rclpy.init(args=[], context=other, domain_id=domain_id)
    other.shutdown()
    assert context.ok()
    assert not other.ok()


def test_on_shutdown_is_called_once(context):
    calls = []
    context.on_shutdown(lambda: calls.append("down"))
    context.shutdown()
    assert calls == ["down"]


def test_on_shutdown_after_shutdown_is_called_at_once(context):
    context.shutdown()
    calls = []
    context.on_shutdown(lambda: calls.append("down"))
    assert calls == ["down"]


def test_on_shutdown_needs_a_callable(context):
    with pytest.raises(TypeError):
        context.on_shutdown("nothing")


def test_context_in_with(domain_id, monkeypatch):
    monkeypatch.setattr("sys.argv", ["program"])
    monkeypatch.setenv("ROS_DOMAIN_ID", str(domain_id))
    with Context() as context:
        assert context.ok()
    assert not context.ok()


def test_create_node_of_default_context(default_context):
    node = rclpy.create_node("named", namespace="/space")
    assert node.context is default_context
    assert (node.get_name(), node.get_namespace()) == ("named", "/space")
    node.destroy_node()


def test_spin_ends_at_shutdown(default_context):
    node = rclpy.create_node("stopper")
    node.create_timer(0.01, rclpy.shutdown)
    with contextlib.suppress(ExternalShutdownException):
        rclpy.spin(node)
    assert not default_context.ok()
    node.destroy_node()


def test_destroying_after_shutdown_is_harmless(context):
    node = Node("late", context=context)
    node.create_timer(1.0, lambda: None)
    context.shutdown()
    node.destroy_node()


def test_executor_of_a_context_spins_its_nodes(context, domain_id, spin_until):
    node = Node("own", context=context)
    executor = SingleThreadedExecutor(context=context)
    calls = []
    node.create_timer(0.001, lambda: calls.append(1))
    executor.add_node(node)
    spin_until(executor, lambda: calls)
    executor.shutdown()
    node.destroy_node()
