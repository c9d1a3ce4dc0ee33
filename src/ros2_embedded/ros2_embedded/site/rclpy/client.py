# SPDX-License-Identifier: Apache-2.0
"""Service clients."""

from __future__ import annotations

import itertools
import threading
import time
from collections.abc import Awaitable, Callable
from typing import TYPE_CHECKING, Any

from rclpy import _request_id
from rclpy._entity import Entity
from rclpy._rclpy_pybind11 import RCLError
from rclpy._request_id import RequestId
from rclpy.callback_groups import CallbackGroup
from rclpy.context import Context
from rclpy.qos import QoSProfile
from rclpy.task import Future

from ros2_embedded.dds.endpoints import Reader, Writer
from ros2_embedded.dds.library import DdsError
from ros2_embedded.messages.codec import deserialize, serialize

if TYPE_CHECKING:
    from rclpy._work_finder import WorkFinder

_SERVICE_POLL = 0.01


class Client(Entity):
    """Sends requests to a service."""

    def __init__(
        self,
        context: Context,
        client_impl: tuple[Reader, Writer],
        srv_type: Any,
        srv_name: str,
        qos_profile: QoSProfile,
        callback_group: CallbackGroup,
    ) -> None:
        """Create a client; :meth:`.Node.create_client` does so.

        Args:
            context: Ends waiting when it is shut down.
            client_impl: DDS reader of responses and writer of requests.
            srv_type: Class of the service.
            srv_name: Full name of the service.
            qos_profile: Quality of service.
            callback_group: Group of the callbacks of futures.
        """
        super().__init__(callback_group)
        self.context = context
        self._reader, self._writer = client_impl
        self._identity = self._writer.instance_handle
        self.srv_type = srv_type
        self.srv_name = srv_name
        self.qos_profile = qos_profile
        self._numbers = itertools.count(1)
        self._pending_requests: dict[int, Future[Any]] = {}
        self._lock = threading.Lock()

    @property
    def handle(self) -> tuple[Reader, Writer]:
        """The DDS endpoints.

        Raises:
            InvalidHandle: The client was destroyed.
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

    def call(self, request: Any, timeout_sec: float | None = None) -> Any:
        """Send a request and wait; another thread must spin the node.

        Args:
            request: The request.
            timeout_sec: Longest wait; None for any.

        Returns:
            The response, None after the timeout.

        Raises:
            TypeError: The request is of another type.
        """
        future = self.call_async(request)
        event = threading.Event()
        future.add_done_callback(lambda _: event.set())
        if not future.done() and not event.wait(timeout_sec):
            self.remove_pending_request(future)
        return future.result()

    def call_async(self, request: Any) -> Future[Any]:
        """Send a request.

        Args:
            request: The request.

        Returns:
            The response to come.

        Raises:
            TypeError: The request is of another type.
            InvalidHandle: The client was destroyed.
        """
        if not isinstance(request, self.srv_type.Request):
            raise TypeError(f"Expected {self.srv_type.Request}, got {type(request)}")
        _, writer = self.handle
        message: Any = request
        future: Future[Any] = Future()
        with self._lock:
            number = next(self._numbers)
            self._pending_requests[number] = future
        future.add_done_callback(self.remove_pending_request)
        try:
            writer.write(serialize(message, RequestId(self._identity, number).pack()))
        except DdsError as error:
            self.remove_pending_request(future)
            raise RCLError(f"failed to send request: {error}") from error
        return future

    def get_pending_request(self, sequence_number: int) -> Future[Any]:
        """Get the response to come of a request.

        Args:
            sequence_number: Number of the request.

        Returns:
            The future.

        Raises:
            KeyError: No such request waits.
        """
        with self._lock:
            return self._pending_requests[sequence_number]

    def remove_pending_request(self, future: Future[Any]) -> None:
        """Forget a request.

        Args:
            future: Its response to come.
        """
        with self._lock:
            for number, pending in self._pending_requests.items():
                if pending is future:
                    del self._pending_requests[number]
                    break

    def service_is_ready(self) -> bool:
        """Tell whether there is a server.

        Returns:
            Whether there is.

        Raises:
            InvalidHandle: The client was destroyed.
        """
        reader, writer = self.handle
        try:
            return reader.matched_count() > 0 and writer.matched_count() > 0
        except DdsError:
            return False

    def wait_for_service(self, timeout_sec: float | None = None) -> bool:
        """Wait for a server.

        Args:
            timeout_sec: Longest wait; None for any.

        Returns:
            Whether there is a server.

        Raises:
            InvalidHandle: The client was destroyed.
        """
        give_up = None if timeout_sec is None else time.monotonic() + timeout_sec
        while not (ready := self.service_is_ready()) and self.context.ok():
            if give_up is not None and time.monotonic() >= give_up:
                break
            time.sleep(_SERVICE_POLL)
        return ready

    def take(self, executor: WorkFinder | None = None) -> Callable[[], Awaitable[Any]] | None:
        """Take the next response, if it is for this client."""
        if self._closed:
            return None
        try:
            taken = self._reader.take(self._convert)
        except DdsError:
            return None
        if taken is None or taken[0] is None:
            return None
        number, response = taken[0]

        async def finish() -> None:
            with self._lock:
                future = self._pending_requests.get(number)
            if future is not None:  # else given up meanwhile
                future._set_executor(executor)
                future.set_result(response)

        return finish

    def configure_introspection(self, *args: object) -> None:
        """Publish requests and responses; not offered.

        Args:
            *args: As in ROS 2.

        Raises:
            NotImplementedError: Always.
        """
        raise NotImplementedError("service introspection is not offered by ros2_embedded")

    def destroy(self) -> None:
        """Delete the client; :meth:`.Node.destroy_client` does so."""
        if self._close_handle():
            self._reader.close()
            self._writer.close()

    def _convert(self, data: memoryview) -> tuple[int, Any] | None:
        request_id = RequestId.unpack(data)
        if request_id.client != self._identity:
            return None
        response_type = self.srv_type.Response.__ros_type__
        return request_id.sequence_number, deserialize(data, response_type, _request_id.SIZE)
