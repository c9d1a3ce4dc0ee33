# SPDX-License-Identifier: Apache-2.0
"""A simulation written straight into a bag."""

from __future__ import annotations

import sys

import pytest

from radar_common.bag import read_tables, topics
from radar_common.parameters import ParameterError
from radar_common.tables import SWEEPS_TOPIC, TRUTH, TRUTH_TOPIC
from radar_sim.parameters import SimulatorParameters
from radar_sim.recording import RecordingError, record
from radar_sim.simulator import Simulator

PARAMETERS = SimulatorParameters(scenario="tiny", scans=2, sectors=8, seed=4)


@pytest.mark.parametrize("storage", ["mcap", "sqlite3"])
def test_the_bag_holds_the_simulation(tmp_path, storage):
    bag, lines = tmp_path / "bag", []
    record(PARAMETERS, bag, storage=storage, report=lines.append)
    assert topics(bag) == {SWEEPS_TOPIC: 16, TRUTH_TOPIC: 16}
    assert lines == [f"2 of 2 scans in {bag}"]
    expected = {SWEEPS_TOPIC: None, TRUTH_TOPIC: TRUTH}
    written = {topic: [] for topic in expected}
    for topic, table in read_tables(bag, expected):
        written[topic].append(table)
    made = list(Simulator.from_parameters(PARAMETERS))
    for topic, part in ((SWEEPS_TOPIC, 0), (TRUTH_TOPIC, 1)):
        for table, sector in zip(written[topic], made, strict=True):
            assert table.stamp == sector[part].stamp
            assert table.rows.tobytes() == sector[part].rows.tobytes()
            assert table.frame_id == sector[part].frame_id


def test_the_same_parameters_give_the_same_bag(tmp_path):
    for name in ("one", "two"):
        (tmp_path / name).mkdir()
        record(PARAMETERS, tmp_path / name / "bag")
    first, second = ((tmp_path / name / "bag" / "bag.mcap").read_bytes() for name in ("one", "two"))
    assert first == second


def test_an_endless_simulation_is_not_written(tmp_path):
    with pytest.raises(ParameterError, match="scans"):
        record(PARAMETERS.changed({"scans": 0}), tmp_path / "bag")
    assert not (tmp_path / "bag").exists()


def test_an_existing_folder_is_not_touched(tmp_path):
    with pytest.raises(RecordingError, match="exists"):
        record(PARAMETERS, tmp_path)
    assert not any(tmp_path.iterdir())


def test_without_rosbags_the_reason_is_given(tmp_path, monkeypatch):
    # None in sys.modules makes the import fail as if the package were absent.
    monkeypatch.setitem(sys.modules, "radar_common.bag", None)
    with pytest.raises(RecordingError, match="pip install rosbags"):
        record(PARAMETERS, tmp_path / "bag")
