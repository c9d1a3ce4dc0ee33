# SPDX-License-Identifier: Apache-2.0
"""The participant in a DDS domain that stands for one ROS context."""

from __future__ import annotations

import atexit
import threading
import weakref
from typing import ClassVar

from cyclonedds.core import Policy, Qos
from cyclonedds.domain import Domain, DomainParticipant
from cyclonedds.pub import Publisher
from cyclonedds.sub import Subscriber
from cyclonedds.topic import Topic

from ros2_embedded.dds.configuration import domain_configuration
from ros2_embedded.dds.library import delete_entity
from ros2_embedded.dds.types import idl_struct

_open_participants: weakref.WeakSet[Participant] = weakref.WeakSet()


@atexit.register
def _close_all() -> None:
    # Otherwise others would believe us alive until a lease has run out.
    for participant in list(_open_participants):
        participant.close()


class Participant:
    """A participant with the publisher, subscriber and topics its endpoints share."""

    # Cyclone knows one configuration per domain and process; participants share it.
    _domains: ClassVar[dict[int, tuple[Domain, int]]] = {}
    _domains_lock: ClassVar[threading.Lock] = threading.Lock()

    def __init__(self, domain_id: int) -> None:
        """Join a domain.

        Args:
            domain_id: ROS domain.

        Raises:
            cyclonedds.core.DDSException: The domain cannot be joined.
            ValueError: The environment names an unknown discovery range.
        """
        self.domain_id = domain_id
        self._topics: dict[tuple[str, str, bool], Topic] = {}
        self._topics_lock = threading.Lock()
        self.closed = False
        with self._domains_lock:
            domain, users = self._domains.get(domain_id, (None, 0))
            if domain is None:
                domain = Domain(domain_id, domain_configuration())
            self._domains[domain_id] = (domain, users + 1)
        try:
            self.entity = DomainParticipant(domain_id, Qos(Policy.Userdata(b"enclave=/;")))
        except BaseException:
            self._leave_domain()
            raise
        _open_participants.add(self)
        self.publisher = Publisher(self.entity)
        self.subscriber = Subscriber(self.entity)

    @property
    def handle(self) -> int:
        """Handle of the DDS entity."""
        return int(self.entity._ref)

    @property
    def gid(self) -> bytes:
        """The 16 bytes that name the participant in the network."""
        return bytes(self.entity.guid.bytes)

    def topic(self, name: str, ros_type: str, with_request_id: bool = False) -> Topic:
        """Get a topic.

        Args:
            name: DDS name of the topic.
            ros_type: Message type.
            with_request_id: True for the topics of services.

        Returns:
            The topic, shared by all endpoints on it.
        """
        key = (name, ros_type, with_request_id)
        with self._topics_lock:
            if key not in self._topics:
                self._topics[key] = Topic(self.entity, name, idl_struct(ros_type, with_request_id))
            return self._topics[key]

    def close(self) -> None:
        """Leave the domain and delete all endpoints; a second time does nothing."""
        if self.closed:
            return
        self.closed = True
        _open_participants.discard(self)
        self._topics.clear()
        delete_entity(self.entity)
        self._leave_domain()

    def _leave_domain(self) -> None:
        with self._domains_lock:
            domain, users = self._domains.pop(self.domain_id)
            if users > 1:
                self._domains[self.domain_id] = (domain, users - 1)
            else:
                delete_entity(domain)
