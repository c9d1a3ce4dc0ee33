# SPDX-License-Identifier: Apache-2.0
"""The main job on a real recording of an airport radar, with and without false plots added."""

from __future__ import annotations

import numpy as np
import pytest

from radar_common.bag import BagWriter
from radar_common.health import Health
from radar_common.tables import NANOSECONDS
from radar_eval.asterix_import import ImportOptions, import_recording, messages
from radar_eval.asterix_records import NAUTICAL_MILE, decode_records
from radar_eval.recording_file import data_blocks

pytestmark = pytest.mark.realdata

RECORDING, LABELS = "bcn_psr_modes_0800_0820.ast", "bcn_psr_labels_0800_0820.csv"


@pytest.fixture(scope="module")
def decoded(realdata):
    """The recording, decoded once for all tests."""
    return decode_records(data_blocks(realdata / RECORDING, Health()), Health())


@pytest.fixture(scope="module")
def labels(realdata):
    """Positions that another program extracted from the same recording."""
    return np.genfromtxt(realdata / LABELS, delimiter=",", names=True, dtype=None, encoding="utf-8")


@pytest.fixture(scope="module")
def everything(decoded):
    """All primary positions, at any range."""
    return import_recording(decoded, ImportOptions(primary=True))


def test_primary_positions_are_those_of_the_labels(everything, labels):
    rows, time = everything.plots, everything.plot_time / NANOSECONDS
    assert len(rows) == 9171
    ours = np.lexsort((rows["range"], time))
    theirs = np.lexsort((labels["psr_rho_nm"], labels["tod_s"]))
    assert time[ours] == pytest.approx(labels["tod_s"][theirs], abs=1e-6)
    range_bias = labels["psr_rho_nm"][theirs] * NAUTICAL_MILE - rows["range"][ours]
    turned = np.radians(labels["psr_theta_deg"][theirs]) - rows["azimuth"][ours]
    azimuth_bias = np.angle(np.exp(1j * turned))
    # Only the offset between the radars may differ, and it is the same everywhere.
    assert np.ptp(range_bias) < 1e-6
    assert np.ptp(azimuth_bias) < 1e-9
    assert range_bias[0] == pytest.approx(195.0, abs=1.0)
    assert np.degrees(azimuth_bias[0]) == pytest.approx(0.02, abs=0.002)


def test_the_measured_errors_are_those_of_the_notes(everything):
    assert everything.offset.range_std == pytest.approx(17.0, abs=4.0)
    assert np.degrees(everything.offset.azimuth_std) == pytest.approx(0.11, abs=0.01)
    assert everything.rotation.period == pytest.approx(4.0, abs=0.01)


def test_the_truth_is_the_secondary_position_of_each_aircraft(everything, labels):
    truth = {
        (int(row["id"]), round(time / NANOSECONDS * 128)): row
        for row, time in zip(everything.truth, everything.truth_time, strict=True)
    }
    for label in labels[::50]:
        row = truth[int(label["mode_s"], 16), round(label["tod_s"] * 128)]
        assert row["range"] == pytest.approx(label["rho_nm"] * NAUTICAL_MILE)
        assert np.degrees(row["azimuth"]) == pytest.approx(label["theta_deg"])
        speed = np.hypot(row["vx"], row["vy"])
        assert speed == pytest.approx(label["gs_kt"] * NAUTICAL_MILE / 3600.0, rel=1e-5)


@pytest.mark.parametrize("false_plots", [pytest.param(0.0, marks=pytest.mark.study), 200.0])
def test_real_aircraft_are_tracked_better_than_by_the_simple_tracker(
    command, decoded, tmp_path, false_plots
):
    options = ImportOptions(
        primary=True, nearest=5 * NAUTICAL_MILE, false_plots=false_plots, seed=1
    )
    with BagWriter(tmp_path / "plots") as writer:
        for topic, table in messages(import_recording(decoded, options)):
            writer.write(topic, table)
    result = command("run_offline", tmp_path / "plots", "--out", tmp_path / "tracks")
    assert result.code == 0, result.err
    scores = command("score", tmp_path / "tracks", "--json").json()
    assert scores["targets"] == scores["targets_tracked"] == 70
    assert scores["scans"] == 300
    assert scores["false_plots_per_scan"] == pytest.approx(
        false_plots, abs=4.0 * np.sqrt(false_plots / 300) + 0.01
    )
    assert scores["rms_raw_m"] == pytest.approx(165.0, abs=5.0)
    # The simple tracker of the recording's notes, at its best: 1.70 tracks, 96 %, 118 m, no false track.
    assert scores["tracks_per_target"] < 1.70
    assert scores["plots_in_tracks"] > 0.96
    assert scores["false_tracks"] == 0
    assert scores["rms_tracked_m"] < 118.0


def test_a_capture_of_several_radars_is_decoded(command, realdata, tmp_path):
    capture = realdata / "cat034_048_multiradar_sample.pcap"
    result = command("import_asterix", capture, "--out", tmp_path / "all")
    assert result.code == 1
    assert "several radars" in result.err
    result = command("import_asterix", capture, "--radar", "25/12", "--out", tmp_path / "one")
    assert result.code == 0, result.err
    assert "19 plots" in result.out
    assert "data block received twice" in result.out
