# SPDX-License-Identifier: Apache-2.0
"""Scores of fused bearings and emitters whose errors were put there by hand, and the page that shows them."""

from __future__ import annotations

import numpy as np
import pytest

from radar_common.bag import BagWriter
from radar_common.tables import (
    BEARING,
    BEARINGS_TOPIC,
    CHANNEL_TRUTH_TOPIC,
    EMITTER,
    EMITTERS_TOPIC,
    FUSED_BEARINGS_TOPIC,
    NANOSECONDS,
    PLOT,
    PLOTS_TOPIC,
    TRUTH,
    TRUTH_TOPIC,
    BearingChannel,
    Table,
    TrackStatus,
)
from radar_eval.bearing_evaluation import evaluate_bearings
from radar_eval.bearing_tables import lay_out_bearings
from radar_eval.emitter_evaluation import evaluate_emitters
from radar_eval.errors import ScoreError
from radar_eval.metrics.bearings import bearing_scores
from radar_eval.metrics.emitters import emitter_scores
from radar_eval.score_names import MEANINGS

SECONDS = 40
TURN = 2 * np.pi
# Two sources, either side of north, that move clockwise; jammed from 20 s on, silent from 30 s on.
FIRST, RATE = np.array([-0.1, 0.6]), np.array([0.01, -0.002])


def azimuth(second):
    return np.mod(FIRST + RATE * second, TURN)


def bearings(values, channel, ids, std=0.01):
    rows = np.zeros(len(values), BEARING)
    rows["azimuth"], rows["azimuth_std"], rows["id"] = np.mod(values, TURN), std, ids
    rows["channel"], rows["active_health"], rows["passive_health"] = channel, np.nan, np.nan
    return rows


def health(rows, jammed, silent):
    for name, bad in (("active_health", jammed), ("passive_health", silent)):
        rows[name][:, :2] = [1.0 - bad, bad]
    return rows


@pytest.fixture
def messages():
    """Plots 20 mrad off, bearings 10, fused 5 with a target near nothing; the jam is noticed 4 s late."""
    tables = {
        t: [] for t in (PLOTS_TOPIC, BEARINGS_TOPIC, FUSED_BEARINGS_TOPIC, CHANNEL_TRUTH_TOPIC)
    }
    for second in range(SECONDS):
        true, stamp = azimuth(second), second * NANOSECONDS
        side = np.where(second % 2, 1.0, -1.0)
        plots = np.zeros(2, PLOT)
        plots["azimuth"], plots["azimuth_std"] = np.mod(true + 0.02 * side, TURN), 0.02
        truth = health(bearings(true, 0, [11, 12]), second >= 20, second >= 30)
        fused = np.append(true + 0.005 * side, 3.0)
        fused = bearings(fused, BearingChannel.FUSED, [70, 80, 90], std=0.01)
        health(fused, 0.9 if second >= 24 else 0.2, 0.1)
        passive = bearings(true - 0.01 * side, BearingChannel.PASSIVE, [0, 0])
        for topic, rows in (
            (PLOTS_TOPIC, plots),
            (BEARINGS_TOPIC, passive),
            (FUSED_BEARINGS_TOPIC, fused),
            (CHANNEL_TRUTH_TOPIC, truth),
        ):
            tables[topic].append(Table(stamp, rows))
    return tables


def test_errors_and_states_are_those_that_were_put_there(messages):
    scores = bearing_scores(evaluate_bearings(lay_out_bearings(messages)))
    assert (scores["fused_targets"], scores["fused_targets_false"]) == (3, 1)
    assert scores["fused_bearings"] == 3 * SECONDS
    assert scores["rms_fused_mrad"] == pytest.approx(5.0, rel=1e-4)
    assert scores["rms_active_mrad"] == pytest.approx(20.0, rel=1e-4)
    assert scores["rms_passive_mrad"] == pytest.approx(10.0, rel=1e-4)
    assert scores["fused_error_normalised"] == pytest.approx(0.25, rel=1e-4)
    assert scores["active_state_right"] == pytest.approx(36 / SECONDS)
    assert scores["passive_state_right"] == pytest.approx(30 / SECONDS)
    assert set(scores) <= set(MEANINGS)


def test_without_truth_about_channels_directions_still_count(messages):
    truths = []
    for table in messages.pop(CHANNEL_TRUTH_TOPIC):
        rows = np.zeros(2, TRUTH)
        rows["id"], rows["azimuth"], rows["range"] = [11, 12], table.rows["azimuth"], 5e3
        truths.append(Table(table.stamp, rows))
    scores = bearing_scores(evaluate_bearings(lay_out_bearings(messages | {TRUTH_TOPIC: truths})))
    assert scores["rms_fused_mrad"] == pytest.approx(5.0, rel=1e-4)
    assert np.isnan(scores["active_state_right"])
    with pytest.raises(ScoreError, match="no truth"):
        evaluate_bearings(lay_out_bearings(messages))


@pytest.fixture
def emitters():
    """An emitter 300 m off once its range is known, one still without range and one near nothing."""
    tables = {EMITTERS_TOPIC: [], TRUTH_TOPIC: []}
    for second in range(SECONDS):
        truth, rows = np.zeros(2, TRUTH), np.zeros(3, EMITTER)
        truth["id"], truth["x"], truth["y"] = [5, 6], [1e4, 0.0], [0.0, 2e4]
        truth["azimuth"], truth["range"] = [np.pi / 2, 0.0], [1e4, 2e4]
        rows["id"], rows["azimuth"] = [1, 2, 3], [np.pi / 2 + 0.03, TURN - 0.01, 4.0]
        rows["x"], rows["y"] = [1e4, 0.0, 0.0], [-300.0, 9e3, 0.0]
        rows["covariance"] = (np.eye(4) * 300.0**2).ravel()
        rows["status"], rows["bound_std"] = TrackStatus.CONFIRMED, 200.0
        rows["range_known"] = [second >= 10, False, False]
        if second == SECONDS - 1:
            rows["status"][2] = TrackStatus.TENTATIVE
        tables[EMITTERS_TOPIC].append(Table(second * NANOSECONDS, rows))
        tables[TRUTH_TOPIC].append(Table(second * NANOSECONDS, truth))
    return tables


def test_emitters_count_from_when_their_range_is_known(emitters):
    scores = emitter_scores(evaluate_emitters(lay_out_bearings(emitters)))
    assert (scores["emitters"], scores["emitters_false"], scores["emitters_located"]) == (3, 1, 1)
    assert scores["emitter_rows_range_known"] == pytest.approx(30 / (3 * SECONDS - 1))
    assert scores["rms_emitter_m"] == scores["rms_emitter_last_m"] == pytest.approx(300.0)
    assert scores["rms_emitter_bound_m"] == pytest.approx(200.0)
    assert scores["emitter_error_normalised"] == pytest.approx(0.5)
    assert set(scores) <= set(MEANINGS)
    with pytest.raises(ScoreError, match="no truth"):
        evaluate_emitters(lay_out_bearings({EMITTERS_TOPIC: emitters[EMITTERS_TOPIC]}))


def test_a_bag_without_tracks_is_scored_and_shown(messages, emitters, command, tmp_path):
    with BagWriter(tmp_path / "bag") as writer:
        for topic, tables in (messages | emitters).items():
            for table in tables:
                writer.write(topic, table)
    told = command("score", tmp_path / "bag", "--json")
    assert told.code == 0
    assert told.json()["rms_fused_mrad"] == pytest.approx(5.0, rel=1e-4)
    assert told.json()["rms_emitter_m"] == pytest.approx(300.0)
    assert "targets_tracked" not in told.json()
    shown = command("report", tmp_path / "bag", "--out", tmp_path / "page")
    assert shown.code == 0
    page = (tmp_path / "page" / "index.html").read_text(encoding="utf-8")
    assert page.count("<svg") == 2
    assert "Fused bearings against time" in page
    assert "Detection against range" not in page


def test_emitters_of_unknown_range_can_be_drawn(emitters, command, tmp_path):
    with BagWriter(tmp_path / "bag") as writer:
        for topic, tables in emitters.items():
            for table in tables:
                if topic == EMITTERS_TOPIC:
                    table.rows["range_known"] = 0
                writer.write(topic, table)
    assert command("score", tmp_path / "bag", "--json").json()["rms_emitter_m"] is None
    assert command("report", tmp_path / "bag", "--out", tmp_path / "page").code == 0
