# SPDX-License-Identifier: Apache-2.0
"""Bags hold tables exactly, in both storages, and broken ones say so in one sentence."""

from __future__ import annotations

import numpy as np
import pytest

from radar_common.bag import STORAGES, BagError, BagWriter, read_tables, topics
from radar_common.health import Health
from radar_common.tables import PLOT, PLOTS_TOPIC, TRUTH, TRUTH_TOPIC, Table


def plots(count, stamp):
    rows = np.zeros(count, PLOT)
    rows["range"] = np.arange(count) * 1e3
    rows["time_offset"] = np.linspace(0.0, 0.1, count)
    return Table(stamp, rows, "radar")


@pytest.mark.parametrize("storage", STORAGES)
def test_what_is_written_is_read(tmp_path, storage):
    path = tmp_path / "bag"
    written = [plots(3, 10**9), plots(0, 2 * 10**9), plots(2, 3 * 10**9)]
    with BagWriter(path, storage=storage) as bag:
        for table in written:
            bag.write(PLOTS_TOPIC, table)
        bag.write(TRUTH_TOPIC, Table(0, np.zeros(1, TRUTH), "map"))
    assert topics(path) == {PLOTS_TOPIC: 3, TRUTH_TOPIC: 1}
    read = list(read_tables(path, {PLOTS_TOPIC: PLOT}))
    assert [topic for topic, _ in read] == [PLOTS_TOPIC] * 3
    for (_, back), table in zip(read, written, strict=True):
        assert (back.stamp, back.frame_id) == (table.stamp, table.frame_id)
        assert back.rows.tobytes() == table.rows.tobytes()


def test_messages_come_back_in_order_of_their_latest_row(tmp_path):
    with BagWriter(tmp_path / "bag") as bag:
        bag.write("late", Table(0, plots(2, 0).rows))
        bag.write("early", Table(0, plots(1, 0).rows))
    order = [topic for topic, _ in read_tables(tmp_path / "bag", {"late": None, "early": None})]
    assert order == ["early", "late"]


def test_messages_of_a_topic_come_back_in_the_order_of_writing(tmp_path):
    ahead, behind = plots(1, 10**9), plots(1, 10**9 + 5 * 10**7)
    ahead.rows["time_offset"], behind.rows["time_offset"] = 0.06, -0.01
    with BagWriter(tmp_path / "bag") as bag:
        bag.write(PLOTS_TOPIC, ahead)
        bag.write(PLOTS_TOPIC, behind)
    read = [t.stamp for _, t in read_tables(tmp_path / "bag", {PLOTS_TOPIC: PLOT})]
    assert read == [ahead.stamp, behind.stamp]


def test_a_topic_with_another_table_is_dropped_and_counted(tmp_path):
    with BagWriter(tmp_path / "bag") as bag:
        bag.write(PLOTS_TOPIC, Table(0, np.zeros(1, [("azimuth", "<f4"), ("time_offset", "<f8")])))
        bag.write(PLOTS_TOPIC, plots(1, 1))
    health = Health()
    assert len(list(read_tables(tmp_path / "bag", {PLOTS_TOPIC: PLOT}, health))) == 1
    assert sum(health.dropped.values()) == 1


def test_a_bag_without_the_topic_is_empty(tmp_path):
    with BagWriter(tmp_path / "bag") as bag:
        bag.write(PLOTS_TOPIC, plots(1, 0))
    assert list(read_tables(tmp_path / "bag", {"radar/sweeps": None})) == []


def test_an_existing_bag_is_not_overwritten(tmp_path):
    (tmp_path / "bag").mkdir()
    with pytest.raises(BagError, match="exists"):
        BagWriter(tmp_path / "bag")


def test_an_unknown_storage_is_refused(tmp_path):
    with pytest.raises(BagError, match="sqlite3, mcap"):
        BagWriter(tmp_path / "bag", storage="tape")


@pytest.mark.parametrize("storage", STORAGES)
def test_a_truncated_bag_says_so(tmp_path, storage):
    path = tmp_path / "bag"
    with BagWriter(path, storage=storage) as bag:
        for second in range(40):
            bag.write(PLOTS_TOPIC, plots(200, second * 10**9))
    (file,) = (p for p in path.iterdir() if p.name != "metadata.yaml")
    file.write_bytes(file.read_bytes()[: file.stat().st_size // 2])
    with pytest.raises(BagError, match="bag"):
        list(read_tables(path, {PLOTS_TOPIC: PLOT}))


def test_a_missing_bag_says_so(tmp_path):
    with pytest.raises(BagError, match="nowhere"):
        topics(tmp_path / "nowhere")


def test_an_error_while_writing_leaves_a_readable_bag(tmp_path):
    def fail_half_way():
        with BagWriter(tmp_path / "bag") as bag:
            bag.write(PLOTS_TOPIC, plots(1, 0))
            raise RuntimeError("disk of the caller")

    with pytest.raises(RuntimeError, match="disk"):
        fail_half_way()
    assert topics(tmp_path / "bag") == {PLOTS_TOPIC: 1}
