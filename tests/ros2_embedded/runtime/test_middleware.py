# SPDX-License-Identifier: Apache-2.0
"""The mapping to DDS: quality of service, discovery, configuration."""

from __future__ import annotations

import os
import subprocess
import sys
import time

import pytest
from cyclonedds.core import Policy
from rclpy.duration import Duration
from rclpy.qos import (
    DurabilityPolicy,
    HistoryPolicy,
    LivelinessPolicy,
    QoSProfile,
    ReliabilityPolicy,
)

from ros2_embedded.dds.configuration import domain_configuration
from ros2_embedded.dds.graph import Graph
from ros2_embedded.dds.participant import Participant
from ros2_embedded.dds.qos import endpoint_qos, profile_of, user_data_of

DOMAIN = 1 + os.getpid() % 100


def test_default_quality_of_service():
    qos = endpoint_qos(QoSProfile(depth=5), "typehash=RIHS01_00;")
    assert Policy.History.KeepLast(5) in qos
    assert Policy.Reliability.Reliable(2**63 - 1) in qos
    assert Policy.Durability.Volatile in qos
    assert Policy.WriterDataLifecycle(autodispose=False) in qos
    assert user_data_of(qos) == {"typehash": "RIHS01_00"}


@pytest.mark.parametrize(
    "profile",
    [
        QoSProfile(depth=1),
        QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT),
        QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL),
        QoSProfile(history=HistoryPolicy.KEEP_ALL, liveliness=LivelinessPolicy.MANUAL_BY_TOPIC),
        QoSProfile(
            depth=1,
            deadline=Duration(seconds=1),
            lifespan=Duration(seconds=2),
            liveliness_lease_duration=Duration(seconds=3),
        ),
    ],
)
def test_quality_of_service_reads_back(profile):
    policies = profile_of(endpoint_qos(profile, ""))
    assert policies["reliability"] == profile.reliability
    assert policies["durability"] == profile.durability
    manual = profile.liveliness == LivelinessPolicy.MANUAL_BY_TOPIC
    assert policies["liveliness"] == (3 if manual else 1)
    for name in ("deadline", "lifespan", "liveliness_lease_duration"):
        assert policies[name] == (getattr(profile, name).nanoseconds or 2**63 - 1)


def test_latched_history_is_kept_for_late_readers():
    profile = QoSProfile(depth=7, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    (service,) = [p for p in endpoint_qos(profile, "") if p.__scope__ == "DurabilityService"]
    assert service.history == Policy.History.KeepLast(7)


def test_depth_zero_means_the_default():
    with pytest.warns(UserWarning, match="zero depth"):
        profile = QoSProfile(depth=0)
    assert Policy.History.KeepLast(1) in endpoint_qos(profile, "")


def test_configuration_is_loopback_by_default():
    text = domain_configuration({})
    assert '<NetworkInterface name="lo"/>' in text
    assert '<Peer address="127.0.0.1"/>' in text
    assert "<AllowMulticast>false</AllowMulticast>" in text
    assert "FragmentSize" in text


def test_configuration_of_the_user_wins():
    assert domain_configuration({"CYCLONEDDS_URI": "file:///dds.xml"}) == "file:///dds.xml"
    both = domain_configuration(
        {"CYCLONEDDS_URI": "file:///dds.xml", "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}
    )
    assert both.endswith(",file:///dds.xml")
    assert "NetworkInterface" not in both


def test_ranges_of_discovery():
    def configuration(value, **more):
        return domain_configuration({"ROS_AUTOMATIC_DISCOVERY_RANGE": value, **more})

    assert "AllowMulticast" not in configuration("SUBNET")
    assert '"lo"' not in configuration("SUBNET")
    assert "<Tag>" in configuration("OFF")
    assert configuration("SYSTEM_DEFAULT") == ""
    assert '"lo"' in configuration("SUBNET", ROS_LOCALHOST_ONLY="1")
    with pytest.raises(ValueError, match="SUBNET"):
        configuration("EVERYWHERE")


def test_static_peers():
    text = domain_configuration({"ROS_STATIC_PEERS": "radar.local;10.0.0.2"})
    for address in ("127.0.0.1", "radar.local", "10.0.0.2"):
        assert f'<Peer address="{address}"/>' in text
    assert '"lo"' not in text


def see(environment):
    """Look from another process for the node that `graph` announces."""
    source = """
import time, rclpy
from rclpy.node import Node
rclpy.init(args=[])
node = Node("seeker")
print(node.wait_for_node("/announced", timeout=float(TIMEOUT)))
""".replace("TIMEOUT", environment.pop("TIMEOUT"))
    result = subprocess.run(
        [sys.executable, "-c", source],
        capture_output=True,
        text=True,
        timeout=60,
        env={**os.environ, "ROS_DOMAIN_ID": str(DOMAIN), **environment},
        check=True,
    )
    return result.stdout.strip() == "True"


@pytest.fixture
def announced():
    """A node in this process."""
    participant = Participant(DOMAIN)
    graph = Graph(participant)
    graph.add_node(("/", "announced"))
    yield graph
    participant.close()


def test_processes_see_each_other_by_default(announced):
    assert see({"TIMEOUT": "20"})


def test_discovery_can_be_switched_off(announced):
    assert not see({"TIMEOUT": "1", "ROS_AUTOMATIC_DISCOVERY_RANGE": "OFF"})


def test_node_goes_when_its_process_ends(announced):
    assert see({"TIMEOUT": "20"})
    give_up = time.monotonic() + 5.0  # A lease would take ten seconds to run out.
    while any(node == ("/", "seeker") for node, _ in announced.nodes()):
        assert time.monotonic() < give_up, "the node of a process that ended is still there"


def test_participants_share_a_domain():
    first, second = Participant(DOMAIN), Participant(DOMAIN)
    first.close()
    first.close()
    graph = Graph(second)
    assert graph.nodes() == []
    second.close()
    Participant(DOMAIN).close()
