# SPDX-License-Identifier: Apache-2.0
"""Parameters of the bearing simulator."""

from __future__ import annotations

from dataclasses import dataclass

from radar_common.parameters import Parameters, parameter


@dataclass(frozen=True, kw_only=True)
class BearingSimulatorParameters(Parameters):
    """What is simulated, for how long, and how fast."""

    scenario: str = parameter(
        "direction_finder",
        "name of a scenario of the package, or path of a YAML file",
        read_only=True,
    )
    seed: int = parameter(
        1,
        "seed of everything random; the same seed gives the same data, and the targets of a radar_simulator with it",
        low=0,
        read_only=True,
    )
    duration: float = parameter(
        0.0,
        "simulated time after which the node ends; 0 never ends",
        unit="s",
        low=0.0,
        high=1e7,
        read_only=True,
    )
    active: bool = parameter(
        True,
        "whether the scenario's active channel is published as plots; false beside a radar that makes its own",
        read_only=True,
    )
    rate: float = parameter(
        1.0,
        "seconds simulated in a second of the node's clock; 0 is as fast as possible",
        low=0.0,
        high=1e4,
        read_only=True,
    )
    wait_for_subscribers: int = parameter(
        0,
        "subscriptions to passive/bearings, or to radar/plots without a direction finder, to wait for",
        low=0,
        high=1000,
        read_only=True,
    )
    wait_for_truth_subscribers: int = parameter(
        0,
        "subscriptions to truth/channels, such as a recorder, to wait for before the first look",
        low=0,
        high=1000,
        read_only=True,
    )
    begin_at: int = parameter(
        0,
        "clock at which simulated time is zero, alike for nodes that share targets; 0 begins at once",
        unit="s",
        low=0,
        high=2**31 - 1,
        read_only=True,
    )
    start_time: int = parameter(
        1_700_000_000,
        "stamp of the first look in a bag written with --bag, since the epoch; a live node takes its clock",
        unit="s",
        low=0,
        high=2**31 - 1,
        read_only=True,
    )
