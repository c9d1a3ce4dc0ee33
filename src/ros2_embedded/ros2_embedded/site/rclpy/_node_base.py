# SPDX-License-Identifier: Apache-2.0
"""What all parts of a node share: its names, entities and destruction."""

from __future__ import annotations

from typing import Any

from rclpy._arguments import Remapping, remap_name
from rclpy._names import expand_name
from rclpy._node_graph import NodeGraph
from rclpy._node_parameter_setting import NodeParameterSetting
from rclpy._rclpy_pybind11 import RCLError
from rclpy.callback_groups import CallbackGroup
from rclpy.client import Client
from rclpy.context import Context
from rclpy.guard_condition import GuardCondition
from rclpy.publisher import Publisher
from rclpy.service import Service
from rclpy.subscription import Subscription
from rclpy.timer import Rate, Timer
from rclpy.validate_full_topic_name import validate_full_topic_name
from rclpy.validate_topic_name import validate_topic_name

from ros2_embedded.dds.endpoints import Reader, Writer


class NodeBase(NodeGraph, NodeParameterSetting):
    """Names and lists of entities of a node."""

    _context: Context
    _remappings: list[Remapping]
    _default_callback_group: CallbackGroup
    _rate_group: CallbackGroup

    def __init__(self, name: str, namespace: str) -> None:
        """Start without entities.

        Args:
            name: Name of the node.
            namespace: Its namespace.
        """
        super().__init__()
        self._name = name
        self._namespace = namespace
        self._publishers: list[Publisher[Any]] = []
        self._subscriptions: list[Subscription[Any]] = []
        self._clients: list[Client] = []
        self._services: list[Service] = []
        self._timers: list[Timer] = []
        self._guards: list[GuardCondition] = []

    @property
    def context(self) -> Context:
        """The context."""
        return self._context

    @property
    def default_callback_group(self) -> CallbackGroup:
        """Group of the entities that are given none."""
        return self._default_callback_group

    @property
    def _full_name_pair(self) -> tuple[str, str]:
        return self._namespace, self._name

    def get_name(self) -> str:
        """Get the name of the node.

        Returns:
            Its name without namespace.
        """
        return self._name

    def get_namespace(self) -> str:
        """Get the namespace of the node.

        Returns:
            Such as ``/`` or ``/site``.
        """
        return self._namespace

    def get_fully_qualified_name(self) -> str:
        """Get namespace and name.

        Returns:
            Such as ``/namespace/name``.
        """
        return f"{self._namespace.rstrip('/')}/{self._name}"

    def resolve_topic_name(self, topic: str, *, only_expand: bool = False) -> str:
        """Get the full name of a topic.

        Args:
            topic: Its name.
            only_expand: Whether it is not remapped.

        Returns:
            The full name.

        Raises:
            RCLError: The name is not allowed.
        """
        return self._resolve(topic, "topic", only_expand)

    def resolve_service_name(self, service: str, *, only_expand: bool = False) -> str:
        """Get the full name of a service.

        Args:
            service: Its name.
            only_expand: Whether it is not remapped.

        Returns:
            The full name.

        Raises:
            RCLError: The name is not allowed.
        """
        return self._resolve(service, "service", only_expand)

    def destroy_publisher(self, publisher: Publisher[Any]) -> bool:
        """Destroy a publisher.

        Args:
            publisher: The publisher.

        Returns:
            False if it is none of this node.
        """
        return self._destroy(self._publishers, publisher, publisher._writer)

    def destroy_subscription(self, subscription: Subscription[Any]) -> bool:
        """Destroy a subscription.

        Args:
            subscription: The subscription.

        Returns:
            False if it is none of this node.
        """
        return self._destroy(self._subscriptions, subscription, subscription._reader)

    def destroy_client(self, client: Client) -> bool:
        """Destroy a client.

        Args:
            client: The client.

        Returns:
            False if it is none of this node.
        """
        return self._destroy(self._clients, client, client._reader, client._writer)

    def destroy_service(self, service: Service) -> bool:
        """Destroy a server.

        Args:
            service: The server.

        Returns:
            False if it is none of this node.
        """
        return self._destroy(self._services, service, service._reader, service._writer)

    def destroy_timer(self, timer: Timer) -> bool:
        """Destroy a timer.

        Args:
            timer: The timer.

        Returns:
            False if it is none of this node.
        """
        return self._destroy(self._timers, timer)

    def destroy_guard_condition(self, guard: GuardCondition) -> bool:
        """Destroy a guard condition.

        Args:
            guard: The guard condition.

        Returns:
            False if it is none of this node.
        """
        return self._destroy(self._guards, guard)

    def destroy_rate(self, rate: Rate) -> bool:
        """Destroy a rate.

        Args:
            rate: The rate.

        Returns:
            False if it is none of this node.
        """
        success = self.destroy_timer(rate._timer)
        rate.destroy()
        return success

    def _wake_executor(self) -> None:
        raise NotImplementedError

    def _destroy(self, entities: list[Any], entity: Any, *endpoints: Reader | Writer) -> bool:
        if entity not in entities:
            return False
        entities.remove(entity)
        if self._context.ok():
            self._graph.remove_endpoints(self._full_name_pair, *endpoints)
        entity.destroy()
        self._wake_executor()
        return True

    def _resolve(self, name: str, kind: str, only_expand: bool) -> str:
        try:
            full_name = expand_name(name, self._name, self._namespace)
        except ValueError as error:
            raise RCLError(f"failed to resolve name: {error}") from error
        if only_expand:
            return full_name
        return remap_name(self._remappings, full_name, self._name, self._namespace, kind)

    def _resolve_checked(self, name: str, *, is_service: bool = False) -> str:
        validate_topic_name(name, is_service=is_service)
        full_name = self._resolve(name, "service" if is_service else "topic", False)
        validate_full_topic_name(full_name, is_service=is_service)
        return full_name
