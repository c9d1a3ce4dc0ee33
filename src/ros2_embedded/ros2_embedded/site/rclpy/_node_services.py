# SPDX-License-Identifier: Apache-2.0
"""Creating the services and clients of a node."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

from cyclonedds.core import DDSException
from rclpy import _request_id
from rclpy._node_base import NodeBase
from rclpy._rclpy_pybind11 import RCLError
from rclpy.callback_groups import CallbackGroup
from rclpy.client import Client
from rclpy.qos import QoSProfile, qos_profile_services_default
from rclpy.service import Service
from rclpy.type_support import check_is_valid_srv_type

from ros2_embedded.dds.endpoints import Reader, Writer

EntityType = TypeVar("EntityType")


class NodeServices(NodeBase):
    """The part of a node that offers and uses services."""

    def create_client(
        self,
        srv_type: Any,
        srv_name: str,
        *,
        qos_profile: QoSProfile = qos_profile_services_default,
        callback_group: CallbackGroup | None = None,
    ) -> Client:
        """Create a client of a service.

        Args:
            srv_type: Class of the service.
            srv_name: Name of the service.
            qos_profile: Quality of service.
            callback_group: Group of the client; None for that of the node.

        Returns:
            The client.

        Raises:
            InvalidServiceNameException: The name is not allowed.
        """
        check_is_valid_srv_type(srv_type)
        name = self._resolve_checked(srv_name, is_service=True)
        requests, responses = _request_id.service_topics(name)
        identity = _request_id.new_identity("clientid")
        reader = self._make(Reader, responses, srv_type.Response, qos_profile, identity)
        writer = self._make(Writer, requests, srv_type.Request, qos_profile, identity)
        group = callback_group or self.default_callback_group
        client = Client(self.context, (reader, writer), srv_type, name, qos_profile, group)
        self._graph.add_endpoints(self._full_name_pair, reader, writer)
        return self._added(self._clients, client)

    def create_service(
        self,
        srv_type: Any,
        srv_name: str,
        callback: Callable[[Any, Any], Any],
        *,
        qos_profile: QoSProfile = qos_profile_services_default,
        callback_group: CallbackGroup | None = None,
    ) -> Service:
        """Offer a service.

        Args:
            srv_type: Class of the service.
            srv_name: Name of the service.
            callback: Gets a request and an empty response, and returns the response.
            qos_profile: Quality of service.
            callback_group: Group of the callback; None for that of the node.

        Returns:
            The server.

        Raises:
            InvalidServiceNameException: The name is not allowed.
        """
        check_is_valid_srv_type(srv_type)
        name = self._resolve_checked(srv_name, is_service=True)
        requests, responses = _request_id.service_topics(name)
        identity = _request_id.new_identity("serviceid")
        writer = self._make(Writer, responses, srv_type.Response, qos_profile, identity)
        reader = self._make(Reader, requests, srv_type.Request, qos_profile, identity)
        group = callback_group or self.default_callback_group
        service = Service((reader, writer), srv_type, name, callback, group, qos_profile)
        self._graph.add_endpoints(self._full_name_pair, reader, writer)
        return self._added(self._services, service)

    def _make(
        self,
        kind: type[EntityType],
        topic: str,
        msg_type: Any,
        profile: QoSProfile,
        identity: str = "",
    ) -> EntityType:
        make: Any = kind
        try:
            made: EntityType = make(
                self.context.participant,
                topic,
                msg_type.__ros_type__,
                profile,
                user_data=identity,
                with_request_id=bool(identity),
            )
        except DDSException as error:
            raise RCLError(f"failed to create an endpoint of {topic}: {error}") from error
        return made

    def _added(self, entities: list[EntityType], entity: EntityType) -> EntityType:
        entities.append(entity)
        self._wake_executor()
        return entity
