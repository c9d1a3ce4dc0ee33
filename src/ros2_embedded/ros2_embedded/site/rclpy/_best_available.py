# SPDX-License-Identifier: Apache-2.0
"""Policies that are chosen to suit the endpoints that are there."""

from __future__ import annotations

from collections.abc import Callable

from rclpy.duration import Duration
from rclpy.qos import (
    DeadlineBestAvailable,
    DurabilityPolicy,
    LivelinessPolicy,
    QoSProfile,
    ReliabilityPolicy,
)

from ros2_embedded.dds.graph import Endpoint
from ros2_embedded.dds.qos import profile_of


def resolve_best_available(
    partners: Callable[[], list[Endpoint]], dds_topic: str, profile: QoSProfile
) -> QoSProfile:
    """Replace the policies ``BEST_AVAILABLE``.

    They become the strictest ones that match all partners known now.

    Args:
        partners: Lists the endpoints on the other side.
        dds_topic: DDS name of the topic.
        profile: A profile.

    Returns:
        The same profile if it has no such policy, else a new one.
    """
    if (
        profile.reliability != ReliabilityPolicy.BEST_AVAILABLE
        and profile.durability != DurabilityPolicy.BEST_AVAILABLE
        and profile.liveliness != LivelinessPolicy.BEST_AVAILABLE
        and DeadlineBestAvailable not in (profile.deadline, profile.liveliness_lease_duration)
    ):
        return profile
    found = [profile_of(e.qos) for e in partners() if e.topic == dds_topic]
    all_reliable = all(p["reliability"] == ReliabilityPolicy.RELIABLE for p in found)
    all_local = all(p["durability"] == DurabilityPolicy.TRANSIENT_LOCAL for p in found)
    resolved = QoSProfile(
        **{slot.removeprefix("_"): getattr(profile, slot) for slot in QoSProfile.__slots__}
    )
    if profile.reliability == ReliabilityPolicy.BEST_AVAILABLE:
        resolved.reliability = (
            ReliabilityPolicy.RELIABLE if all_reliable else ReliabilityPolicy.BEST_EFFORT
        )
    if profile.durability == DurabilityPolicy.BEST_AVAILABLE:
        resolved.durability = (
            DurabilityPolicy.TRANSIENT_LOCAL if all_local else DurabilityPolicy.VOLATILE
        )
    if profile.liveliness == LivelinessPolicy.BEST_AVAILABLE:
        resolved.liveliness = LivelinessPolicy.AUTOMATIC
    if profile.deadline == DeadlineBestAvailable:
        resolved.deadline = Duration()
    if profile.liveliness_lease_duration == DeadlineBestAvailable:
        resolved.liveliness_lease_duration = Duration()
    return resolved
