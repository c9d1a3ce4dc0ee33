# SPDX-License-Identifier: Apache-2.0
"""What a node knows of the others: nodes, topics, services and their endpoints."""

from __future__ import annotations

import time

from rclpy._graph_listing import (
    NamesAndTypes,
    endpoint_info,
    select,
    service_names_and_types,
    topic_names_and_types,
)
from rclpy._names import expand_name
from rclpy._rclpy_pybind11 import NodeNameNonExistentError
from rclpy.topic_endpoint_info import TopicEndpointInfo, TopicEndpointTypeEnum
from rclpy.validate_full_topic_name import validate_full_topic_name

from ros2_embedded.dds.graph import Endpoint, Graph, NodeEndpoints

_POLL_SECONDS = 0.01


class NodeGraph:
    """The part of a node that looks around."""

    _graph: Graph

    def get_name(self) -> str:
        """Get the name of the node."""
        raise NotImplementedError

    def get_namespace(self) -> str:
        """Get the namespace of the node."""
        raise NotImplementedError

    def get_node_names_and_namespaces(self) -> list[tuple[str, str]]:
        """List the nodes.

        Returns:
            Name and namespace of each.
        """
        return [(name, namespace) for (namespace, name), _ in self._graph.nodes()]

    def get_node_names_and_namespaces_with_enclaves(self) -> list[tuple[str, str, str]]:
        """List the nodes.

        Returns:
            Name, namespace and enclave (always ``/``) of each.
        """
        return [(*names, "/") for names in self.get_node_names_and_namespaces()]

    def get_node_names(self) -> list[str]:
        """List the nodes.

        Returns:
            Their names.
        """
        return [name for name, _ in self.get_node_names_and_namespaces()]

    def get_fully_qualified_node_names(self) -> list[str]:
        """List the nodes.

        Returns:
            Namespace and name of each, in one.
        """
        return [
            f"{namespace.rstrip('/')}/{name}"
            for name, namespace in self.get_node_names_and_namespaces()
        ]

    def wait_for_node(self, fully_qualified_node_name: str, timeout: float) -> bool:
        """Wait until a node is there.

        Args:
            fully_qualified_node_name: Namespace and name.
            timeout: Longest wait in seconds.

        Returns:
            Whether it is there.
        """
        name = f"/{fully_qualified_node_name.removeprefix('/')}"
        give_up = time.monotonic() + timeout
        while name not in self.get_fully_qualified_node_names():
            if time.monotonic() >= give_up:
                return False
            time.sleep(_POLL_SECONDS)
        return True

    def get_topic_names_and_types(self, no_demangle: bool = False) -> NamesAndTypes:
        """List the topics.

        Args:
            no_demangle: Whether to give the names of DDS, of all topics.

        Returns:
            Name and types of each.
        """
        endpoints = [*self._graph.readers(), *self._graph.writers()]
        return topic_names_and_types(endpoints, no_demangle)

    def get_service_names_and_types(self) -> NamesAndTypes:
        """List the services.

        Returns:
            Name and types of each.
        """
        return service_names_and_types(
            [*self._graph.readers(), *self._graph.writers()], ("rq", "rr")
        )

    def get_publisher_names_and_types_by_node(
        self, node_name: str, node_namespace: str, no_demangle: bool = False
    ) -> NamesAndTypes:
        """List the topics that a node publishes.

        Args:
            node_name: Name of the node.
            node_namespace: Its namespace.
            no_demangle: Whether to give the names of DDS.

        Returns:
            Name and types of each.

        Raises:
            NodeNameNonExistentError: There is no such node.
        """
        node = self._endpoints_of(node_name, node_namespace)
        return topic_names_and_types(select(self._graph.writers(), node.writers), no_demangle)

    def get_subscriber_names_and_types_by_node(
        self, node_name: str, node_namespace: str, no_demangle: bool = False
    ) -> NamesAndTypes:
        """List the topics that a node subscribes to.

        Args:
            node_name: Name of the node.
            node_namespace: Its namespace.
            no_demangle: Whether to give the names of DDS.

        Returns:
            Name and types of each.

        Raises:
            NodeNameNonExistentError: There is no such node.
        """
        node = self._endpoints_of(node_name, node_namespace)
        return topic_names_and_types(select(self._graph.readers(), node.readers), no_demangle)

    def get_service_names_and_types_by_node(
        self, node_name: str, node_namespace: str
    ) -> NamesAndTypes:
        """List the services that a node offers.

        Args:
            node_name: Name of the node.
            node_namespace: Its namespace.

        Returns:
            Name and types of each.

        Raises:
            NodeNameNonExistentError: There is no such node.
        """
        node = self._endpoints_of(node_name, node_namespace)
        return service_names_and_types(select(self._graph.readers(), node.readers), ("rq",))

    def get_client_names_and_types_by_node(
        self, node_name: str, node_namespace: str
    ) -> NamesAndTypes:
        """List the services that a node has clients of.

        Args:
            node_name: Name of the node.
            node_namespace: Its namespace.

        Returns:
            Name and types of each.

        Raises:
            NodeNameNonExistentError: There is no such node.
        """
        node = self._endpoints_of(node_name, node_namespace)
        return service_names_and_types(select(self._graph.readers(), node.readers), ("rr",))

    def count_publishers(self, topic_name: str) -> int:
        """Count the publishers of a topic.

        Args:
            topic_name: Name, which is expanded but not remapped.

        Returns:
            Their number.
        """
        topic = f"rt{self._full_name(topic_name)}"
        return sum(endpoint.topic == topic for endpoint in self._graph.writers())

    def count_subscribers(self, topic_name: str) -> int:
        """Count the subscriptions of a topic.

        Args:
            topic_name: Name, which is expanded but not remapped.

        Returns:
            Their number.
        """
        topic = f"rt{self._full_name(topic_name)}"
        return sum(endpoint.topic == topic for endpoint in self._graph.readers())

    def count_clients(self, service_name: str) -> int:
        """Count the clients of a service.

        Args:
            service_name: Name, which is expanded but not remapped.

        Returns:
            Their number.
        """
        topic = f"rr{self._full_name(service_name, is_service=True)}Reply"
        return sum(endpoint.topic == topic for endpoint in self._graph.readers())

    def count_services(self, service_name: str) -> int:
        """Count the servers of a service.

        Args:
            service_name: Name, which is expanded but not remapped.

        Returns:
            Their number.
        """
        topic = f"rq{self._full_name(service_name, is_service=True)}Request"
        return sum(endpoint.topic == topic for endpoint in self._graph.readers())

    def get_publishers_info_by_topic(
        self, topic_name: str, no_mangle: bool = False
    ) -> list[TopicEndpointInfo]:
        """Describe the publishers of a topic.

        Args:
            topic_name: Name, which is expanded but not remapped.
            no_mangle: Whether it is a name of DDS.

        Returns:
            What is known of each.
        """
        return self._describe(
            self._graph.writers(), topic_name, no_mangle, TopicEndpointTypeEnum.PUBLISHER
        )

    def get_subscriptions_info_by_topic(
        self, topic_name: str, no_mangle: bool = False
    ) -> list[TopicEndpointInfo]:
        """Describe the subscriptions of a topic.

        Args:
            topic_name: Name, which is expanded but not remapped.
            no_mangle: Whether it is a name of DDS.

        Returns:
            What is known of each.
        """
        return self._describe(
            self._graph.readers(), topic_name, no_mangle, TopicEndpointTypeEnum.SUBSCRIPTION
        )

    def _full_name(self, name: str, *, is_service: bool = False) -> str:
        full_name = expand_name(name, self.get_name(), self.get_namespace())
        validate_full_topic_name(full_name, is_service=is_service)
        return full_name

    def _endpoints_of(self, name: str, namespace: str) -> NodeEndpoints:
        for node, endpoints in self._graph.nodes():
            if node == (namespace, name):
                return endpoints
        raise NodeNameNonExistentError(f"cannot get the endpoints of node {namespace} {name}")

    def _describe(
        self,
        endpoints: list[Endpoint],
        topic_name: str,
        no_mangle: bool,
        kind: TopicEndpointTypeEnum,
    ) -> list[TopicEndpointInfo]:
        topic = topic_name if no_mangle else f"rt{self._full_name(topic_name)}"
        owners = self._graph.node_of_endpoints()
        return [
            endpoint_info(endpoint, owners.get(endpoint.gid), kind, no_mangle)
            for endpoint in endpoints
            if endpoint.topic == topic
        ]
