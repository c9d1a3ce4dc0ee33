# SPDX-License-Identifier: Apache-2.0
"""Subscribes to topics as they appear and hands their messages to a recording."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from rclpy.node import Node
from rclpy.qos import QoSDurabilityPolicy, QoSProfile, QoSReliabilityPolicy
from rclpy.topic_endpoint_info import TopicEndpointInfo

from ros2_embedded.cli.bag.qos import DEPTH, to_bag
from ros2_embedded.cli.bag.recording import Recording
from ros2_embedded.cli.bag.selection import TopicSelection
from ros2_embedded.cli.graph import topics
from ros2_embedded.cli.interfaces import UnknownTypeError, message_class
from ros2_embedded.cli.qos_options import adapt_to_offers


class Recorder:
    """Finds the selected topics and records them.

    Args:
        node: The node that subscribes.
        recording: The bag.
        selection: What is recorded.
        include_unpublished: Subscribe to topics that nobody publishes yet.
    """

    def __init__(
        self,
        node: Node,
        recording: Recording,
        selection: TopicSelection,
        *,
        include_unpublished: bool = False,
    ) -> None:
        self._node = node
        self._logger = node.get_logger()
        self._recording = recording
        self._selection = selection
        self._include_unpublished = include_unpublished
        self._subscribed: dict[str, QoSProfile] = {}
        self._warned: set[str] = set()

    def discover(self) -> None:
        """Subscribe to the selected topics that have appeared since the last time."""
        for topic, types in topics(self._node, include_hidden=self._selection.hidden):
            if not self._selection.takes(topic, types[0]):
                continue
            publishers = self._node.get_publishers_info_by_topic(topic)
            if topic in self._subscribed:
                self._warn_of_unheard(topic, publishers)
            elif len(types) > 1:
                self._warn_once(topic, f"Topic '{topic}' has several types: {', '.join(types)}")
            elif publishers or self._include_unpublished:
                self._subscribe(topic, types[0], publishers)

    def _subscribe(self, topic: str, msgtype: str, publishers: list[TopicEndpointInfo]) -> None:
        try:
            kind = message_class(msgtype)
        except UnknownTypeError as error:
            self._warn_once(
                topic,
                f"Topic '{topic}' has unknown type '{msgtype}'. Only topics with known type "
                f"are supported. Reason: '{error}'",
            )
            return
        profile = QoSProfile(depth=DEPTH)
        for warning in adapt_to_offers(profile, publishers, topic):
            self._logger.warning(warning)
        # The bag must know the topic before its first message can arrive.
        self._recording.add_topic(
            topic,
            msgtype,
            _common_type_hash(publishers),
            [to_bag(info.qos_profile) for info in publishers],
        )
        self._node.create_subscription(kind, topic, self._writer_of(topic), profile, raw=True)
        self._subscribed[topic] = profile
        self._logger.info(f"Subscribed to topic '{topic}'")

    def _writer_of(self, topic: str) -> Callable[[bytes, Mapping[str, Any]], None]:
        def write(data: bytes, info: Mapping[str, Any]) -> None:
            self._recording.write(topic, info["received_timestamp"], data)

        return write

    def _warn_of_unheard(self, topic: str, publishers: list[TopicEndpointInfo]) -> None:
        """Warn of a publisher that came later and offers less than was asked for."""
        profile = self._subscribed[topic]
        for strong, name in (
            (QoSReliabilityPolicy.RELIABLE, "reliability"),
            (QoSDurabilityPolicy.TRANSIENT_LOCAL, "durability"),
        ):
            if getattr(profile, name) != strong:
                continue
            if any(getattr(info.qos_profile, name) != strong for info in publishers):
                self._warn_once(
                    topic,
                    f"A new publisher for subscribed topic {topic} does not offer {strong}, but "
                    "the recorder has asked for it. Messages from this new publisher will not "
                    "be recorded.",
                )

    def _warn_once(self, topic: str, warning: str) -> None:
        if topic not in self._warned:
            self._warned.add(topic)
            self._logger.warning(warning)


def _common_type_hash(publishers: list[TopicEndpointInfo]) -> str:
    """Return the type hash that all publishers announce, empty if there is no such hash."""
    hashes = {str(info.topic_type_hash) for info in publishers}
    known = {text for text in hashes if text.startswith("RIHS01_")}
    return known.pop() if len(known) == 1 else ""
