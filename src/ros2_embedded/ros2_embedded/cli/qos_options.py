# SPDX-License-Identifier: Apache-2.0
"""The `--qos-...` options, and the profile they stand for."""

from __future__ import annotations

import argparse

from rclpy.duration import Duration
from rclpy.qos import (
    QoSDurabilityPolicy,
    QoSHistoryPolicy,
    QoSLivelinessPolicy,
    QoSPresetProfiles,
    QoSProfile,
    QoSReliabilityPolicy,
)
from rclpy.topic_endpoint_info import TopicEndpointInfo

_POLICIES = {
    "history": QoSHistoryPolicy,
    "reliability": QoSReliabilityPolicy,
    "durability": QoSDurabilityPolicy,
    "liveliness": QoSLivelinessPolicy,
}


def add_qos_arguments(parser: argparse.ArgumentParser, purpose: str, default: str) -> None:
    """Declare the options.

    Args:
        parser: The parser of the verb.
        purpose: "subscribe" or "publish", for the help.
        default: The short key of the preset that holds without options.
    """
    parser.add_argument(
        "--qos-profile",
        choices=QoSPresetProfiles.short_keys(),
        default=default,
        help=f"Quality of service preset profile to {purpose} with (default: {default})",
    )
    parser.add_argument(
        "--qos-depth", metavar="N", type=int, help=f"Queue size setting to {purpose} with"
    )
    for name, policy in _POLICIES.items():
        parser.add_argument(
            f"--qos-{name}",
            choices=policy.short_keys(),
            help=f"Quality of service {name} setting to {purpose} with (overrides the preset)",
        )
    parser.add_argument(
        "--qos-liveliness-lease-duration-seconds",
        type=float,
        help=f"Quality of service liveliness lease duration to {purpose} with",
    )


def has_overrides(args: argparse.Namespace) -> bool:
    """Tell whether an option asks for more than a preset.

    Args:
        args: The parsed arguments.
    """
    names = [*(f"qos_{name}" for name in _POLICIES), "qos_depth"]
    names.append("qos_liveliness_lease_duration_seconds")
    return any(getattr(args, name) is not None for name in names)


def preset(key: str) -> QoSProfile:
    """Return a copy of a preset, free to be changed.

    Args:
        key: Its short key, such as "sensor_data".
    """
    shared = QoSPresetProfiles.get_from_short_key(key)
    return QoSProfile(
        history=shared.history,
        depth=shared.depth,
        reliability=shared.reliability,
        durability=shared.durability,
        liveliness=shared.liveliness,
        liveliness_lease_duration=shared.liveliness_lease_duration,
        deadline=shared.deadline,
        lifespan=shared.lifespan,
    )


def profile_of(args: argparse.Namespace) -> QoSProfile:
    """Return the profile that the options ask for: the preset with the overrides.

    Args:
        args: The parsed arguments.
    """
    profile = preset(args.qos_profile)
    for name, policy in _POLICIES.items():
        value = getattr(args, f"qos_{name}")
        if value is not None:
            setattr(profile, name, policy.get_from_short_key(value))
    lease = args.qos_liveliness_lease_duration_seconds
    if lease is not None and lease >= 0:
        profile.liveliness_lease_duration = Duration(seconds=lease)
    if args.qos_depth is not None and args.qos_depth >= 0:
        profile.depth = args.qos_depth
    elif profile.durability == QoSDurabilityPolicy.TRANSIENT_LOCAL and profile.depth == 0:
        profile.depth = 1
    return profile


def adapt_to_offers(
    profile: QoSProfile, publishers: list[TopicEndpointInfo], topic: str
) -> list[str]:
    """Ask for the most that every publisher offers, so that the subscription matches them all.

    Args:
        profile: The profile to subscribe with; reliability and durability are set in it.
        publishers: The publishers of the topic; without any the profile stays as it is.
        topic: The topic's name, for the warnings.

    Returns:
        A warning for each policy on which the publishers disagree.
    """
    if not publishers:
        return []
    warnings = []
    for name, strong, weak in (
        ("reliability", QoSReliabilityPolicy.RELIABLE, QoSReliabilityPolicy.BEST_EFFORT),
        ("durability", QoSDurabilityPolicy.TRANSIENT_LOCAL, QoSDurabilityPolicy.VOLATILE),
    ):
        strong_ones = sum(getattr(info.qos_profile, name) == strong for info in publishers)
        setattr(profile, name, strong if strong_ones == len(publishers) else weak)
        if 0 < strong_ones < len(publishers):
            warnings.append(
                f"Some, but not all, publishers of '{topic}' are offering {strong}. "
                f"Falling back to {weak} as it will connect to all publishers"
            )
    return warnings
