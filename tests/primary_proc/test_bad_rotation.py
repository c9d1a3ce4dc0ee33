# SPDX-License-Identifier: Apache-2.0
"""An antenna or encoder that does not turn as it should: what is lost, what is counted, and when plots come again."""

from __future__ import annotations

import numpy as np
import pytest

from radar_common.tables import Table

SCAN = 1024
GAP = "stream broken by a gap or jump of azimuth or time"
STANDING = "pulses while the antenna stands still or turns back"
UNEVEN = "pulses whose azimuth or time advances unevenly"
QUIET = {"false_plots_per_scan": 0.01}


@pytest.fixture
def made(scene):
    """One scan with a strong target every 64 pulses, in the middle of each sector of 64."""
    return scene(21, SCAN, 128, [(32 + 64 * n, 40.4 + n, 15.0) for n in range(16)])


def sector_of(plots):
    return sorted(np.round(plots["time_offset"] * 1e3 / 64 - 0.5).astype(int).tolist())


def turned(made, steps):
    """Sectors of 64 pulses whose azimuths are the given multiples of the step."""
    tables = made.sectors(*range(64, SCAN, 64))
    for table, part in zip(tables, np.split(np.asarray(steps), 16), strict=True):
        table.rows["azimuth"] = part * made.step % (2 * np.pi)
    return tables


def test_azimuth_that_runs_backwards(made, extract):
    table = made.sectors()[0]
    table.rows["azimuth"] = table.rows["azimuth"][::-1]
    plots, health = extract([table])
    assert len(plots) == 0
    assert health.dropped == {STANDING: SCAN}


def test_an_antenna_that_stops_and_starts(made, extract, cut):
    """Plots of the turn before, none while it stands, plots again once it has turned a little."""
    turning, standing, again = (made.sectors(*cut(64, made)) for _ in range(3))
    for n, table in enumerate(standing):
        standing[n] = Table(table.stamp + 1024 * 10**6, table.rows)
        standing[n].rows["azimuth"] = 0.25
    again = [Table(table.stamp + 2048 * 10**6, table.rows) for table in again]
    plots, health = extract([*turning, *standing, *again], **QUIET)
    found = sector_of(plots)
    assert found[:16] == list(range(16))
    assert not set(found) & set(range(17, 32)), "at most the first sector is taken for turning"
    assert set(range(33, 48)) <= set(found)
    assert health.dropped[STANDING] >= 14 * 64


def test_azimuth_without_order(made, extract):
    table = made.sectors()[0]
    table.rows["azimuth"] = np.random.default_rng(1).uniform(0, 2 * np.pi, SCAN)
    plots, health = extract([table])
    assert len(plots) == 0
    assert sum(health.dropped.values()) >= SCAN


def test_an_encoder_coarser_than_the_step(made, extract):
    table = made.sectors()[0]
    grain = 2.6 * made.step
    table.rows["azimuth"] = np.floor(table.rows["azimuth"] / grain) * grain
    plots, health = extract([table], **QUIET)
    assert sector_of(plots) == list(range(16))
    assert health.dropped == {}


def test_a_change_of_the_rotation(made, extract, cut):
    """The antenna slows down to half: pulses per scan double, and the design follows."""
    first = made.sectors(*cut(64, made))
    second = [Table(t.stamp + 1024 * 10**6, t.rows.copy()) for t in first]
    for table in second:
        table.rows["azimuth"] = table.rows["azimuth"] / 2
    plots, health = extract([*first, *second], **QUIET)
    assert sector_of(plots) == list(range(32))
    assert health.counts["changes of the rotation"] >= 1
    late = plots["time_offset"] > 1.5
    expected = 2 * np.pi * (plots["time_offset"][late] - 1.024) / 2.048
    assert plots["azimuth"][late] == pytest.approx(expected, abs=1e-6)


def test_a_pause_of_whole_turns_breaks_the_stream(made, extract):
    first, second = made.sectors(512)
    later = Table(second.stamp + 5 * SCAN * 10**6, second.rows)
    _, health = extract([first, later], **QUIET)
    assert health.dropped[GAP] == 1


def test_an_antenna_that_turns_back_for_a_while(made, extract):
    """Four sectors backwards cost their own targets; all others are found, each at the azimuth of its pulses."""
    path = np.concatenate([np.arange(384), np.arange(383, 127, -1), np.arange(128, 512)])
    plots, health = extract(turned(made, path), **QUIET)
    assert sector_of(plots) == [n for n in range(16) if n not in (6, 7, 8, 9)]
    assert health.dropped[STANDING] + health.dropped[UNEVEN] == 4 * 64
    middle = path[32 + 64 * np.array(sector_of(plots))] * made.step
    assert plots["azimuth"] == pytest.approx(middle, abs=3 * made.step)


def test_an_azimuth_that_jumps_between_targets_costs_nothing(made, extract):
    """The mount is turned by a radian: one break, and later plots have the new azimuth."""
    steps = np.arange(SCAN) + np.where(np.arange(SCAN) < 448, 0.0, 1.0 / made.step)
    plots, health = extract(turned(made, steps), **QUIET)
    assert sector_of(plots) == list(range(16))
    assert health.dropped == {GAP: 1}
    assert plots["azimuth"][7:] == pytest.approx(
        (steps[32 + 64 * np.arange(7, 16)] * made.step) % (2 * np.pi), abs=3 * made.step
    )


def test_an_azimuth_that_jumps_within_a_burst_costs_that_plot(made, extract):
    steps = np.arange(SCAN) + np.where(np.arange(SCAN) < 32 + 64 * 5, 0.0, 100.0)
    plots, health = extract(turned(made, steps), **QUIET)
    assert sector_of(plots) == [n for n in range(16) if n != 5]
    assert health.dropped == {GAP: 1, "bursts cut by a break": 2}


def test_an_encoder_that_repeats_and_skips_single_pulses(made, extract):
    """One azimuth for two pulses, then two steps at once: that is within what an encoder may do."""
    steps = np.arange(SCAN) + np.tile([0.0, 0.0, -1.0, -1.0, 0.0, 1.0, 1.0, 0.0], SCAN // 8)
    plots, health = extract(turned(made, steps), **QUIET)
    assert sector_of(plots) == list(range(16))
    assert health.dropped == {}


@pytest.mark.parametrize("begin", [220, 225, 230])
def test_a_faster_rotation_ends_a_long_burst_that_is_over_the_new_limit(made, extract, begin):
    """The limit shrinks with the pulses of a beam, also below the age of a burst under way."""
    made.video[begin:, 80] += 1.0
    steps = np.cumsum(np.where(np.arange(SCAN) < 256, 1.0, 1.9))
    plots, health = extract(
        turned(made, steps), **QUIET, normaliser="fixed-level", noise_level=0.02 * np.sqrt(2.0)
    )
    assert set(sector_of(plots)) == set(range(16))
    assert health.counts["bursts cut at their longest"] == 1
    assert health.dropped == {}
