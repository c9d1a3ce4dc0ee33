# SPDX-License-Identifier: Apache-2.0
"""Parameters of the radar simulator."""

from __future__ import annotations

from dataclasses import dataclass

from radar_common.parameters import Parameters, parameter
from radar_sim.digitiser import SAMPLES, VIDEO_LAWS


@dataclass(frozen=True, kw_only=True)
class SimulatorParameters(Parameters):
    """What is simulated, how it is cut into messages, and how fast."""

    scenario: str = parameter(
        "airport", "name of a scenario of the package, or path of a YAML file", read_only=True
    )
    seed: int = parameter(
        1,
        "seed of traffic, noise and fluctuation; the same seed gives the same data",
        low=0,
        read_only=True,
    )
    scans: int = parameter(
        0, "turns to simulate before the node ends; 0 never ends", low=0, read_only=True
    )
    sectors: int = parameter(32, "messages a turn", low=1, high=4096, read_only=True)
    sample: str = parameter(
        "float32",
        "type of a video sample; linear integers saturate at the scenario's full_scale",
        choices=SAMPLES,
        read_only=True,
    )
    video_law: str = parameter(
        "linear",
        "samples are the envelope, or count the scenario's db_per_count from its log_floor_db",
        choices=VIDEO_LAWS,
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
        "subscriptions to radar/sweeps to wait for before the first sector",
        low=0,
        high=1000,
        read_only=True,
    )
    wait_for_truth_subscribers: int = parameter(
        0,
        "subscriptions to truth, such as a recorder, to wait for before the first sector",
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
        "stamp of the first pulse in a bag written with --bag, since the epoch; a live node takes its clock",
        unit="s",
        low=0,
        high=2**31 - 1,
        read_only=True,
    )
