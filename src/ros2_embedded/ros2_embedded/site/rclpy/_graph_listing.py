# SPDX-License-Identifier: Apache-2.0
"""Topics, services and descriptions of discovered endpoints."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable

from rclpy._graph_names import service_of, topic_of
from rclpy.duration import Duration
from rclpy.qos import QoSProfile
from rclpy.topic_endpoint_info import TopicEndpointInfo, TopicEndpointTypeEnum
from rclpy.type_hash import TypeHash

from ros2_embedded.dds.graph import Endpoint
from ros2_embedded.dds.qos import profile_of, user_data_of

NamesAndTypes = list[tuple[str, list[str]]]


def endpoint_info(
    endpoint: Endpoint,
    owner: tuple[str, str] | None,
    kind: TopicEndpointTypeEnum,
    no_mangle: bool,
) -> TopicEndpointInfo:
    """Describe an endpoint.

    Args:
        endpoint: The endpoint.
        owner: Namespace and name of its node, None if they are not known.
        kind: Publisher or subscription.
        no_mangle: Whether to give the DDS name of the type.

    Returns:
        What is known of it.
    """
    namespace, name = owner or ("_NODE_NAMESPACE_UNKNOWN_", "_NODE_NAME_UNKNOWN_")
    policies = profile_of(endpoint.qos)
    durations = ("lifespan", "deadline", "liveliness_lease_duration")
    profile = {
        key: Duration(nanoseconds=value) if key in durations else value
        for key, value in policies.items()
    }
    hash_text = user_data_of(endpoint.qos).get("typehash", "")
    type_name = endpoint.type_name
    return TopicEndpointInfo(
        node_name=name,
        node_namespace=namespace,
        topic_type=type_name if no_mangle else topic_of(endpoint.topic, type_name)[1],
        topic_type_hash=TypeHash.from_text(hash_text),
        endpoint_type=kind,
        endpoint_gid=list(endpoint.gid),
        qos_profile=QoSProfile(**profile),
    )


def select(endpoints: list[Endpoint], gids: list[bytes]) -> list[Endpoint]:
    """Select endpoints.

    Args:
        endpoints: Endpoints.
        gids: Identities of those to select.

    Returns:
        The selected ones.
    """
    return [endpoint for endpoint in endpoints if endpoint.gid in gids]


def topic_names_and_types(endpoints: Iterable[Endpoint], no_demangle: bool) -> NamesAndTypes:
    """List the topics of endpoints.

    Args:
        endpoints: Endpoints.
        no_demangle: Whether to give the names of DDS, of all topics.

    Returns:
        Name and types of each topic.
    """
    types: dict[str, set[str]] = defaultdict(set)
    for endpoint in endpoints:
        name, kind = endpoint.topic, endpoint.type_name
        if not no_demangle:
            name, kind = topic_of(name, kind)
        if name:
            types[name].add(kind)
    return [(name, sorted(types[name])) for name in sorted(types)]


def service_names_and_types(
    endpoints: Iterable[Endpoint], prefixes: tuple[str, ...]
) -> NamesAndTypes:
    """List the services of endpoints.

    Args:
        endpoints: Endpoints.
        prefixes: ``rq`` for requests, ``rr`` for responses.

    Returns:
        Name and types of each service.
    """
    types: dict[str, set[str]] = defaultdict(set)
    for endpoint in endpoints:
        name, kind = service_of(endpoint.topic, endpoint.type_name, prefixes)
        if name:
            types[name].add(kind)
    return [(name, sorted(types[name])) for name in sorted(types)]
