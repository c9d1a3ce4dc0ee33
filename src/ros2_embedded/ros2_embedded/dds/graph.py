# SPDX-License-Identifier: Apache-2.0
"""The ROS graph: which nodes there are and what they publish and subscribe to.

DDS discovers participants and their endpoints. Nodes are no DDS entities: every ROS
participant tells on the topic ``ros_discovery_info`` which endpoints belong to which of its
nodes.
"""

from __future__ import annotations

import threading
from collections import defaultdict
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any

from cyclonedds.builtin import (
    BuiltinDataReader,
    BuiltinTopicDcpsParticipant,
    BuiltinTopicDcpsPublication,
    BuiltinTopicDcpsSubscription,
)
from cyclonedds.core import DDSException, InstanceState, Qos

from ros2_embedded.dds.endpoints import Reader, Writer
from ros2_embedded.dds.library import DdsError
from ros2_embedded.dds.participant import Participant
from ros2_embedded.messages.classes import message_class
from ros2_embedded.messages.codec import deserialize, serialize

_INFO_TYPE = "rmw_dds_common/msg/ParticipantEntitiesInfo"
_TAKE_LIMIT = 1000

NodeName = tuple[str, str]


@dataclass(frozen=True, slots=True)
class Endpoint:
    """A discovered reader or writer.

    Attributes:
        gid: Its 16 bytes of identity.
        participant: Identity of its participant.
        topic: DDS name of the topic.
        type_name: DDS name of the type.
        qos: Policies as discovered.
    """

    gid: bytes
    participant: bytes
    topic: str
    type_name: str
    qos: Qos


@dataclass(slots=True)
class NodeEndpoints:
    """Identities of the endpoints of one node."""

    readers: list[bytes] = field(default_factory=list)
    writers: list[bytes] = field(default_factory=list)


@dataclass(frozen=True)
class _Policies:
    """Quality of service of the discovery topic, fixed by rmw_dds_common."""

    history: int
    depth: int = 1
    reliability: int = 1
    durability: int = 1
    liveliness: int = 0

    @dataclass(frozen=True)
    class _Unspecified:
        nanoseconds: int = 0

    lifespan = deadline = liveliness_lease_duration = _Unspecified()


class Graph:
    """Tells others about the nodes of one participant and knows those of all others."""

    def __init__(self, participant: Participant) -> None:
        """Begin to watch.

        Args:
            participant: Participant whose view of the graph this is.
        """
        self._participant = participant
        self._gid = participant.gid
        self._lock = threading.RLock()
        self._local: dict[NodeName, NodeEndpoints] = {}
        self._nodes: dict[bytes, dict[NodeName, NodeEndpoints]] = {}
        self._participants: set[bytes] = set()
        self._found: dict[str, dict[bytes, Endpoint]] = {"readers": {}, "writers": {}}
        self._batching = 0
        topic = "ros_discovery_info"
        self._writer = Writer(participant, topic, _INFO_TYPE, _Policies(history=1))
        # The topic has no key: a bounded history would lose participants.
        self._reader = Reader(participant, topic, _INFO_TYPE, _Policies(history=2))
        self._builtin = {
            name: BuiltinDataReader(participant.entity, builtin_topic)
            for name, builtin_topic in (
                ("readers", BuiltinTopicDcpsSubscription),
                ("writers", BuiltinTopicDcpsPublication),
                ("participants", BuiltinTopicDcpsParticipant),
            )
        }
        #: Handle of the condition that holds while news of nodes wait for :meth:`refresh`.
        self.condition = self._reader.condition

    @contextmanager
    def batch(self) -> Iterator[None]:
        """Tell others once about all changes made inside."""
        with self._lock:
            self._batching += 1
        try:
            yield
        finally:
            with self._lock:
                self._batching -= 1
            self._publish()

    def add_node(self, node: NodeName) -> None:
        """Announce a node.

        Args:
            node: Namespace and name.
        """
        with self._lock:
            self._local[node] = NodeEndpoints()
        self._publish()

    def remove_node(self, node: NodeName) -> None:
        """Withdraw a node.

        Args:
            node: Namespace and name.
        """
        with self._lock:
            self._local.pop(node, None)
        self._publish()

    def add_endpoints(self, node: NodeName, *endpoints: Reader | Writer) -> None:
        """Announce endpoints of a node.

        Args:
            node: Namespace and name.
            *endpoints: New endpoints.
        """
        with self._lock:
            for endpoint in endpoints:
                self._gids(node, endpoint).append(endpoint.gid)
        self._publish()

    def remove_endpoints(self, node: NodeName, *endpoints: Reader | Writer) -> None:
        """Withdraw endpoints of a node.

        Args:
            node: Namespace and name.
            *endpoints: Endpoints about to go.
        """
        with self._lock:
            for endpoint in endpoints:
                gids = self._gids(node, endpoint)
                if endpoint.gid in gids:
                    gids.remove(endpoint.gid)
        self._publish()

    def refresh(self) -> None:
        """Take in the news that have arrived; none arrive after the participant has gone."""
        try:
            self._take_news()
        except (DdsError, DDSException):
            if not self._participant.closed:
                raise

    def _take_news(self) -> None:
        with self._lock:
            while (
                taken := self._reader.take(lambda data: deserialize(data, _INFO_TYPE))
            ) is not None:
                self._read_info(taken[0])
            for name, found in self._found.items():
                for endpoint in self._builtin[name].take(N=_TAKE_LIMIT):
                    if endpoint.sample_info.instance_state == InstanceState.Alive:
                        gid = endpoint.key.bytes
                        found[gid] = Endpoint(
                            gid,
                            endpoint.participant_key.bytes,
                            endpoint.topic_name,
                            endpoint.type_name,
                            endpoint.qos,
                        )
                    else:
                        found.pop(endpoint.key.bytes, None)
            for participant in self._builtin["participants"].take(N=_TAKE_LIMIT):
                if participant.sample_info.instance_state == InstanceState.Alive:
                    self._participants.add(participant.key.bytes)
                else:
                    self._participants.discard(participant.key.bytes)
                    self._nodes.pop(participant.key.bytes, None)

    def readers(self) -> list[Endpoint]:
        """List the readers in the domain.

        Returns:
            All readers, also those of this participant.
        """
        return self._endpoints("readers")

    def writers(self) -> list[Endpoint]:
        """List the writers in the domain.

        Returns:
            All writers, also those of this participant.
        """
        return self._endpoints("writers")

    def nodes(self) -> list[tuple[NodeName, NodeEndpoints]]:
        """List the nodes in the domain.

        Returns:
            Namespace and name, and endpoints, of all nodes, own ones first.
        """
        with self._lock:
            self.refresh()
            found = list(self._local.items())
            for participant, nodes in self._nodes.items():
                if participant in self._participants:
                    found.extend(nodes.items())
            return found

    def node_of_endpoints(self) -> dict[bytes, NodeName]:
        """Find the owners of endpoints.

        Returns:
            The node of each endpoint's identity.
        """
        return {
            gid: node
            for node, endpoints in self.nodes()
            for gid in (*endpoints.readers, *endpoints.writers)
        }

    def _endpoints(self, kind: str) -> list[Endpoint]:
        with self._lock:
            self.refresh()
            return list(self._found[kind].values())

    def _gids(self, node: NodeName, endpoint: Reader | Writer) -> list[bytes]:
        endpoints = self._local.setdefault(node, NodeEndpoints())
        return endpoints.readers if isinstance(endpoint, Reader) else endpoints.writers

    def _read_info(self, info: Any) -> None:
        sender = bytes(info.gid.data)
        if sender == self._gid:
            return
        nodes: dict[NodeName, NodeEndpoints] = defaultdict(NodeEndpoints)
        for node in info.node_entities_info_seq:
            endpoints = nodes[node.node_namespace, node.node_name]
            endpoints.readers += [bytes(gid.data) for gid in node.reader_gid_seq]
            endpoints.writers += [bytes(gid.data) for gid in node.writer_gid_seq]
        self._nodes[sender] = dict(nodes)

    def _publish(self) -> None:
        gid_class = message_class("rmw_dds_common/msg/Gid")
        node_class = message_class("rmw_dds_common/msg/NodeEntitiesInfo")

        def gid(identity: bytes) -> Any:
            return gid_class(data=list(identity))

        with self._lock:
            if self._batching:
                return
            info = message_class(_INFO_TYPE)(
                gid=gid(self._gid),
                node_entities_info_seq=[
                    node_class(
                        node_namespace=namespace,
                        node_name=name,
                        reader_gid_seq=[gid(reader) for reader in endpoints.readers],
                        writer_gid_seq=[gid(writer) for writer in endpoints.writers],
                    )
                    for (namespace, name), endpoints in self._local.items()
                ],
            )
            try:
                self._writer.write(serialize(info))
            except DdsError:
                if not self._participant.closed:
                    raise
