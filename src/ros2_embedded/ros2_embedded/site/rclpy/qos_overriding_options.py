# SPDX-License-Identifier: Apache-2.0
"""Quality of service that parameters can change."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any

from rcl_interfaces.msg import ParameterDescriptor, SetParametersResult
from rclpy.duration import Duration
from rclpy.exceptions import ParameterAlreadyDeclaredException
from rclpy.qos import (
    DurabilityPolicy,
    HistoryPolicy,
    LivelinessPolicy,
    QoSPolicyKind,
    QoSProfile,
    ReliabilityPolicy,
)

if TYPE_CHECKING:
    from rclpy._node_parameters import NodeParameters

QosCallbackResult = SetParametersResult
QosCallbackType = Callable[[QoSProfile], SetParametersResult]

_ENUMERATIONS: dict[QoSPolicyKind, Any] = {
    QoSPolicyKind.HISTORY: HistoryPolicy,
    QoSPolicyKind.RELIABILITY: ReliabilityPolicy,
    QoSPolicyKind.DURABILITY: DurabilityPolicy,
    QoSPolicyKind.LIVELINESS: LivelinessPolicy,
}
_DURATIONS = (
    QoSPolicyKind.DEADLINE,
    QoSPolicyKind.LIFESPAN,
    QoSPolicyKind.LIVELINESS_LEASE_DURATION,
)


class InvalidQosOverridesError(Exception):
    """A callback refused the quality of service that parameters asked for."""


class QoSOverridingOptions:
    """Which policies of an endpoint parameters can change."""

    def __init__(
        self,
        policy_kinds: Iterable[QoSPolicyKind],
        *,
        callback: QosCallbackType | None = None,
        entity_id: str | None = None,
    ) -> None:
        """Choose policies.

        Args:
            policy_kinds: The policies.
            callback: Checks the profile that results.
            entity_id: Tells apart several endpoints on the same topic.
        """
        self._policy_kinds = policy_kinds
        self._callback = callback
        self._entity_id = entity_id

    @property
    def policy_kinds(self) -> Iterable[QoSPolicyKind]:
        """The policies."""
        return self._policy_kinds

    @property
    def callback(self) -> QosCallbackType | None:
        """What checks the profile that results."""
        return self._callback

    @property
    def entity_id(self) -> str | None:
        """What tells apart several endpoints on the same topic."""
        return self._entity_id

    @classmethod
    def with_default_policies(
        cls, *, callback: QosCallbackType | None = None, entity_id: str | None = None
    ) -> QoSOverridingOptions:
        """Choose history, depth and reliability.

        Args:
            callback: Checks the profile that results.
            entity_id: Tells apart several endpoints on the same topic.

        Returns:
            The options.
        """
        kinds = (QoSPolicyKind.HISTORY, QoSPolicyKind.DEPTH, QoSPolicyKind.RELIABILITY)
        return cls(kinds, callback=callback, entity_id=entity_id)


def override_qos(
    entity: str,
    node: NodeParameters,
    topic: str,
    qos: QoSProfile,
    options: QoSOverridingOptions,
) -> None:
    """Declare the parameters of an endpoint and apply them to its profile.

    Args:
        entity: ``publisher`` or ``subscription``.
        node: Node of the endpoint.
        topic: Full name of the topic.
        qos: Profile to change.
        options: Which policies can be changed.

    Raises:
        RuntimeError: A parameter has a value that its policy does not have.
        InvalidQosOverridesError: The callback of the options refused the profile.
    """
    suffix = "" if options.entity_id is None else f"_{options.entity_id}"
    for kind in options.policy_kinds:
        if kind == QoSPolicyKind.LIFESPAN and entity == "subscription":
            continue
        policy = kind.name.lower()
        name = f"qos_overrides.{topic}.{entity}{suffix}.{policy}"
        descriptor = ParameterDescriptor(
            description=f"{policy} for {entity} `{topic}` with id `{options.entity_id}`",
            read_only=True,
        )
        try:
            parameter = node.declare_parameter(name, _to_parameter(kind, qos), descriptor)
        except ParameterAlreadyDeclaredException:
            parameter = node.get_parameter(name)
        setattr(qos, policy, _from_parameter(kind, parameter.value))
    if options.callback is not None:
        result = options.callback(qos)
        if not result.successful:
            raise InvalidQosOverridesError(
                f"Provided QoS overrides for {entity} `{topic}` with id "
                f"`{options.entity_id}`, are not valid: {result.reason}"
            )


def _to_parameter(kind: QoSPolicyKind, qos: QoSProfile) -> str | int | bool:
    value = getattr(qos, kind.name.lower())
    if kind in _ENUMERATIONS:
        if value.name == "UNKNOWN":
            raise ValueError("User provided QoS profile is invalid")
        return str(value.name.lower())
    return int(value.nanoseconds) if kind in _DURATIONS else value


def _from_parameter(kind: QoSPolicyKind, value: Any) -> Any:
    if kind in _ENUMERATIONS:
        try:
            return _ENUMERATIONS[kind][value.upper()]
        except KeyError:
            raise RuntimeError(
                f"Unexpected QoS override for policy `{kind.name.lower()}`: `{value}`"
            ) from None
    return Duration(nanoseconds=value) if kind in _DURATIONS else value
