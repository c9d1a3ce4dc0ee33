# SPDX-License-Identifier: Apache-2.0
"""The main job on a real recording of an airport radar, with and without false plots added."""

from __future__ import annotations

import numpy as np
import pytest

from radar_common.bag import read_tables
from radar_common.tables import NANOSECONDS, PLOT, PLOTS_TOPIC, TRUTH, TRUTH_TOPIC
from radar_eval.asterix_records import NAUTICAL_MILE

pytestmark = pytest.mark.realdata

RECORDING, LABELS = "bcn_psr_modes_0800_0820.ast", "bcn_psr_labels_0800_0820.csv"


def run_job(command, realdata, folder, *options):
    """Import, run and score; gives the scores."""
    plots, tracks = folder / "plots", folder / "tracks"
    recording = realdata / RECORDING
    for name, arguments in (
        ("import_asterix", [recording, "--psr", "--min-range", "5", "--out", plots, *options]),
        ("run_offline", [plots, "--out", tracks]),
    ):
        result = command(name, *arguments)
        assert result.code == 0, result.err
    return command("score", tracks, "--json").json()


@pytest.fixture(scope="module")
def labels(realdata):
    """Positions that another program extracted from the same recording."""
    return np.genfromtxt(realdata / LABELS, delimiter=",", names=True, dtype=None, encoding="utf-8")


def test_primary_positions_are_those_of_the_labels(command, realdata, labels, tmp_path):
    bag = tmp_path / "bag"
    result = command("import_asterix", realdata / RECORDING, "--psr", "--out", bag)
    assert "9171 plots" in result.out
    assert "primary minus secondary, removed: 19" in result.out
    tables = [table for _, table in read_tables(bag, {PLOTS_TOPIC: PLOT})]
    rows = np.concatenate([table.rows for table in tables])
    time = np.concatenate(
        [table.stamp / NANOSECONDS + table.rows["time_offset"] for table in tables]
    )
    ours = np.lexsort((rows["range"], time.round(6)))
    theirs = np.lexsort((labels["psr_rho_nm"], labels["tod_s"]))
    assert time[ours] == pytest.approx(labels["tod_s"][theirs], abs=1e-5)
    range_bias = labels["psr_rho_nm"][theirs] * NAUTICAL_MILE - rows["range"][ours]
    turned = np.radians(labels["psr_theta_deg"][theirs]) - rows["azimuth"][ours]
    azimuth_bias = np.angle(np.exp(1j * turned))
    # Only the offset between the radars may differ, and it is the same everywhere.
    assert np.ptp(range_bias) < 1e-6
    assert np.ptp(azimuth_bias) < 1e-9
    assert range_bias[0] == pytest.approx(195.0, abs=1.0)
    assert np.degrees(azimuth_bias[0]) == pytest.approx(0.02, abs=0.002)


def test_the_truth_names_the_aircraft(command, realdata, labels, tmp_path):
    bag = tmp_path / "bag"
    command("import_asterix", realdata / RECORDING, "--psr", "--out", bag)
    rows = np.concatenate([table.rows for _, table in read_tables(bag, {TRUTH_TOPIC: TRUTH})])
    assert {f"{number:06X}" for number in rows["id"]} >= set(labels["mode_s"].astype(str))
    assert np.nanmedian(np.hypot(rows["vx"], rows["vy"])) == pytest.approx(
        np.nanmedian(labels["gs_kt"]) * NAUTICAL_MILE / 3600.0, rel=0.05
    )


@pytest.mark.parametrize("options", [[], ["--false-plots", "200", "--seed", "1"]])
def test_real_aircraft_are_tracked_better_than_by_the_simple_tracker(
    command, realdata, tmp_path, options
):
    scores = run_job(command, realdata, tmp_path, *options)
    assert scores["targets"] == scores["targets_tracked"] == 70
    assert scores["scans"] == 300
    # The simple tracker of the recording's notes: 1.70 tracks, 96 %, 118 m, no false track at best.
    assert scores["tracks_per_target"] < 1.70
    assert scores["plots_in_tracks"] > 0.96
    assert scores["false_tracks"] == 0
    assert scores["rms_raw_m"] == pytest.approx(165.0, abs=5.0)
    assert scores["rms_tracked_m"] < 118.0
    if options:
        assert scores["false_plots_per_scan"] == pytest.approx(200.0, abs=4 * np.sqrt(200 / 300))


def test_a_capture_of_several_radars_is_decoded(command, realdata, tmp_path):
    capture = realdata / "cat034_048_multiradar_sample.pcap"
    result = command("import_asterix", capture, "--out", tmp_path / "all")
    assert result.code == 1
    assert "several radars" in result.err
    result = command("import_asterix", capture, "--radar", "25/12", "--out", tmp_path / "one")
    assert result.code == 0, result.err
    assert "19 plots" in result.out
    assert "data block received twice" in result.out
