# SPDX-License-Identifier: Apache-2.0
"""Plots leave the queue once, in order of time, and not before their competitors can have come."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from radar_common.health import Health
from radar_common.tables import NANOSECONDS, PLOT, Table
from secondary_proc.parameters import TrackerParameters
from secondary_proc.plot_queue import PlotQueue
from secondary_proc.plots import RANGE, TIME

PERIOD = 4.0
SECTOR = PERIOD / 32
PARAMETERS = TrackerParameters()


@pytest.fixture
def message(make_plots, start):
    def build(edge, times):
        times = np.asarray(times, float)
        rows = make_plots(1e4 + times, np.mod(times, 6.0), times - edge)
        return Table(start + round(edge * NANOSECONDS), rows)

    return build


def taken(queue, **options):
    out = []
    while (slice_ := queue.take(PERIOD / 4, SECTOR, **options)) is not None:
        out.append(slice_[0][TIME, : slice_[1]])
    return np.concatenate(out) if out else np.zeros(0)


def test_a_plot_waits_for_one_message_at_most(message):
    queue = PlotQueue(PARAMETERS, Health())
    queue.put(message(0.0, [0.02, 0.1]), PERIOD)
    assert len(taken(queue)) == 0
    queue.put(message(SECTOR, []), PERIOD)
    np.testing.assert_allclose(taken(queue), [0.02, 0.1])


def test_competitors_behind_the_border_are_shown_but_stay(message):
    queue = PlotQueue(PARAMETERS, Health())
    queue.put(message(0.0, [0.1]), PERIOD)
    queue.put(message(SECTOR, [0.13, 0.24]), PERIOD)
    rows, ripe = queue.take(PERIOD / 4, SECTOR / 2)
    np.testing.assert_allclose(rows[TIME], [0.1, 0.13])
    assert ripe == 1
    queue.take_also(np.array([0]))
    queue.put(message(2 * SECTOR, []), PERIOD)
    np.testing.assert_allclose(taken(queue), [0.24])


def test_a_message_of_a_whole_turn_is_cut_into_slices(message):
    queue = PlotQueue(PARAMETERS, Health())
    queue.put(message(0.0, np.linspace(0.0, 3.99, 100)), PERIOD)
    queue.put(message(PERIOD, []), PERIOD)
    while (slice_ := queue.take(PERIOD / 4, SECTOR)) is not None:
        rows, ripe = slice_
        assert rows[TIME, ripe - 1] - rows[TIME, 0] <= PERIOD / 4


@given(
    times=st.lists(st.floats(0.0, 1.9), min_size=1, max_size=30, unique=True),
    order=st.randoms(use_true_random=False),
)
def test_every_plot_leaves_once_in_order_whatever_the_messages_do(times, order):
    start = 10**18
    times = np.unique(np.round(times, 6))
    edges = np.arange(0.0, 2.0, SECTOR)
    messages = []
    for edge in edges:
        inside = times[(times >= edge) & (times < edge + SECTOR)]
        rows = np.zeros(len(inside), PLOT)
        rows["range"], rows["azimuth"], rows["time_offset"] = 1e4, 1.0, inside - edge
        messages.append(Table(start + round(edge * NANOSECONDS), rows))
    # Some are repeated, some neighbours change places.
    messages += order.sample(messages, 4)
    messages.sort(key=lambda m: m.stamp)
    for i in order.sample(range(len(messages) - 1), 3):
        messages[i], messages[i + 1] = messages[i + 1], messages[i]
    queue, out = PlotQueue(PARAMETERS, Health()), []
    queue.seconds(start)
    for each in messages:
        queue.put(each, PERIOD)
        out.append(taken(queue))
    out.append(taken(queue, everything=True))
    np.testing.assert_allclose(np.sort(np.concatenate(out)), times, atol=1e-9)


def test_duplicates_and_late_plots_are_counted(message):
    health = Health()
    queue = PlotQueue(PARAMETERS, health)
    for _ in range(2):
        queue.put(message(0.0, [0.01, 0.02]), PERIOD)
    assert health.dropped == {"duplicate plots": 2}
    queue.put(message(5.0, []), PERIOD)
    queue.put(message(0.0, [0.01, 0.03]), PERIOD)
    assert health.dropped["plots older than the tracks"] == 2


def test_of_too_many_plots_the_strongest_stay(make_plots, start):
    health = Health()
    queue = PlotQueue(TrackerParameters(maximum_plots=100), health)
    rows = make_plots(np.arange(1.0, 501.0), 1.0, np.linspace(0.0, 0.1, 500))
    rows["snr_db"] = np.where(np.arange(500) % 5 == 0, 30.0, 10.0)
    rows["snr_db"][1] = np.nan
    kept = queue.put(Table(start, rows), PERIOD)
    assert health.dropped == {"plots over the limit of a scan": 400}
    np.testing.assert_array_equal(kept[RANGE], np.arange(500)[::5] + 1.0)
