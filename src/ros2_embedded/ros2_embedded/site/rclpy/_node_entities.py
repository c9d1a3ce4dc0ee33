# SPDX-License-Identifier: Apache-2.0
"""Creating and destroying what a node consists of."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any, TypeVar

from rclpy._best_available import resolve_best_available
from rclpy._entity import Entity
from rclpy._node_services import NodeServices
from rclpy.callback_groups import CallbackGroup
from rclpy.clock import Clock
from rclpy.constants import S_TO_NS
from rclpy.event_handler import PublisherEventCallbacks, SubscriptionEventCallbacks
from rclpy.guard_condition import GuardCondition
from rclpy.publisher import Publisher
from rclpy.qos import QoSProfile
from rclpy.qos_overriding_options import QoSOverridingOptions, override_qos
from rclpy.subscription import Subscription
from rclpy.timer import Rate, Timer
from rclpy.type_support import check_is_valid_msg_type

from ros2_embedded.dds.endpoints import Reader, Writer

MsgType = TypeVar("MsgType")


class NodeEntities(NodeServices):
    """The part of a node that creates and destroys its entities."""

    def create_publisher(
        self,
        msg_type: type[MsgType],
        topic: str,
        qos_profile: QoSProfile | int,
        *,
        callback_group: CallbackGroup | None = None,
        event_callbacks: PublisherEventCallbacks | None = None,
        qos_overriding_options: QoSOverridingOptions | None = None,
        publisher_class: type[Publisher[MsgType]] = Publisher,
    ) -> Publisher[MsgType]:
        """Create a publisher.

        Args:
            msg_type: Class of the messages.
            topic: Name of the topic.
            qos_profile: Quality of service, or the depth of its history.
            callback_group: Group of the event callbacks; None for that of the node.
            event_callbacks: Callbacks for events of the middleware.
            qos_overriding_options: Policies that parameters can change.
            publisher_class: Class of the publisher.

        Returns:
            The publisher.

        Raises:
            InvalidTopicNameException: The name is not allowed.
            TypeError: The quality of service is none.
            ValueError: The depth is negative.
        """
        name, profile = self._endpoint_settings(
            "publisher", msg_type, topic, qos_profile, qos_overriding_options
        )
        profile = resolve_best_available(self._graph.readers, f"rt{name}", profile)
        writer = self._make(Writer, f"rt{name}", msg_type, profile)
        publisher = publisher_class(
            writer,
            msg_type,
            name,
            profile,
            event_callbacks or PublisherEventCallbacks(),
            callback_group or self.default_callback_group,
        )
        self._graph.add_endpoints(self._full_name_pair, writer)
        return self._added(self._publishers, publisher)

    def create_subscription(
        self,
        msg_type: type[MsgType],
        topic: str,
        callback: Callable[..., Any],
        qos_profile: QoSProfile | int,
        *,
        callback_group: CallbackGroup | None = None,
        event_callbacks: SubscriptionEventCallbacks | None = None,
        qos_overriding_options: QoSOverridingOptions | None = None,
        raw: bool = False,
    ) -> Subscription[MsgType]:
        """Create a subscription.

        Args:
            msg_type: Class of the messages.
            topic: Name of the topic.
            callback: Takes a message, or a message and a dictionary of what is known of it.
            qos_profile: Quality of service, or the depth of its history.
            callback_group: Group of the callbacks; None for that of the node.
            event_callbacks: Callbacks for events of the middleware.
            qos_overriding_options: Policies that parameters can change.
            raw: Give the CDR of messages to the callback, not messages.

        Returns:
            The subscription.

        Raises:
            InvalidTopicNameException: The name is not allowed.
            TypeError: The quality of service is none.
            ValueError: The depth is negative.
            RuntimeError: The callback takes neither one argument nor two.
        """
        name, profile = self._endpoint_settings(
            "subscription", msg_type, topic, qos_profile, qos_overriding_options
        )
        profile = resolve_best_available(self._graph.writers, f"rt{name}", profile)
        reader = self._make(Reader, f"rt{name}", msg_type, profile)
        try:
            subscription = Subscription(
                reader,
                msg_type,
                name,
                callback,
                callback_group or self.default_callback_group,
                profile,
                raw,
                event_callbacks or SubscriptionEventCallbacks(),
            )
        except Exception:
            reader.close()
            raise
        self._graph.add_endpoints(self._full_name_pair, reader)
        return self._added(self._subscriptions, subscription)

    def create_timer(
        self,
        timer_period_sec: float,
        callback: Callable[[], Any] | None,
        callback_group: CallbackGroup | None = None,
        clock: Clock | None = None,
        autostart: bool = True,
    ) -> Timer:
        """Create a timer.

        Args:
            timer_period_sec: Seconds between calls.
            callback: The callback.
            callback_group: Its group; None for that of the node.
            clock: Clock that measures the seconds; None for that of the node.
            autostart: False to wait for its ``reset``.

        Returns:
            The timer.
        """
        timer = Timer(
            callback,
            callback_group or self.default_callback_group,
            int(float(timer_period_sec) * S_TO_NS),
            clock or self._clock,
            context=self.context,
            autostart=autostart,
        )
        timer.on_change = self._wake_executor
        return self._added(self._timers, timer)

    def create_guard_condition(
        self, callback: Callable[[], Any], callback_group: CallbackGroup | None = None
    ) -> GuardCondition:
        """Create a guard condition.

        Args:
            callback: Called after it was triggered.
            callback_group: Group of the callback; None for that of the node.

        Returns:
            The guard condition.
        """
        group = callback_group or self.default_callback_group
        return self._added(self._guards, GuardCondition(callback, group, self.context))

    def create_rate(self, frequency: float, clock: Clock | None = None) -> Rate:
        """Create a rate.

        Args:
            frequency: Calls in a second.
            clock: Clock that measures it; None for that of the node.

        Returns:
            The rate.

        Raises:
            ValueError: The frequency is not positive.
        """
        if frequency <= 0:
            raise ValueError("frequency must be > 0")
        timer = self.create_timer(1.0 / frequency, None, self._rate_group, clock)
        return Rate(timer, context=self.context)

    def _endpoint_settings(
        self,
        kind: str,
        msg_type: Any,
        topic: str,
        qos: QoSProfile | int,
        options: QoSOverridingOptions | None,
    ) -> tuple[str, QoSProfile]:
        if isinstance(qos, int):
            if qos < 0:
                raise ValueError("history depth must be greater than or equal to zero")
            qos = QoSProfile(depth=qos)
        elif not isinstance(qos, QoSProfile):
            raise TypeError(f"Expected QoSProfile or int, but received {type(qos)!r}")
        name = self._resolve_checked(topic)
        if options is not None:
            override_qos(kind, self, name, qos, options)
        check_is_valid_msg_type(msg_type)
        return name, qos

    def entities(self) -> Iterator[Entity]:
        """Go through all that an executor has to wait for.

        Yields:
            Timers, subscriptions, guard conditions, clients, services and events.
        """
        yield from tuple(self._timers)
        yield from tuple(self._subscriptions)
        yield from tuple(self._guards)
        yield from tuple(self._clients)
        yield from tuple(self._services)
        for publisher in tuple(self._publishers):
            yield from publisher.event_handlers
        for subscription in tuple(self._subscriptions):
            yield from subscription.event_handlers
