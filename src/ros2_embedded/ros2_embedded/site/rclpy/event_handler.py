# SPDX-License-Identifier: Apache-2.0
"""Callbacks for events of the middleware at publishers and subscriptions."""

from __future__ import annotations

from collections.abc import Awaitable, Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

from rclpy._entity import Entity, call_or_await
from rclpy._rclpy_pybind11 import UnsupportedEventTypeError as UnsupportedEventTypeError
from rclpy.callback_groups import CallbackGroup
from rclpy.logging import get_logger
from rclpy.qos import QoSPolicyKind, qos_policy_name_from_kind

from ros2_embedded.dds import status
from ros2_embedded.dds.endpoints import Reader, Writer

if TYPE_CHECKING:
    from rclpy._work_finder import WorkFinder

#: ROS policies by their numbers in DDS.
_POLICY_KINDS = {
    2: QoSPolicyKind.DURABILITY,
    4: QoSPolicyKind.DEADLINE,
    8: QoSPolicyKind.LIVELINESS,
    11: QoSPolicyKind.RELIABILITY,
    13: QoSPolicyKind.HISTORY,
    21: QoSPolicyKind.LIFESPAN,
}


@dataclass(frozen=True)
class CountInfo:
    """How often something happened, in all and since the last callback."""

    total_count: int
    total_count_change: int


@dataclass(frozen=True)
class QoSRequestedIncompatibleQoSInfo(CountInfo):
    """How often a partner asked for more than is offered, and of which policy last."""

    last_policy_kind: QoSPolicyKind


@dataclass(frozen=True)
class QoSLivelinessChangedInfo:
    """How many publishers are alive and how many are silent."""

    alive_count: int
    not_alive_count: int
    alive_count_change: int
    not_alive_count_change: int


@dataclass(frozen=True)
class QoSSubscriptionMatchedInfo(CountInfo):
    """How many partners there are and have been."""

    current_count: int
    current_count_change: int


QoSOfferedIncompatibleQoSInfo = QoSRequestedIncompatibleQoSInfo
QoSPublisherMatchedInfo = QoSSubscriptionMatchedInfo
QoSRequestedDeadlineMissedInfo = CountInfo
QoSOfferedDeadlineMissedInfo = CountInfo
QoSLivelinessLostInfo = CountInfo
QoSMessageLostInfo = CountInfo
IncompatibleTypeInfo = CountInfo


class EventHandler(Entity):
    """Runs a callback after an event."""

    def __init__(
        self,
        *,
        callback_group: CallbackGroup,
        callback: Callable[[Any], Any],
        event_type: status.StatusKind,
        parent_impl: Reader | Writer,
    ) -> None:
        """Create a handler.

        Args:
            callback_group: Group of the callback.
            callback: Gets what is known of the event.
            event_type: The event.
            parent_impl: Endpoint where it happens.
        """
        super().__init__(callback_group)
        self.callback = callback
        self.event_type = event_type
        self._endpoint = parent_impl

    @property
    def wait_handle(self) -> int | None:
        """The endpoint, which wakes for the events it watches."""
        return None if self._closed else self._endpoint.handle

    def take(self, executor: WorkFinder | None = None) -> Callable[[], Awaitable[Any]] | None:
        """Take the event, if it has happened."""
        if self._closed:
            return None
        found = status.take_status(self._endpoint.handle, self.event_type)
        if found is None:
            return None
        info = _describe(found)
        return lambda: call_or_await(self.callback, info)

    def destroy(self) -> None:
        """Stop calling."""
        self._close_handle()


def _describe(found: Any) -> Any:
    if hasattr(found, "last_policy_id"):
        kind = _POLICY_KINDS.get(found.last_policy_id, QoSPolicyKind.INVALID)
        return QoSRequestedIncompatibleQoSInfo(found.total_count, found.total_count_change, kind)
    if hasattr(found, "alive_count"):
        return QoSLivelinessChangedInfo(
            found.alive_count,
            found.not_alive_count,
            found.alive_count_change,
            found.not_alive_count_change,
        )
    if hasattr(found, "current_count"):
        return QoSSubscriptionMatchedInfo(
            found.total_count,
            found.total_count_change,
            found.current_count,
            found.current_count_change,
        )
    return CountInfo(found.total_count, found.total_count_change)


class _EventCallbacks:
    """Callbacks for the events of one endpoint."""

    _kinds: ClassVar[dict[str, status.StatusKind]]
    _incompatible_text: str

    def __init__(self, use_default_callbacks: bool, callbacks: dict[str, Any]) -> None:
        self.use_default_callbacks = use_default_callbacks
        self._callbacks = callbacks
        self.__dict__.update(callbacks)

    def create_event_handlers(
        self, callback_group: CallbackGroup, endpoint: Reader | Writer, topic_name: str
    ) -> list[EventHandler]:
        """Create the handlers for an endpoint.

        Args:
            callback_group: Group of the callbacks.
            endpoint: The DDS endpoint.
            topic_name: Name of the topic, for messages.

        Returns:
            The handlers.

        Raises:
            UnsupportedEventTypeError: A callback is for an event that DDS does not have.
        """
        callbacks = {name: call for name, call in self._callbacks.items() if call}
        if callbacks.pop("incompatible_type", None) is not None:
            raise UnsupportedEventTypeError("events of incompatible types are not offered")
        if self.use_default_callbacks:
            callbacks.setdefault("incompatible_qos", self._warner(topic_name))
        status.watch(endpoint.handle, [self._kinds[name] for name in callbacks])
        return [
            EventHandler(
                callback_group=callback_group,
                callback=callback,
                event_type=self._kinds[name],
                parent_impl=endpoint,
            )
            for name, callback in callbacks.items()
        ]

    def _warner(self, topic_name: str) -> Callable[[QoSRequestedIncompatibleQoSInfo], None]:
        def warn(info: QoSRequestedIncompatibleQoSInfo) -> None:
            policy = qos_policy_name_from_kind(info.last_policy_kind)
            get_logger("rclpy").warning(
                self._incompatible_text.format(topic=topic_name, policy=policy)
            )

        return warn


class SubscriptionEventCallbacks(_EventCallbacks):
    """Callbacks for the events of a subscription."""

    _kinds: ClassVar[dict[str, status.StatusKind]] = {
        "deadline": status.REQUESTED_DEADLINE_MISSED,
        "incompatible_qos": status.REQUESTED_INCOMPATIBLE_QOS,
        "liveliness": status.LIVELINESS_CHANGED,
        "message_lost": status.SAMPLE_LOST,
        "matched": status.SUBSCRIPTION_MATCHED,
    }
    _incompatible_text = (
        "New publisher discovered on topic '{topic}', offering incompatible QoS. "
        "No messages will be received from it. Last incompatible policy: {policy}"
    )

    def __init__(
        self,
        *,
        deadline: Callable[[CountInfo], Any] | None = None,
        incompatible_qos: Callable[[QoSRequestedIncompatibleQoSInfo], Any] | None = None,
        liveliness: Callable[[QoSLivelinessChangedInfo], Any] | None = None,
        message_lost: Callable[[CountInfo], Any] | None = None,
        incompatible_type: Callable[[CountInfo], Any] | None = None,
        matched: Callable[[QoSSubscriptionMatchedInfo], Any] | None = None,
        use_default_callbacks: bool = True,
    ) -> None:
        """Choose callbacks.

        Args:
            deadline: No message came in time.
            incompatible_qos: A publisher offers too little.
            liveliness: A publisher fell silent or came back.
            message_lost: A message was lost.
            incompatible_type: Not offered.
            matched: A publisher came or went.
            use_default_callbacks: Whether to warn of publishers that offer too little.
        """
        super().__init__(
            use_default_callbacks,
            {
                "deadline": deadline,
                "incompatible_qos": incompatible_qos,
                "liveliness": liveliness,
                "message_lost": message_lost,
                "incompatible_type": incompatible_type,
                "matched": matched,
            },
        )


class PublisherEventCallbacks(_EventCallbacks):
    """Callbacks for the events of a publisher."""

    _kinds: ClassVar[dict[str, status.StatusKind]] = {
        "deadline": status.OFFERED_DEADLINE_MISSED,
        "liveliness": status.LIVELINESS_LOST,
        "incompatible_qos": status.OFFERED_INCOMPATIBLE_QOS,
        "matched": status.PUBLICATION_MATCHED,
    }
    _incompatible_text = (
        "New subscription discovered on topic '{topic}', requesting incompatible QoS. "
        "No messages will be sent to it. Last incompatible policy: {policy}"
    )

    def __init__(
        self,
        *,
        deadline: Callable[[CountInfo], Any] | None = None,
        liveliness: Callable[[CountInfo], Any] | None = None,
        incompatible_qos: Callable[[QoSRequestedIncompatibleQoSInfo], Any] | None = None,
        incompatible_type: Callable[[CountInfo], Any] | None = None,
        matched: Callable[[QoSPublisherMatchedInfo], Any] | None = None,
        use_default_callbacks: bool = True,
    ) -> None:
        """Choose callbacks.

        Args:
            deadline: No message was sent in time.
            liveliness: The publisher was silent for too long.
            incompatible_qos: A subscription asks for too much.
            incompatible_type: Not offered.
            matched: A subscription came or went.
            use_default_callbacks: Whether to warn of subscriptions that ask for too much.
        """
        super().__init__(
            use_default_callbacks,
            {
                "deadline": deadline,
                "liveliness": liveliness,
                "incompatible_qos": incompatible_qos,
                "incompatible_type": incompatible_type,
                "matched": matched,
            },
        )
