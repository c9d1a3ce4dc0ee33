# SPDX-License-Identifier: Apache-2.0
"""Subscriptions."""

from __future__ import annotations

import inspect
import time
from collections.abc import Awaitable, Callable
from enum import Enum
from typing import TYPE_CHECKING, Any, Generic, TypeVar

from rclpy._entity import Entity, call_or_await
from rclpy._rclpy_pybind11 import RCLError
from rclpy.callback_groups import CallbackGroup
from rclpy.event_handler import EventHandler, SubscriptionEventCallbacks
from rclpy.logging import get_logger
from rclpy.qos import QoSProfile

from ros2_embedded.dds.endpoints import Reader
from ros2_embedded.dds.library import DdsError
from ros2_embedded.messages.codec import deserialize

if TYPE_CHECKING:
    from rclpy._work_finder import WorkFinder

MsgType = TypeVar("MsgType")

#: ``source_timestamp`` and ``received_timestamp``, nanoseconds, and sequence numbers.
MessageInfo = dict[str, int | None]


class Subscription(Entity, Generic[MsgType]):
    """Receives messages of a topic."""

    class CallbackType(Enum):
        """What a callback takes."""

        MessageOnly = 0
        WithMessageInfo = 1

    def __init__(
        self,
        subscription_impl: Reader,
        msg_type: type[MsgType],
        topic: str,
        callback: Callable[..., Any],
        callback_group: CallbackGroup,
        qos_profile: QoSProfile,
        raw: bool,
        event_callbacks: SubscriptionEventCallbacks,
    ) -> None:
        """Create a subscription; :meth:`.Node.create_subscription` does so.

        Args:
            subscription_impl: The DDS reader.
            msg_type: Class of the messages.
            topic: Full name of the topic.
            callback: Takes a message, or a message and its :data:`MessageInfo`.
            callback_group: Its group.
            qos_profile: Quality of service.
            raw: Give the CDR of messages to the callback, not messages.
            event_callbacks: Callbacks for events of the middleware.

        Raises:
            RuntimeError: The callback takes neither one argument nor two.
        """
        super().__init__(callback_group)
        self.callback = callback
        self._reader = subscription_impl
        self.msg_type = msg_type
        self.topic = topic
        self.qos_profile = qos_profile
        self.raw = raw
        self.event_handlers: list[EventHandler] = event_callbacks.create_event_handlers(
            callback_group, subscription_impl, topic
        )

    @property
    def handle(self) -> Reader:
        """The DDS reader.

        Raises:
            InvalidHandle: The subscription was destroyed.
        """
        self._check_handle()
        return self._reader

    @property
    def wait_handle(self) -> int | None:
        """The DDS condition to wait for."""
        return None if self._closed else self._reader.condition

    @property
    def topic_name(self) -> str:
        """Full name of the topic after remapping."""
        return self.topic

    @property
    def callback(self) -> Callable[..., Any]:
        """What messages are given to."""
        return self._callback

    @callback.setter
    def callback(self, value: Callable[..., Any]) -> None:
        self._callback = value
        for count, kind in enumerate(self.CallbackType, start=1):
            try:
                inspect.signature(value).bind(*(object(),) * count)
            except TypeError:
                continue
            self._callback_type = kind
            return
        raise RuntimeError(
            "Subscription.__init__(): callback should be either be callable with one argument"
            "(to get only the message) or two (to get message and message info)"
        )

    def get_publisher_count(self) -> int:
        """Count the publishers that send to this subscription.

        Returns:
            Their number.

        Raises:
            InvalidHandle: The subscription was destroyed.
        """
        try:
            return self.handle.matched_count()
        except DdsError as error:
            raise RCLError(str(error)) from error

    def take_message(self) -> tuple[Any, MessageInfo] | None:
        """Take the next message, if there is one.

        Returns:
            The message, or its CDR if the subscription is raw, and what is known of it.
        """
        try:
            taken = self._reader.take(self._convert)
        except DdsError:
            return None  # The context was shut down meanwhile.
        except ValueError as error:
            get_logger("rclpy").error(f"dropped a message of {self.topic}: {error}")
            return None
        if taken is None:
            return None
        return taken[0], {
            "source_timestamp": taken[1].source_timestamp,
            "received_timestamp": time.time_ns(),
            "publication_sequence_number": None,
            "reception_sequence_number": None,
        }

    def take(self, executor: WorkFinder | None = None) -> Callable[[], Awaitable[Any]] | None:
        """Take the next message for the callback."""
        if self._closed or (taken := self.take_message()) is None:
            return None
        callback = self._callback
        if self._callback_type is self.CallbackType.WithMessageInfo:
            return lambda: call_or_await(callback, *taken)
        return lambda: call_or_await(callback, taken[0])

    def destroy(self) -> None:
        """Delete the subscription; :meth:`.Node.destroy_subscription` does so."""
        if self._close_handle():
            for handler in self.event_handlers:
                handler.destroy()
            self._reader.close()

    def _convert(self, data: memoryview) -> Any:
        if self.raw:
            return bytes(data)
        msg_type: Any = self.msg_type
        return deserialize(data, msg_type.__ros_type__)
