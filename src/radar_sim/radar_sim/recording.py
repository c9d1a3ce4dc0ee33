# SPDX-License-Identifier: Apache-2.0
"""Straight into a bag: a simulation as fast as the machine allows, without any transport between."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from radar_common.parameters import ParameterError
from radar_common.tables import SWEEPS_TOPIC, TRUTH_TOPIC
from radar_sim.parameters import SimulatorParameters
from radar_sim.simulator import Simulator

_SCANS_PER_REPORT = 10


class RecordingError(RuntimeError):
    """A simulation cannot be written into a bag; the text says why."""


def record(
    parameters: SimulatorParameters,
    bag: str | Path,
    *,
    storage: str = "mcap",
    report: Callable[[str], object] = lambda _: None,
) -> None:
    """Write sweeps and truth of a whole simulation; the same parameters give the same bag.

    Args:
        parameters: scenario, seed, number of scans and the rest.
        bag: folder of the new bag.
        storage: "mcap" or "sqlite3".
        report: takes a line of text now and then.

    Raises:
        ParameterError: the simulation would never end, or the scenario cannot be used.
        RecordingError: the bag cannot be written.
    """
    if not parameters.scans:
        raise ParameterError("scans must be above 0, or the bag would never end")
    try:
        from radar_common.bag import BagError, BagWriter
    except ImportError as error:
        raise RecordingError(
            f"bags need the package rosbags (pip install rosbags): {error}"
        ) from error
    simulator = Simulator.from_parameters(parameters)
    try:
        with BagWriter(bag, storage=storage) as writer:
            for number, (sweeps, truth) in enumerate(simulator, 1):
                writer.write(SWEEPS_TOPIC, sweeps)
                writer.write(TRUTH_TOPIC, truth)
                scan, rest = divmod(number, parameters.sectors)
                if rest == 0 and (scan % _SCANS_PER_REPORT == 0 or scan == parameters.scans):
                    report(f"{scan} of {parameters.scans} scans in {bag}")
    except (BagError, OSError) as error:
        raise RecordingError(str(error)) from error
