# SPDX-License-Identifier: Apache-2.0
"""Cyclone DDS configuration from the environment variables of ROS 2.

Off loopback Cyclone's defaults are kept. On loopback, with the defaults, images of some
megabytes get lost under load: fragments are small and the sender overruns the receiver's
socket buffer, which the kernel limits. ``_LOSS_FREE`` makes fragments as large as a
datagram may be and repairs what is lost at once.
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from xml.sax.saxutils import quoteattr

_LOSS_FREE_GENERAL = "<MaxMessageSize>65500B</MaxMessageSize><FragmentSize>16000B</FragmentSize>"
# `max` takes what the kernel gives; `min` would fail where it gives less.
_LOSS_FREE_INTERNAL = (
    '<Internal><SocketReceiveBufferSize max="16MB"/><NackDelay>1ms</NackDelay>'
    "<AutoReschedNackDelay>10ms</AutoReschedNackDelay>"
    "<MaxQueuedRexmitBytes>64MB</MaxQueuedRexmitBytes>"
    "<MaxQueuedRexmitMessages>2000</MaxQueuedRexmitMessages></Internal>"
)
_LOOPBACK = '<Interfaces><NetworkInterface name="lo"/></Interfaces>'
#: Participants on this host that find each other without multicast.
_MAX_PARTICIPANT_INDEX = 99

RANGES = ("LOCALHOST", "SUBNET", "OFF", "SYSTEM_DEFAULT")


def domain_configuration(environment: Mapping[str, str] = os.environ) -> str:
    """Make the configuration of a DDS domain.

    ``CYCLONEDDS_URI`` replaces all defaults; a discovery range or static peers asked for
    by the ROS variables are still obeyed, unless it sets the same options.

    Args:
        environment: Environment variables: ``ROS_AUTOMATIC_DISCOVERY_RANGE`` (by default
            ``LOCALHOST``), ``ROS_STATIC_PEERS`` (separated by semicolons),
            ``ROS_LOCALHOST_ONLY`` and ``CYCLONEDDS_URI``.

    Returns:
        XML and references to files, separated by commas; later ones win.

    Raises:
        ValueError: The discovery range is none of the known ones.
    """
    asked = environment.get("ROS_AUTOMATIC_DISCOVERY_RANGE", "")
    peers = [peer for peer in environment.get("ROS_STATIC_PEERS", "").split(";") if peer]
    if environment.get("ROS_LOCALHOST_ONLY") == "1":
        asked, peers = "LOCALHOST", []
    if asked and asked not in RANGES:
        raise ValueError(
            f"ROS_AUTOMATIC_DISCOVERY_RANGE is {asked!r}, must be one of {', '.join(RANGES)}"
        )
    uri = environment.get("CYCLONEDDS_URI", "")
    if uri and not asked and not peers:
        return uri
    own = _fragment(asked or "LOCALHOST", peers, loss_free=not uri)
    return ",".join(part for part in (own, uri) if part)


def _fragment(discovery_range: str, peers: list[str], loss_free: bool) -> str:
    if discovery_range == "SYSTEM_DEFAULT":
        return ""
    general, internal = "", ""
    if discovery_range == "SUBNET":
        discovery = _peers(peers)
    elif discovery_range == "OFF":
        general = "<AllowMulticast>false</AllowMulticast>"
        # Nobody has this tag, so nobody is discovered.
        discovery = (
            f"<ParticipantIndex>none</ParticipantIndex><Tag>ros_discovery_off_{os.getpid()}</Tag>"
        )
    else:
        general = "<AllowMulticast>false</AllowMulticast>"
        discovery = (
            "<ParticipantIndex>auto</ParticipantIndex>"
            f"<MaxAutoParticipantIndex>{_MAX_PARTICIPANT_INDEX}</MaxAutoParticipantIndex>"
        ) + _peers(["127.0.0.1", *peers])
    # A static peer may be on another host, which the loopback interface does not reach.
    if discovery_range != "SUBNET" and loss_free and not peers:
        general = _LOOPBACK + general + _LOSS_FREE_GENERAL
        internal = _LOSS_FREE_INTERNAL
    return (
        f"<CycloneDDS><Domain><General>{general}</General>"
        f"<Discovery>{discovery}</Discovery>{internal}</Domain></CycloneDDS>"
    )


def _peers(addresses: list[str]) -> str:
    if not addresses:
        return ""
    return f"<Peers>{''.join(f'<Peer address={quoteattr(a)}/>' for a in addresses)}</Peers>"
