# SPDX-License-Identifier: Apache-2.0
"""Nodes."""

from __future__ import annotations

import weakref
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from rcl_interfaces.msg import ParameterDescriptor, ParameterEvent
from rclpy._arguments import RosArguments, parse_arguments, remap_node
from rclpy._node_entities import NodeEntities
from rclpy._rclpy_pybind11 import NodeNameNonExistentError as NodeNameNonExistentError
from rclpy.callback_groups import (
    MutuallyExclusiveCallbackGroup,
    ReentrantCallbackGroup,
)
from rclpy.client import Client
from rclpy.clock import ROSClock
from rclpy.context import Context
from rclpy.exceptions import NotInitializedException
from rclpy.guard_condition import GuardCondition
from rclpy.impl.rcutils_logger import RcutilsLogger
from rclpy.impl.rosout import Rosout
from rclpy.logging import get_logger
from rclpy.logging_service import LoggingService
from rclpy.parameter import Parameter
from rclpy.parameter_service import ParameterService
from rclpy.publisher import Publisher
from rclpy.qos import qos_profile_parameter_events
from rclpy.service import Service
from rclpy.subscription import Subscription
from rclpy.time_source import TimeSource
from rclpy.timer import Timer
from rclpy.utilities import get_default_context
from rclpy.validate_namespace import validate_namespace
from rclpy.validate_node_name import validate_node_name

if TYPE_CHECKING:
    from rclpy.executors import Executor

HIDDEN_NODE_PREFIX = "_"


class Node(NodeEntities):
    """A node of the ROS graph; base of the nodes that programs write."""

    def __init__(
        self,
        node_name: str,
        *,
        context: Context | None = None,
        cli_args: list[str] | None = None,
        namespace: str | None = None,
        use_global_arguments: bool = True,
        enable_rosout: bool = True,
        start_parameter_services: bool = True,
        parameter_overrides: list[Parameter[Any]] | None = None,
        allow_undeclared_parameters: bool = False,
        automatically_declare_parameters_from_overrides: bool = False,
        enable_logger_service: bool = False,
    ) -> None:
        """Create a node.

        Args:
            node_name: Name of the node.
            context: Context it belongs to; None for the default one.
            cli_args: Command line with ROS arguments for this node only.
            namespace: Namespace of the node.
            use_global_arguments: Whether the command line of the program counts.
            enable_rosout: Whether to publish the log on ``/rosout``.
            start_parameter_services: Whether to let others get and set parameters.
            parameter_overrides: Values for parameters, stronger than the command line.
            allow_undeclared_parameters: Whether parameters need not be declared.
            automatically_declare_parameters_from_overrides: Whether to declare all
                parameters that have values from outside.
            enable_logger_service: Whether to let others get and set logger levels.

        Raises:
            NotInitializedException: The context is not initialised.
            InvalidNodeNameException: The name is not allowed.
            InvalidNamespaceException: The namespace is not allowed.
            RuntimeError: A ROS argument is wrong.
        """
        self._context = context or get_default_context()
        if not self._context.ok():
            raise NotInitializedException("cannot create node")
        arguments = parse_arguments(["--ros-args", *(cli_args or [])])
        globals_ = self._context.arguments if use_global_arguments else RosArguments()
        self._remappings = [*arguments.remappings, *globals_.remappings]
        validate_node_name(node_name)
        space = namespace or "/"
        space = space if space.startswith("/") else f"/{space}"
        validate_namespace(space)
        super().__init__(*remap_node(self._remappings, node_name, space))
        full_name = self.get_fully_qualified_name()
        values = globals_.parameters_of(full_name) | arguments.parameters_of(full_name)
        self._parameter_overrides = {n: Parameter(n, value=v) for n, v in values.items()}
        self._parameter_overrides |= {p.name: p for p in parameter_overrides or ()}
        self._allow_undeclared_parameters = allow_undeclared_parameters
        self._default_callback_group = MutuallyExclusiveCallbackGroup()
        self._rate_group = ReentrantCallbackGroup()
        self._executor_reference: weakref.ref[Executor] | None = None
        self._graph = self._context.graph
        self._logger = get_logger(full_name.removeprefix("/").replace("/", "."))
        self._ros_clock = ROSClock()
        self._clock = self._ros_clock
        self._rosout: Rosout | None = None
        with self._graph.batch():
            self._graph.add_node(self._full_name_pair)
            if enable_rosout and globals_.switches.get("rosout", True):
                self._start_rosout()
            self._parameter_event_publisher = self.create_publisher(
                ParameterEvent, "/parameter_events", qos_profile_parameter_events
            )
            if automatically_declare_parameters_from_overrides:
                self.declare_parameters(
                    "",
                    [
                        (name, parameter.value, ParameterDescriptor())
                        for name, parameter in self._parameter_overrides.items()
                    ],
                    ignore_override=True,
                )
            self._time_source = TimeSource(node=self)
            self._time_source.attach_clock(self._clock)
            if start_parameter_services:
                self._parameter_service = ParameterService(self)
            if enable_logger_service:
                self._logger_service = LoggingService(self)
            self._declare_type_description_parameter()

    @property
    def publishers(self) -> Iterator[Publisher[Any]]:
        """The publishers."""
        yield from self._publishers

    @property
    def subscriptions(self) -> Iterator[Subscription[Any]]:
        """The subscriptions."""
        yield from self._subscriptions

    @property
    def clients(self) -> Iterator[Client]:
        """The clients."""
        yield from self._clients

    @property
    def services(self) -> Iterator[Service]:
        """The servers."""
        yield from self._services

    @property
    def timers(self) -> Iterator[Timer]:
        """The timers."""
        yield from self._timers

    @property
    def guards(self) -> Iterator[GuardCondition]:
        """The guard conditions."""
        yield from self._guards

    @property
    def executor(self) -> Executor | None:
        """The executor that the node was added to."""
        return self._executor_reference() if self._executor_reference else None

    @executor.setter
    def executor(self, new_executor: Executor | None) -> None:
        current = self.executor
        if current is new_executor:
            return
        if current is not None:
            current.remove_node(self)
        self._executor_reference = None
        if new_executor is not None:
            self._executor_reference = weakref.ref(new_executor)
            new_executor.add_node(self)

    @property
    def handle(self) -> Node:
        """The node itself."""
        return self

    def get_clock(self) -> ROSClock:
        """Get the clock, which follows simulated time if ``use_sim_time`` is set.

        Returns:
            The clock.
        """
        return self._ros_clock

    def get_logger(self) -> RcutilsLogger:
        """Get the logger of the node.

        Returns:
            The logger.
        """
        return self._logger

    def add_waitable(self, waitable: object) -> None:
        """Wait for something of a program's own; not offered.

        Args:
            waitable: As in ROS 2.

        Raises:
            NotImplementedError: Always.
        """
        raise NotImplementedError("waitables are not offered by ros2_embedded")

    def destroy_node(self) -> None:
        """Destroy the node and all its entities; a second time does nothing."""
        self._parameter_event_publisher = None
        everything: tuple[list[Any], ...] = (
            self._publishers,
            self._subscriptions,
            self._clients,
            self._services,
            self._timers,
            self._guards,
        )
        for entities in everything:
            for entity in tuple(entities):
                entity.destroy()
            entities.clear()
        if self._rosout is not None:
            self._rosout.close()
            self._rosout = None
        if self._context.ok():
            self._graph.remove_node(self._full_name_pair)
        if (executor := self.executor) is not None:
            executor.remove_node(self)
        self._wake_executor()

    def _wake_executor(self) -> None:
        if (executor := self.executor) is not None:
            executor.wake()

    def _start_rosout(self) -> None:
        topic = self._resolve("/rosout", "topic", False)
        self._rosout = Rosout(self._context.participant, topic, self._logger.name)
        self._graph.add_endpoints(self._full_name_pair, self._rosout.writer)

    def _declare_type_description_parameter(self) -> None:
        # Every node of ROS 2 has this parameter; the service itself is not offered here.
        name = "start_type_description_service"
        if not self.has_parameter(name):
            descriptor = ParameterDescriptor(
                description="If enabled, start the ~/get_type_description service.",
                read_only=True,
            )
            self.declare_parameter(name, True, descriptor)
