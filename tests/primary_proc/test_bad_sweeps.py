# SPDX-License-Identifier: Apache-2.0
"""Bad input: each kind has a counted reason and a bounded effect on the plots around it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.lib.recfunctions import drop_fields, rename_fields

from primary_proc.parameters import ExtractorParameters
from primary_proc.plot_extractor import PlotExtractor
from radar_common.cloud import TableError
from radar_common.health import Health
from radar_common.tables import NANOSECONDS, Table, sweep_dtype

SCAN = 1024
GAP = "stream broken by a gap or jump of azimuth or time"
LATE = "sector repeated or out of order"
NOT_FINITE = "samples that are not finite, taken as zero"
OTHER_CELLS = "stream broken by other range cells"
QUIET = {"false_plots_per_scan": 0.01}


@pytest.fixture
def made(scene):
    """One scan with a strong target every 64 pulses, in the middle of each sector of 64."""
    return scene(21, SCAN, 128, [(32 + 64 * n, 40.4 + n, 15.0) for n in range(16)])


@pytest.fixture
def sectors(made, cut):
    return made.sectors(*cut(64, made))


def pulses_of(plots):
    return sorted(np.round(plots["time_offset"] * 1e3 / 64 - 0.5).astype(int).tolist())


def test_clean_input_drops_nothing(sectors, extract):
    plots, health = extract(sectors, **QUIET)
    assert pulses_of(plots) == list(range(16))
    assert health.dropped == {}


def test_a_repeated_sector_changes_nothing(sectors, extract):
    plots, health = extract([*sectors[:5], sectors[4], *sectors[5:]], **QUIET)
    assert pulses_of(plots) == list(range(16))
    assert health.dropped == {LATE: 1}


def test_swapped_sectors_cost_no_more_than_the_late_one(sectors, extract):
    sectors[6], sectors[7] = sectors[7], sectors[6]
    plots, health = extract(sectors, **QUIET)
    assert pulses_of(plots) == [n for n in range(16) if n != 6]
    assert health.dropped[LATE] == 1
    assert health.dropped[GAP] == 1


def test_a_missing_sector_costs_its_own_targets(sectors, extract):
    del sectors[9]
    plots, health = extract(sectors, **QUIET)
    assert pulses_of(plots) == [n for n in range(16) if n != 9]
    assert health.dropped == {GAP: 1}


def test_a_burst_cut_by_a_gap_makes_no_plot(made, extract):
    """Sectors that end within bursts; one is missing."""
    tables = made.sectors(*range(32, SCAN, 64))
    del tables[5]
    plots, health = extract(tables, **QUIET)
    assert pulses_of(plots) == [n for n in range(16) if n not in (4, 5)]
    assert health.dropped == {GAP: 1, "bursts cut by a break": 2}


def test_a_few_lost_pulses_do_no_harm(made, extract):
    table = made.sectors()[0]
    kept = np.delete(table.rows, np.arange(0, SCAN, 31))
    plots, health = extract([Table(table.stamp, kept)], **QUIET)
    assert pulses_of(plots) == list(range(16))
    assert health.dropped == {}


def test_other_cells_in_flight(sectors, extract, scene):
    """The number of cells changes, then the range step, then both change back."""
    other = scene(22, SCAN, 200, [(32 + 64 * n, 40.4 + n, 15.0) for n in range(16)])
    cells = other.sectors(*range(64, SCAN, 64))
    for n in (5, 6, 7):
        sectors[n] = cells[n]
    for n in (10, 11):
        sectors[n].rows["range_step"] = 50.0
    plots, health = extract(sectors, **QUIET)
    assert pulses_of(plots) == list(range(16))
    assert health.dropped == {OTHER_CELLS: 4}
    changed = (plots["time_offset"] > 0.640) & (plots["time_offset"] < 0.768)
    assert plots["range"][changed].max() < 500.0 + 128 * 50.0


def test_cells_that_change_within_a_message(made, extract):
    table = made.sectors()[0]
    table.rows["range_step"][512:] = 50.0
    plots, health = extract([table], **QUIET)
    assert pulses_of(plots) == list(range(16))
    assert health.dropped == {OTHER_CELLS: 1}


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_samples_that_are_not_finite(made, extract, value):
    table = made.sectors()[0]
    table.rows["video"][5:900:50, 100] = value
    plots, health = extract([table], **QUIET)
    assert pulses_of(plots) == list(range(16))
    assert health.dropped == {NOT_FINITE: 18}


@pytest.mark.parametrize("name", ["azimuth", "time_offset", "range_start", "range_step"])
def test_pulses_without_a_place_are_left_out(made, extract, name):
    table = made.sectors()[0]
    table.rows[name][[100, 500]] = np.nan
    plots, health = extract([table], **QUIET)
    assert pulses_of(plots) == list(range(16))
    assert health.dropped == {"pulses without a finite azimuth, time or range": 2}


def test_a_message_of_such_pulses_only_is_empty(made, extract):
    table = made.sectors()[0]
    table.rows["azimuth"] = np.nan
    plots, _ = extract([table])
    assert len(plots) == 0


@pytest.mark.parametrize(
    ("level", "kind"),
    [
        (0.0, np.float32),
        (7.0, np.float32),
        (0, np.uint8),
        (255, np.uint8),
        (0, np.uint16),
        (65535, np.uint16),
    ],
)
def test_silent_and_saturated_video_has_no_plots(made, extract, level, kind):
    made.video[:] = level
    plots, health = extract(made.sectors(kind=kind))
    assert len(plots) == 0
    assert health.dropped == {}


def test_samples_too_large_to_be_squared_count_as_not_finite(made, extract):
    made.video[460:500] = np.finfo(np.float32).max
    plots, health = extract(made.sectors(), **QUIET)
    assert pulses_of(plots) == [n for n in range(16) if n != 7], "none where all is zero"
    assert health.dropped == {NOT_FINITE: 40 * 128}


def test_a_digitiser_at_its_limit(scene, extract):
    """Targets stronger than the scale are clipped; a part of the picture that is saturated hides those in it alone."""
    made = scene(23, SCAN, 128, [(32 + 64 * n, 40.4 + n, 60.0) for n in range(16)], sigma=10.0)
    made.video[300:500] = 1e4
    made.video[:, 100:] = 1e4
    clipped = replace(made, video=np.minimum(np.rint(made.video), 255.0))
    plots, health = extract(clipped.sectors(kind=np.uint8), **QUIET)
    assert pulses_of(plots) == [n for n in range(16) if n not in (5, 6, 7)]
    expected = 10.0 * np.log10(255.0**2 / (2.0 * 10.0**2))
    assert plots["snr_db"] == pytest.approx(np.full(13, expected), abs=2.0)
    assert health.dropped == {}


def test_an_echo_over_no_noise_at_all_is_a_plot(made, extract):
    """A digitiser that suppresses noise leaves zeros around its echoes."""
    made.video[:] = 0.0
    made.video[300:320, 50] = 1.0
    plots, _ = extract(made.sectors())
    assert len(plots) == 1
    assert plots["snr_db"][0] == pytest.approx(90.0)
    assert np.isfinite(plots["azimuth_std"][0])


def test_a_clock_that_goes_back_starts_afresh(sectors, extract):
    """A recording of two turns that is played again from its beginning."""
    second = [Table(t.stamp + 1024 * 10**6, t.rows) for t in sectors]
    recording = [*sectors, *second]
    plots, health = extract([*recording, *recording], **QUIET)
    assert pulses_of(plots) == sorted([*range(32), *range(32)])
    assert health.dropped["clock went back"] == 1
    assert LATE not in health.dropped


@pytest.mark.parametrize(
    "spoil",
    [
        lambda rows: drop_fields(rows, "video"),
        lambda rows: drop_fields(rows, "azimuth"),
        lambda rows: rename_fields(rows, {"time_offset": "time"}),
        lambda rows: rows.astype(
            [(n, "<f4" if n == "azimuth" else rows.dtype[n]) for n in rows.dtype.names]
        ),
        lambda rows: np.zeros(
            4, [(n, rows.dtype[n]) for n in rows.dtype.names[:-1]] + [("video", "<f8", (8,))]
        ),
        lambda rows: np.zeros(
            4, [(n, rows.dtype[n]) for n in rows.dtype.names[:-1]] + [("video", "<f4")]
        ),
    ],
)
def test_messages_that_hold_no_sweeps_are_refused(made, spoil):
    extractor = PlotExtractor(ExtractorParameters(beamwidth_deg=3.0), Health())
    with pytest.raises(TableError, match=r"sweeps|video"):
        extractor.process(Table(0, spoil(made.rows())))
    assert len(extractor.process(made.sectors()[0]).rows), "and the next good one is processed"


@pytest.mark.parametrize(
    ("parameters", "reason"),
    [
        ({"beamwidth_deg": 0.1}, "pulses"),
        ({"false_plots_per_scan": 1e5}, "merge|reach"),
        ({"guard_cells": 64, "reference_cells": 40}, "reference cell"),
    ],
)
def test_sweeps_that_the_parameters_do_not_fit_are_refused_with_the_reason(
    made, parameters, reason
):
    extractor = PlotExtractor(
        ExtractorParameters(**({"beamwidth_deg": 3.0} | parameters)), Health()
    )
    for _ in range(2):
        with pytest.raises(TableError, match=reason):
            extractor.process(made.sectors()[0])
        extractor.flush()


def test_an_empty_message_gives_an_empty_table():
    extractor = PlotExtractor(ExtractorParameters(), Health())
    assert len(extractor.process(Table(5 * NANOSECONDS, np.zeros(0, sweep_dtype(64)))).rows) == 0
    assert extractor.flush().stamp == 5 * NANOSECONDS
