# SPDX-License-Identifier: Apache-2.0
"""Publishers."""

from __future__ import annotations

from typing import Any, Generic, TypeVar

from rclpy._rclpy_pybind11 import RCLError
from rclpy.callback_groups import CallbackGroup
from rclpy.duration import Duration
from rclpy.event_handler import EventHandler, PublisherEventCallbacks
from rclpy.exceptions import InvalidHandle
from rclpy.qos import QoSProfile

from ros2_embedded.dds.endpoints import Writer
from ros2_embedded.dds.library import INFINITE, DdsError
from ros2_embedded.messages.codec import serialize

MsgType = TypeVar("MsgType")


class Publisher(Generic[MsgType]):
    """Sends messages to a topic."""

    def __init__(
        self,
        publisher_impl: Writer,
        msg_type: type[MsgType],
        topic: str,
        qos_profile: QoSProfile,
        event_callbacks: PublisherEventCallbacks,
        callback_group: CallbackGroup,
    ) -> None:
        """Create a publisher; :meth:`.Node.create_publisher` does so.

        Args:
            publisher_impl: The DDS writer.
            msg_type: Class of the messages.
            topic: Full name of the topic.
            qos_profile: Quality of service.
            event_callbacks: Callbacks for events of the middleware.
            callback_group: Their group.
        """
        self._writer = publisher_impl
        self.msg_type = msg_type
        self.topic = topic
        self.qos_profile = qos_profile
        self._closed = False
        self.event_handlers: list[EventHandler] = event_callbacks.create_event_handlers(
            callback_group, publisher_impl, topic
        )

    @property
    def handle(self) -> Writer:
        """The DDS writer.

        Raises:
            InvalidHandle: The publisher was destroyed.
        """
        if self._closed:
            raise InvalidHandle("cannot use Destroyable because destruction was requested")
        return self._writer

    @property
    def topic_name(self) -> str:
        """Full name of the topic after remapping."""
        return self.topic

    def publish(self, msg: MsgType | bytes) -> None:
        """Send a message.

        Args:
            msg: The message, or its CDR.

        Raises:
            TypeError: The message is of another type.
            RCLError: The message cannot be sent, or the context was shut down.
            InvalidHandle: The publisher was destroyed.
        """
        writer = self.handle
        message: Any = msg
        if isinstance(msg, self.msg_type):
            data = serialize(message)
        elif isinstance(msg, bytes):
            data = bytearray(msg) + bytes(-len(msg) % 4)
        else:
            raise TypeError(f"Expected {self.msg_type}, got {type(msg)}")
        try:
            writer.write(data)
        except DdsError as error:
            raise RCLError(f"Failed to publish: {error}") from error

    def get_subscription_count(self) -> int:
        """Count the subscriptions that get the messages.

        Returns:
            Their number.

        Raises:
            InvalidHandle: The publisher was destroyed.
        """
        try:
            return self.handle.matched_count()
        except DdsError as error:
            raise RCLError(str(error)) from error

    def assert_liveliness(self) -> None:
        """Tell that the publisher is alive."""
        self.handle.assert_liveliness()

    def wait_for_all_acked(self, timeout: Duration = Duration(seconds=-1)) -> bool:  # noqa: B008
        """Wait until all reliable subscriptions have all messages.

        Args:
            timeout: Longest wait; negative for any.

        Returns:
            False after the timeout.

        Raises:
            InvalidHandle: The publisher was destroyed.
        """
        nanoseconds = timeout.nanoseconds
        return self.handle.wait_for_acks(INFINITE if nanoseconds < 0 else nanoseconds)

    def destroy(self) -> None:
        """Delete the publisher; :meth:`.Node.destroy_publisher` does so."""
        if not self._closed:
            self._closed = True
            for handler in self.event_handlers:
                handler.destroy()
            self._writer.close()
