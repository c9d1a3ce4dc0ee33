# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import asterix.generated as categories
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from radar_common.health import Health
from radar_common.tables import NANOSECONDS, PLOTS_TOPIC, TRUTH_TOPIC
from radar_eval.asterix_import import ImportOptions, import_recording, messages
from radar_eval.asterix_records import DAY, NAUTICAL_MILE, decode_records, run_over_midnight
from radar_eval.errors import RecordingError
from radar_eval.recording_file import DataBlock

PERIOD = 4.0
RANGE_UNIT, ANGLE_UNIT, DIFFERENCE_UNIT = 1 / 256, 360 / 2**16, 360 / 2**14


def report(time, nautical_miles, degrees, *, address=0x4CA123, difference=None, **flags):
    """A target report as a data block; difference is (NM, degrees) of primary minus secondary."""
    items = {
        "010": (("SAC", flags.get("sac", 20)), ("SIC", 129)),
        "140": (time, "s"),
        "020": (flags.get("typ", 7) << 4 | flags.get("sim", 0) << 3,),
        "040": (("RHO", (nautical_miles, "NM")), ("THETA", (degrees, "°"))),
        "200": (("GSP", (0.1, "NM/s")), ("HDG", (90.0, "°"))),
    }
    if address:
        items["220"] = address
    if difference is not None:
        items["130"] = {"RPD": (difference[0], "NM"), "APD": (difference[1], "°")}
    record = categories.Cat_048_1_32.cv_record.create(items)
    block = categories.Cat_048_1_32.create([record]).unparse().to_bytes()
    return DataBlock(48, block[3:], float("nan"))


def traffic(scans=20, aircraft=12, *, start=30000.0, difference=(26 / 256, 0.0), **flags):
    """Aircraft that stand still, seen once a scan by a turning antenna."""
    blocks = []
    for scan in range(scans):
        for number in range(aircraft):
            share = (number + 0.5) / aircraft
            time = round(128 * (start + (scan + share) * PERIOD)) / 128 % DAY
            blocks.append(
                report(
                    time, 8.0 + 4.0 * number, round(2**16 * share) * ANGLE_UNIT,
                    address=0x400000 + number, difference=difference, **flags,
                )
            )  # fmt: skip
    return blocks


def imported(blocks, **options):
    return import_recording(decode_records(blocks, Health()), ImportOptions(**options))


def test_positions_and_identities_are_decoded():
    rows = decode_records(
        [report(28800.5, 40.0, 90.0, difference=(0.1015625, -0.0439453125))], Health()
    )
    (row,) = rows.reports
    assert row["radar"] == 20 * 256 + 129
    assert row["time"] == 28800.5
    assert row["range"] == 40.0 * NAUTICAL_MILE
    assert row["azimuth"] == pytest.approx(np.pi / 2)
    assert row["range_difference"] == 0.1015625 * NAUTICAL_MILE
    assert np.degrees(row["azimuth_difference"]) == pytest.approx(-0.0439453125)
    assert row["address"] == 0x4CA123
    assert row["speed"] == pytest.approx(0.1 * NAUTICAL_MILE, abs=0.06)
    assert row["course"] == pytest.approx(np.pi / 2)


def test_predictions_and_simulated_targets_are_left_out():
    health = Health()
    blocks = [report(1.0, 10.0, 10.0, typ=0), report(2.0, 10.0, 10.0, sim=1), report(3.0, 9.0, 9.0)]
    assert len(decode_records(blocks, health).reports) == 1
    assert health.dropped == {
        "target report without detection": 1,
        "report of a simulated or test target": 1,
    }


def test_damaged_records_are_counted():
    health = Health()
    whole = report(3.0, 9.0, 9.0)
    blocks = [DataBlock(48, whole.records[:-1], whole.captured), whole]
    assert len(decode_records(blocks, health).reports) == 1
    assert health.dropped == {"damaged data block": 1}


@given(
    st.floats(0.0, DAY - 1.0),
    st.lists(st.floats(-20.0, 3600.0), min_size=1, max_size=200),
)
def test_times_run_over_midnight(first, steps):
    time = first + np.concatenate([[0.0], np.cumsum(steps)])
    assert run_over_midnight(time % DAY, first) == pytest.approx(time, abs=1e-6)


def test_a_recording_over_midnight_has_no_gap():
    plots = imported(traffic(start=DAY - 30.0)).plot_time
    assert np.max(np.diff(plots)) < PERIOD * NANOSECONDS


def test_the_constant_offset_is_removed_from_primary_positions():
    result = imported(traffic(difference=(26 / 256, 4 * DIFFERENCE_UNIT)), primary=True)
    assert result.offset.range_bias == pytest.approx(26 / 256 * NAUTICAL_MILE)
    assert np.degrees(result.offset.azimuth_bias) == pytest.approx(4 * DIFFERENCE_UNIT)
    assert result.plots["range"] == pytest.approx(result.truth["range"])
    assert result.plots["azimuth"] == pytest.approx(result.truth["azimuth"])


def test_the_scatter_is_that_of_one_aircraft_not_between_aircraft():
    generator = np.random.default_rng(5)
    recording = decode_records(traffic(scans=60), Health())
    rows = recording.reports
    noise = generator.normal(0.0, 20.0, len(rows))
    rows["range_difference"] = 190.0 + 60.0 * (rows["address"] % 3) + noise
    offset = import_recording(recording, ImportOptions(primary=True)).offset
    # A median absolute deviation of n normal samples has a relative error of about 1.17 / sqrt(n).
    assert offset.range_std == pytest.approx(20.0, rel=4 * 1.17 / np.sqrt(len(rows)))


def test_without_primary_the_reports_are_the_plots():
    result = imported(traffic())
    assert result.offset is None
    assert result.plots["range"] == pytest.approx(result.truth["range"])
    assert set(result.truth["id"]) == set(range(0x400000, 0x40000C))


def test_the_truth_goes_on_where_there_is_no_primary_plot():
    blocks = traffic()
    blocks[5::12] = traffic(difference=None)[5::12]
    result = imported(blocks, primary=True)
    assert len(result.plots) == 11 * 20
    assert len(result.truth) == 12 * 20


def test_near_plots_are_left_out():
    result = imported(traffic(), nearest=10 * NAUTICAL_MILE)
    assert result.plots["range"].min() >= 10 * NAUTICAL_MILE
    assert result.truth["range"].min() >= 10 * NAUTICAL_MILE


def test_false_plots_are_added_where_the_antenna_looks():
    result = imported(traffic(scans=100), false_plots=50.0, seed=4, nearest=5 * NAUTICAL_MILE)
    expected = 50.0 * np.ptp(result.plot_time) / NANOSECONDS / PERIOD
    assert abs(result.false_plots - expected) < 4.0 * np.sqrt(expected)
    time = result.plot_time / NANOSECONDS
    turned = np.angle(np.exp(1j * (result.rotation.azimuth(time) - result.plots["azimuth"])))
    assert np.max(np.abs(turned)) < 0.02
    assert np.all(np.diff(result.plot_time) >= 0)


def test_the_same_seed_gives_the_same_false_plots():
    first, second, other = (
        imported(traffic(), false_plots=20.0, seed=seed).plots for seed in (1, 1, 2)
    )
    assert np.array_equal(first["range"], second["range"])
    assert len(first) != len(other) or not np.array_equal(first["range"], other["range"])


def test_several_radars_need_a_choice():
    blocks = traffic() + traffic(sac=21)
    with pytest.raises(RecordingError, match=r"20/129 \(240 reports\), 21/129 \(240 reports\)"):
        imported(blocks)
    assert len(imported(blocks, radar=21 * 256 + 129).plots) == 240
    with pytest.raises(RecordingError, match="no radar 9/9"):
        imported(blocks, radar=9 * 256 + 9)


def test_a_recording_without_reports_is_one_clear_error():
    with pytest.raises(RecordingError, match="no target report"):
        imported([])
    with pytest.raises(RecordingError, match="primary position"):
        imported(traffic(difference=None), primary=True)
    with pytest.raises(RecordingError, match="no plot beyond"):
        imported(traffic(), nearest=500 * NAUTICAL_MILE)


def test_every_row_is_in_one_message_and_no_window_is_left_out():
    result = imported(traffic(aircraft=5))
    out = list(messages(result))
    plots = [table for topic, table in out if topic == PLOTS_TOPIC]
    times = np.concatenate(
        [table.stamp + np.round(table.rows["time_offset"] * 1e9) for table in plots]
    )
    assert np.array_equal(times, result.plot_time)
    stamps = np.array([table.stamp for table in plots])
    assert np.all(np.diff(stamps) > 0)
    assert np.max(np.diff(stamps)) < 2.01 * PERIOD / 32 * NANOSECONDS
    assert any(not len(table.rows) for table in plots)
    assert all(table.rows["time_offset"][0] == 0.0 for table in plots if len(table.rows))
    assert all(np.all(table.rows["time_offset"] >= 0.0) for table in plots)
    assert sum(len(table.rows) for topic, table in out if topic == TRUTH_TOPIC) == len(result.truth)


def test_times_count_from_the_midnight_asked_for():
    midnight = 1_600_000_000 // 86400 * 86400 * NANOSECONDS
    result = imported(traffic(start=30000.0), midnight=midnight)
    assert result.plot_time[0] - midnight == pytest.approx(30000 * NANOSECONDS, abs=4 * NANOSECONDS)
