# SPDX-License-Identifier: Apache-2.0
"""Whether a publisher and a subscription can talk."""

from __future__ import annotations

from enum import IntEnum
from typing import TYPE_CHECKING

from rclpy._qos_policies import DurabilityPolicy, LivelinessPolicy, ReliabilityPolicy
from rclpy.duration import Duration

if TYPE_CHECKING:
    from rclpy.qos import QoSProfile

_UNSPECIFIED = Duration()


class QoSCompatibility(IntEnum):
    """Whether a publisher and a subscription can talk."""

    OK = 0
    WARNING = 1
    ERROR = 2


def qos_check_compatible(
    publisher_qos: QoSProfile, subscription_qos: QoSProfile
) -> tuple[QoSCompatibility, str]:
    """Tell whether a publisher can serve a subscription.

    Args:
        publisher_qos: What the publisher offers.
        subscription_qos: What the subscription asks for.

    Returns:
        The answer, and the reason if it is not ``OK``.
    """
    offered, asked = publisher_qos, subscription_qos
    problems = []
    if (offered.reliability, asked.reliability) == (
        ReliabilityPolicy.BEST_EFFORT,
        ReliabilityPolicy.RELIABLE,
    ):
        problems.append("ERROR: Best effort publisher and reliable subscription;")
    if (offered.durability, asked.durability) == (
        DurabilityPolicy.VOLATILE,
        DurabilityPolicy.TRANSIENT_LOCAL,
    ):
        problems.append("ERROR: Volatile publisher and transient local subscription;")
    if asked.deadline != _UNSPECIFIED and (
        offered.deadline == _UNSPECIFIED or offered.deadline > asked.deadline
    ):
        problems.append("ERROR: Subscription expects a deadline that the publisher does not keep;")
    if asked.liveliness == LivelinessPolicy.MANUAL_BY_TOPIC != offered.liveliness:
        problems.append("ERROR: Publisher's liveliness is not manual by topic;")
    if asked.liveliness_lease_duration != _UNSPECIFIED and (
        offered.liveliness_lease_duration == _UNSPECIFIED
        or offered.liveliness_lease_duration > asked.liveliness_lease_duration
    ):
        problems.append("ERROR: Publisher's liveliness lease duration is too long;")
    if problems:
        return QoSCompatibility.ERROR, "".join(problems)
    undecided = [
        policy.name
        for profile in (offered, asked)
        for policy in (profile.reliability, profile.durability)
        if policy in (0, 3, 4)
    ]
    if undecided:
        return QoSCompatibility.WARNING, "WARNING: policies are left to the middleware;"
    return QoSCompatibility.OK, ""
