# SPDX-License-Identifier: Apache-2.0
"""Quality of service between rclpy's profiles and what a bag keeps of them."""

from __future__ import annotations

from collections.abc import Sequence

from rclpy.duration import Duration
from rclpy.qos import (
    QoSDurabilityPolicy,
    QoSHistoryPolicy,
    QoSLivelinessPolicy,
    QoSProfile,
    QoSReliabilityPolicy,
)
from rosbags.interfaces import (
    Qos,
    QosDurability,
    QosHistory,
    QosLiveliness,
    QosReliability,
    QosTime,
)

# History is no part of matching. A recorder or player handles bursts of all topics in one
# thread, so it keeps more than the usual 10 messages before it loses one.
DEPTH = 100


def to_bag(profile: QoSProfile) -> Qos:
    """Return a profile as a bag keeps it.

    Args:
        profile: The profile that a publisher offers.
    """
    return Qos(
        history=QosHistory(int(profile.history)),
        depth=profile.depth,
        reliability=QosReliability(int(profile.reliability)),
        durability=QosDurability(int(profile.durability)),
        deadline=_to_time(profile.deadline),
        lifespan=_to_time(profile.lifespan),
        liveliness=QosLiveliness(int(profile.liveliness)),
        liveliness_lease_duration=_to_time(profile.liveliness_lease_duration),
        avoid_ros_namespace_conventions=profile.avoid_ros_namespace_conventions,
    )


def offer_of(recorded: Sequence[Qos]) -> tuple[QoSProfile, bool]:
    """Return the profile to play a topic with.

    Args:
        recorded: What the publishers offered when the topic was recorded.

    Returns:
        The profile, and whether the publishers agreed. If they did not, the profile is the
        default one.
    """
    if not recorded or any(not _same_matching(recorded[0], other) for other in recorded):
        return QoSProfile(depth=DEPTH), not recorded
    first = recorded[0]
    transient = first.durability is QosDurability.TRANSIENT_LOCAL
    known = first.history is QosHistory.KEEP_LAST and first.depth > 0
    # A late subscriber to a transient topic must get as many messages as it got live.
    depth = (first.depth if known else 10) if transient else max(first.depth, DEPTH)
    profile = QoSProfile(
        history=QoSHistoryPolicy.KEEP_LAST,
        depth=depth,
        reliability=_reliability(first.reliability),
        durability=(
            QoSDurabilityPolicy.TRANSIENT_LOCAL if transient else QoSDurabilityPolicy.VOLATILE
        ),
        deadline=_to_duration(first.deadline),
        lifespan=_to_duration(first.lifespan),
        liveliness=_liveliness(first.liveliness),
        liveliness_lease_duration=_to_duration(first.liveliness_lease_duration),
    )
    return profile, True


def _same_matching(first: Qos, other: Qos) -> bool:
    """Tell whether two offers are alike in every policy that decides on a match."""
    return (
        first.reliability is other.reliability
        and first.durability is other.durability
        and first.deadline == other.deadline
        and first.liveliness is other.liveliness
        and first.liveliness_lease_duration == other.liveliness_lease_duration
    )


def _reliability(recorded: QosReliability) -> QoSReliabilityPolicy:
    if recorded is QosReliability.BEST_EFFORT:
        return QoSReliabilityPolicy.BEST_EFFORT
    return QoSReliabilityPolicy.RELIABLE


def _liveliness(recorded: QosLiveliness) -> QoSLivelinessPolicy:
    if recorded is QosLiveliness.MANUAL_BY_TOPIC:
        return QoSLivelinessPolicy.MANUAL_BY_TOPIC
    return QoSLivelinessPolicy.AUTOMATIC


def _to_time(duration: Duration) -> QosTime:
    return QosTime(*divmod(duration.nanoseconds, 1_000_000_000))


def _to_duration(recorded: QosTime) -> Duration:
    # Some writers keep "infinite" as the largest numbers of both fields, which overflow.
    nanoseconds = recorded.sec * 1_000_000_000 + recorded.nsec
    return Duration(nanoseconds=min(nanoseconds, 2**63 - 1))
