# SPDX-License-Identifier: Apache-2.0
"""Bearings straight into a bag, as fast as the machine allows."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from radar_common.odometry import PlatformState
from radar_common.parameters import ParameterError
from radar_common.tables import NANOSECONDS
from radar_sim.bearings.parameters import BearingSimulatorParameters
from radar_sim.bearings.simulator import BearingSimulator
from radar_sim.recording import RecordingError


def record_bearings(
    parameters: BearingSimulatorParameters,
    bag: str | Path,
    *,
    storage: str = "mcap",
    report: Callable[[str], object] = lambda _: None,
) -> None:
    """Write all messages of a whole simulation; the same parameters give the same bag.

    Args:
        parameters: scenario, seed, duration and the rest.
        bag: folder of the new bag.
        storage: "mcap" or "sqlite3".
        report: takes a line of text at the end.

    Raises:
        ParameterError: the simulation would never end, or the scenario cannot be used.
        RecordingError: the bag cannot be written.
    """
    if not parameters.duration:
        raise ParameterError("duration must be above 0, or the bag would never end")
    try:
        from radar_common.bag import BagError, BagWriter
    except ImportError as error:
        raise RecordingError(
            f"bags need the package rosbags (pip install rosbags): {error}"
        ) from error
    simulator, written = BearingSimulator.from_parameters(parameters), 0
    try:
        with BagWriter(bag, storage=storage) as writer:
            for due, topic, content in simulator:
                written += 1
                log_time = simulator.start + round(due * NANOSECONDS)
                if isinstance(content, PlatformState):
                    writer.write_odometry(topic, content, log_time=log_time)
                else:
                    writer.write(topic, content, log_time=log_time)
        report(f"{written} messages of {parameters.duration:g} s in {bag}")
    except (BagError, OSError) as error:
        raise RecordingError(str(error)) from error
