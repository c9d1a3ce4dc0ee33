# SPDX-License-Identifier: Apache-2.0
"""Quality of service asked for by the recorder, kept in the bag and offered by the player."""

from __future__ import annotations

import pytest
from rclpy.duration import Duration
from rclpy.qos import DurabilityPolicy, LivelinessPolicy, QoSProfile, ReliabilityPolicy
from rclpy.topic_endpoint_info import TopicEndpointInfo

from ros2_embedded.cli.bag.qos import DEPTH, offer_of, to_bag
from ros2_embedded.cli.qos_options import adapt_to_offers

STRONG = QoSProfile(depth=7, durability=DurabilityPolicy.TRANSIENT_LOCAL)
WEAK = QoSProfile(depth=7, reliability=ReliabilityPolicy.BEST_EFFORT)


@pytest.mark.parametrize(
    ("offers", "reliability", "durability", "warnings"),
    [
        ([STRONG, STRONG], "RELIABLE", "TRANSIENT_LOCAL", 0),
        ([WEAK], "BEST_EFFORT", "VOLATILE", 0),
        ([STRONG, WEAK], "BEST_EFFORT", "VOLATILE", 2),
        ([], "RELIABLE", "VOLATILE", 0),
    ],
)
def test_as_much_is_asked_as_every_publisher_offers(offers, reliability, durability, warnings):
    profile = QoSProfile(depth=10)
    publishers = [TopicEndpointInfo(qos_profile=offer) for offer in offers]
    assert len(adapt_to_offers(profile, publishers, "/topic")) == warnings
    assert (profile.reliability.name, profile.durability.name) == (reliability, durability)


def test_a_profile_comes_back_from_the_bag():
    profile = QoSProfile(
        depth=7,
        durability=DurabilityPolicy.TRANSIENT_LOCAL,
        deadline=Duration(seconds=1, nanoseconds=5),
        liveliness=LivelinessPolicy.MANUAL_BY_TOPIC,
        liveliness_lease_duration=Duration(seconds=2**33),
    )
    again, agreed = offer_of([to_bag(profile)])
    assert agreed
    assert again == profile


def test_a_volatile_topic_is_played_with_room_for_bursts():
    profile, _ = offer_of([to_bag(WEAK)])
    assert profile.depth == DEPTH
    assert profile.reliability == ReliabilityPolicy.BEST_EFFORT


def test_publishers_that_disagreed_give_the_default():
    profile, agreed = offer_of([to_bag(STRONG), to_bag(WEAK)])
    assert not agreed
    assert profile == QoSProfile(depth=DEPTH)


def test_a_bag_without_profiles_is_no_disagreement():
    assert offer_of([]) == (QoSProfile(depth=DEPTH), True)
