# SPDX-License-Identifier: Apache-2.0
"""Quality of service of every topic, in one place.

Each can be changed from outside with the standard parameters, for example
`qos_overrides./radar/sweeps.subscription.reliability: reliable`.
"""

from __future__ import annotations

from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy
from rclpy.qos_overriding_options import QoSOverridingOptions

OVERRIDABLE = QoSOverridingOptions.with_default_policies()

# Two turns of 32 sectors: what a scan produces must outlast one slow callback.
_DEPTH = 64

SWEEPS_IN = QoSProfile(
    history=HistoryPolicy.KEEP_LAST,
    depth=_DEPTH,
    # Best effort matches every digitiser's driver; a recording is replayed with the override above.
    reliability=ReliabilityPolicy.BEST_EFFORT,
)

TABLES = QoSProfile(
    history=HistoryPolicy.KEEP_LAST,
    depth=4 * _DEPTH,
    reliability=ReliabilityPolicy.RELIABLE,
)

SWEEPS_OUT = QoSProfile(
    history=HistoryPolicy.KEEP_LAST,
    depth=_DEPTH,
    # A reliable writer serves best-effort and reliable readers alike.
    reliability=ReliabilityPolicy.RELIABLE,
)

LATCHED = QoSProfile(
    history=HistoryPolicy.KEEP_LAST,
    depth=1,
    reliability=ReliabilityPolicy.RELIABLE,
    durability=DurabilityPolicy.TRANSIENT_LOCAL,
)
