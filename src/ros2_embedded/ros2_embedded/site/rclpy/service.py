# SPDX-License-Identifier: Apache-2.0
"""Service servers."""

from __future__ import annotations

import time
from collections.abc import Awaitable, Callable
from typing import TYPE_CHECKING, Any

from rclpy import _request_id
from rclpy._entity import Entity, call_or_await
from rclpy._request_id import RequestId
from rclpy.callback_groups import CallbackGroup
from rclpy.qos import QoSProfile

from ros2_embedded.dds.endpoints import Reader, Writer
from ros2_embedded.dds.library import DdsError
from ros2_embedded.messages.codec import deserialize, serialize

if TYPE_CHECKING:
    from rclpy._work_finder import WorkFinder

# A client may be known by its request before its reader of responses is.
_CLIENT_WAIT = 0.1
_CLIENT_POLL = 0.001


class Service(Entity):
    """Answers requests."""

    def __init__(
        self,
        service_impl: tuple[Reader, Writer],
        srv_type: Any,
        srv_name: str,
        callback: Callable[[Any, Any], Any],
        callback_group: CallbackGroup,
        qos_profile: QoSProfile,
    ) -> None:
        """Create a server; :meth:`.Node.create_service` does so.

        Args:
            service_impl: DDS reader of requests and writer of responses.
            srv_type: Class of the service.
            srv_name: Full name of the service.
            callback: Gets a request and an empty response, and returns the response.
            callback_group: Its group.
            qos_profile: Quality of service.
        """
        super().__init__(callback_group)
        self._reader, self._writer = service_impl
        self.srv_type = srv_type
        self.srv_name = srv_name
        self.callback = callback
        self.qos_profile = qos_profile

    @property
    def handle(self) -> tuple[Reader, Writer]:
        """The DDS endpoints.

        Raises:
            InvalidHandle: The server was destroyed.
        """
        self._check_handle()
        return self._reader, self._writer

    @property
    def wait_handle(self) -> int | None:
        """The DDS condition to wait for."""
        return None if self._closed else self._reader.condition

    @property
    def service_name(self) -> str:
        """Full name of the service."""
        return self.srv_name

    def send_response(self, response: Any, header: RequestId) -> None:
        """Answer a request.

        Args:
            response: The answer.
            header: Identity of the request.

        Raises:
            TypeError: The answer is of another type.
            InvalidHandle: The server was destroyed.
        """
        if not isinstance(response, self.srv_type.Response):
            raise TypeError(f"Expected {self.srv_type.Response}, got {type(response)}")
        reader, writer = self.handle
        give_up = time.monotonic() + _CLIENT_WAIT
        try:
            while writer.matched_count() < reader.matched_count() and time.monotonic() < give_up:
                time.sleep(_CLIENT_POLL)
            message: Any = response
            writer.write(serialize(message, header.pack()))
        except DdsError:
            return  # The context was shut down; nobody waits for the answer any more.

    def take(self, executor: WorkFinder | None = None) -> Callable[[], Awaitable[Any]] | None:
        """Take the next request for the callback."""
        if self._closed:
            return None
        try:
            taken = self._reader.take(self._convert)
        except DdsError:
            return None
        if taken is None:
            return None
        header, request = taken[0]

        async def answer() -> None:
            response = await call_or_await(self.callback, request, self.srv_type.Response())
            self.send_response(response, header)

        return answer

    def configure_introspection(self, *args: object) -> None:
        """Publish requests and responses; not offered.

        Args:
            *args: As in ROS 2.

        Raises:
            NotImplementedError: Always.
        """
        raise NotImplementedError("service introspection is not offered by ros2_embedded")

    def destroy(self) -> None:
        """Delete the server; :meth:`.Node.destroy_service` does so."""
        if self._close_handle():
            self._reader.close()
            self._writer.close()

    def _convert(self, data: memoryview) -> tuple[RequestId, Any]:
        request_type = self.srv_type.Request.__ros_type__
        return RequestId.unpack(data), deserialize(data, request_type, _request_id.SIZE)
