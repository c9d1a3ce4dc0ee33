# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import numpy as np
import pytest

from radar_common.bag import BagWriter, read_tables, topics
from radar_common.tables import (
    PLOT,
    PLOTS_TOPIC,
    SWEEPS_TOPIC,
    TRACK,
    TRACKS_TOPIC,
    TRUTH,
    TRUTH_TOPIC,
    Table,
)
from radar_eval.errors import EvaluationError
from radar_eval.offline import run_offline
from radar_eval.run_record import RECORD_FILE, RunRecord

WHAT_COMES_OUT = {PLOTS_TOPIC: PLOT, TRACKS_TOPIC: TRACK, TRUTH_TOPIC: TRUTH}


def plain(messages, total):
    return messages


def content(bag):
    return [
        (topic, table.stamp, table.frame_id, table.rows.tobytes())
        for topic, table in read_tables(bag, WHAT_COMES_OUT)
    ]


@pytest.fixture(scope="module")
def replayed(fixture_bags, tiny_parameters, tmp_path_factory):
    """A fixture bag run through the whole chain."""
    out = tmp_path_factory.mktemp("replayed") / "tracks"
    run_offline(fixture_bags / "tiny_mcap", out, parameters=tiny_parameters, progress=plain)
    return out


def test_a_replay_gives_the_same_bits_again(replayed, fixture_bags, tiny_parameters, tmp_path):
    again = tmp_path / "again"
    run_offline(fixture_bags / "tiny_mcap", again, parameters=tiny_parameters, progress=plain)
    assert content(again) == content(replayed)


def test_both_storages_give_the_same_plots_and_tracks(
    replayed, fixture_bags, tiny_parameters, tmp_path
):
    other = tmp_path / "other"
    run_offline(
        fixture_bags / "tiny_sqlite3", other, parameters=tiny_parameters, storage="sqlite3",
        progress=plain,
    )  # fmt: skip
    assert content(other) == content(replayed)


def test_tracking_the_plots_gives_the_tracks_of_the_whole_chain(replayed, tmp_path):
    tracks = tmp_path / "tracks"
    run_offline(replayed, tracks, progress=plain)
    # Topics may interleave differently where messages bear the same time.
    assert sorted(content(tracks)) == sorted(content(replayed))


def test_there_is_one_message_of_plots_a_sector_and_tracks_come_out(replayed, fixture_bags):
    sectors = topics(fixture_bags / "tiny_mcap")[SWEEPS_TOPIC]
    # The plots that still waited at the end come in a message of their own.
    assert sectors <= topics(replayed)[PLOTS_TOPIC] <= sectors + 1
    tracks = [table for topic, table in read_tables(replayed, {TRACKS_TOPIC: TRACK})]
    assert len(np.unique(np.concatenate([table.rows["id"] for table in tracks]))) >= 3


def test_the_truth_is_copied(replayed, fixture_bags):
    truth = {TRUTH_TOPIC: TRUTH}
    before, after = (
        [(t.stamp, t.rows.tobytes()) for _, t in read_tables(bag, truth)]
        for bag in (fixture_bags / "tiny_mcap", replayed)
    )
    assert before == after


def test_the_run_is_noted_down(replayed):
    record = RunRecord.read(replayed)
    assert set(record.stages) == {"bag", "plot_extractor", "tracker"}
    assert record.plots_per_second > 0.0
    assert record.stages["plot_extractor"].counts
    assert record.stages["tracker"].watches


def test_a_bag_without_a_record_has_none(fixture_bags):
    assert RunRecord.read(fixture_bags / "tiny_mcap") is None


@pytest.mark.parametrize("text", ["", "[]", "{}", '{"plots_per_second": "fast", "stages": {}}'])
def test_a_damaged_record_is_one_clear_error(tmp_path, text):
    (tmp_path / RECORD_FILE).write_text(text, encoding="utf-8")
    with pytest.raises(EvaluationError, match="no record of a run"):
        RunRecord.read(tmp_path)


def test_plots_with_more_fields_are_tracked_like_plots(replayed, tmp_path):
    wider = np.dtype([("extra", "<f4"), *[(name, PLOT[name]) for name in reversed(PLOT.names)]])
    with BagWriter(tmp_path / "wide") as writer:
        for _, table in read_tables(replayed, {PLOTS_TOPIC: PLOT}):
            rows = np.zeros(len(table.rows), wider)
            for name in PLOT.names:
                rows[name] = table.rows[name]
            writer.write(PLOTS_TOPIC, Table(table.stamp, rows, table.frame_id))
    run_offline(tmp_path / "wide", tmp_path / "out", progress=plain)
    tracks = {TRACKS_TOPIC: TRACK}
    assert [t.rows.tobytes() for _, t in read_tables(tmp_path / "out", tracks)] == [
        t.rows.tobytes() for _, t in read_tables(replayed, tracks)
    ]


def test_sweeps_that_the_parameters_do_not_fit_are_one_clear_error(fixture_bags, tmp_path):
    with pytest.raises(EvaluationError, match=r"a beam that holds 1\.4 pulses"):
        run_offline(fixture_bags / "tiny_mcap", tmp_path / "out", progress=plain)
    assert not (tmp_path / "out").exists()


def test_an_interrupted_run_leaves_no_half_bag(fixture_bags, tiny_parameters, tmp_path):
    def interrupted(messages, total):
        for number, message in enumerate(messages):
            if number == 100:
                raise KeyboardInterrupt
            yield message

    with pytest.raises(KeyboardInterrupt):
        run_offline(
            fixture_bags / "tiny_mcap", tmp_path / "out", parameters=tiny_parameters,
            progress=interrupted,
        )  # fmt: skip
    assert not (tmp_path / "out").exists()
