# SPDX-License-Identifier: Apache-2.0
"""Nothing that arrives ends the tracker, and everything that is refused is counted."""

from __future__ import annotations

import tracemalloc

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from radar_common.tables import NANOSECONDS, PLOT, Table, TrackStatus
from secondary_proc.parameters import TrackerParameters
from secondary_proc.tracker import Tracker

FLIGHT = ((20e3, 10e3), (-150.0, 60.0))


def confirmed(rows):
    return set(rows["id"][rows["status"] == TrackStatus.CONFIRMED].tolist())


@pytest.mark.parametrize(
    ("field", "value", "reason"),
    [
        ("range", np.nan, "plots that are not finite"),
        ("range", np.inf, "plots that are not finite"),
        ("azimuth", np.nan, "plots that are not finite"),
        ("time_offset", np.nan, "plots that are not finite"),
        ("range", -5.0, "plots at no positive range"),
        ("range", 0.0, "plots at no positive range"),
        ("range", 1e7, "plots beyond the maximum range"),
        ("time_offset", 1e6, "plots far from their message's time"),
        ("range_std", np.inf, "plots with huge errors"),
        ("range_std", 1e9, "plots with huge errors"),
        ("azimuth_std", 100.0, "plots with huge errors"),
    ],
)
def test_impossible_plots_are_dropped_and_the_others_used(
    scene, run, tracker, make_plots, field, value, reason
):
    world = scene(seed=1)
    world.fly(*FLIGHT)
    messages = []
    for message in world.messages():
        bad = make_plots([3e4, 4e4], [1.0, 2.0], [0.01, 0.02])
        bad[field] = value
        messages.append(Table(message.stamp, np.concatenate([bad, message.rows])))
    rows, _ = run(tracker, messages)
    assert tracker.health.dropped == {reason: 2 * len(messages)}
    assert len(confirmed(rows)) == 1


@pytest.mark.parametrize("value", [np.nan, 0.0, -1.0])
@pytest.mark.parametrize("field", ["range_std", "azimuth_std"])
def test_a_plot_that_tells_no_error_gets_the_default(scene, run, tracker, field, value):
    world = scene(seed=2)
    world.fly(*FLIGHT)
    messages = list(world.messages())
    for message in messages:
        message.rows[field] = value
    rows, _ = run(tracker, messages)
    assert len(confirmed(rows)) == 1
    assert not tracker.health.dropped


def test_an_error_too_small_to_be_true_is_not_believed(make_plots, start, tracker):
    # Two plots with a tiny and one with an honest error, all of one target: the third still falls into the gate.
    rows = make_plots([3e4, 3e4, 3e4], 1.0, 0.0, range_std=1e-30, azimuth_std=1e-30)
    for turn in range(8):
        rows["range"] += 200.0
        table = tracker.process(Table(start + 4 * turn * NANOSECONDS, rows[:1].copy()))
        assert np.isfinite(table.rows["covariance"]).all()
        assert (table.rows["covariance"][:, 0] > 1.0).all()


def test_every_message_twice_changes_nothing(scene, run):
    world = scene(seed=3)
    world.fly(*FLIGHT)
    world.clutter(50.0)
    messages = list(world.messages())
    once, _ = run(Tracker(TrackerParameters()), messages)
    tracker = Tracker(TrackerParameters())
    twice, _ = run(tracker, [m for message in messages for m in (message, message)])
    assert tracker.health.dropped == {"duplicate plots": len(world.times)}
    assert confirmed(once) == confirmed(twice)


def test_neighbouring_messages_in_wrong_order_lose_nothing(scene, run):
    tracker = Tracker(TrackerParameters(scan_period=4.0))
    world = scene(seed=4)
    world.fly(*FLIGHT)
    messages = list(world.messages())
    for i in range(0, len(messages) - 1, 2):
        messages[i], messages[i + 1] = messages[i + 1], messages[i]
    rows, _ = run(tracker, messages)
    assert not tracker.health.dropped
    assert len(confirmed(rows)) == 1
    assert rows["hits"].max() == len(world.times)


def test_a_clock_that_goes_back_starts_afresh(scene, run, tracker):
    world = scene(seed=5)
    world.fly(*FLIGHT)
    messages = list(world.messages())
    rows, _ = run(tracker, messages + messages)
    assert tracker.health.dropped == {"time went back: all tracks ended": 1}
    ids = confirmed(rows)
    assert len(ids) == 2
    assert (rows["status"][rows["id"] == min(ids)] == TrackStatus.ENDED).sum() == 1


def test_an_hours_gap_ends_the_tracks_and_new_ones_begin(scene, run, tracker, start):
    world = scene(seed=6)
    world.fly(*FLIGHT)
    world.clutter(50.0)
    messages = list(world.messages())
    later = [Table(m.stamp + 3600 * NANOSECONDS, m.rows) for m in messages]
    rows, times = run(tracker, messages + later)
    ids = sorted(confirmed(rows))
    assert len(ids) == 2
    assert times[rows["id"] == ids[0]].max() < 150.0
    assert times[rows["id"] == ids[1]].min() > 3599.0
    assert len(tracker._tracks) < 200


def test_a_burst_of_plots_is_bounded_in_memory_and_work(scene, make_plots, start, run):
    parameters = TrackerParameters(maximum_plots=2000, maximum_tracks=3000)
    tracker = Tracker(parameters)
    world = scene(seed=7)
    world.fly(*FLIGHT)
    messages = list(world.messages())
    run(tracker, messages, flush=False)
    random = np.random.default_rng(7)
    count, stamp = 100_000, messages[-1].stamp
    for turn in (1, 2, 3):
        rows = make_plots(random.uniform(1e3, 1e5, count), 0.0, random.uniform(0.0, 4.0, count))
        rows["azimuth"] = np.mod(2 * np.pi * rows["time_offset"] / 4.0, 2 * np.pi)
        tracker.process(Table(stamp + 4 * turn * NANOSECONDS, rows))
        assert len(tracker._tracks) <= 3000
        assert len(tracker._starts.plots) <= 2000
    tracker.flush()
    dropped = tracker.health.dropped
    assert dropped["plots over the limit of a scan"] == 3 * 98_000
    assert dropped["candidates over the limit of tracks"] > 0


def test_a_hundred_thousand_plots_at_one_place_and_time(make_plots, start):
    tracker = Tracker(TrackerParameters(scan_period=4.0, maximum_plots=1000, maximum_tracks=500))
    rows = make_plots(np.full(100_000, 3e4), 1.0, 0.0)
    rows["range"] += np.linspace(0.0, 1e-3, 100_000)
    for turn in range(3):
        tracker.process(Table(start + 4 * turn * NANOSECONDS, rows))
    tracker.flush()
    assert len(tracker._tracks) <= 500
    assert len(tracker._starts.plots) <= 1000


def test_one_message_from_the_future_costs_the_tracks_but_not_the_tracker(scene, run, tracker):
    world = scene(seed=8)
    world.fly(*FLIGHT)
    messages = list(world.messages())
    half = len(messages) // 2
    future = Table(messages[half].stamp + 3600 * NANOSECONDS, messages[half].rows)
    rows, times = run(tracker, [*messages[:half], future, *messages[half:]])
    assert tracker.health.dropped == {"time went back: all tracks ended": 1}
    ids = sorted(confirmed(rows))
    assert len(ids) == 2
    assert times[rows["id"] == ids[1]].max() > 70.0


def test_a_burst_of_a_hundred_thousand_plots_does_not_stop_a_tracker_with_usual_limits(
    scene, make_plots, run, tracker
):
    world = scene(seed=9)
    world.fly(*FLIGHT)
    messages = list(world.messages())
    half = len(messages) // 2
    random = np.random.default_rng(9)
    count = 100_000
    rows = make_plots(random.uniform(1e3, 4e5, count), 0.0, random.uniform(0.0, 0.125, count))
    turn = messages[half].stamp / NANOSECONDS - messages[0].stamp / NANOSECONDS
    rows["azimuth"] = np.mod(2 * np.pi * (turn + rows["time_offset"]) / 4.0, 2 * np.pi)
    rows["snr_db"] = 10.0
    burst = Table(messages[half].stamp, np.concatenate([messages[half].rows, rows]))
    found, times = run(tracker, [*messages[:half], burst, *messages[half + 1 :]])
    limit = tracker.parameters.maximum_plots
    kept = len(burst.rows) - limit
    assert tracker.health.dropped["plots over the limit of a scan"] == kept
    first = min(confirmed(found))
    assert times[(found["id"] == first) & (found["status"] == TrackStatus.CONFIRMED)].max() > 75.0


def test_errors_that_change_from_nothing_to_kilometres_keep_a_track_finite(scene, run, tracker):
    world = scene(seed=10)
    world.fly(*FLIGHT)
    messages = list(world.messages())
    told = [(0.0, 0.0), (1e4, 0.5), (5.0, 2e-4), (np.nan, 0.5)]
    turn = 0
    for message in messages:
        if len(message.rows):
            message.rows["range_std"], message.rows["azimuth_std"] = told[turn % len(told)]
            turn += 1
    rows, _ = run(tracker, messages)
    assert not tracker.health.dropped
    assert len(rows) > 10
    covariance = rows["covariance"].astype(float).reshape(-1, 4, 4)
    scale = np.sqrt(np.einsum("nii->ni", covariance))
    correlation = covariance / scale[:, :, None] / scale[:, None, :]
    assert (np.linalg.eigvalsh(correlation) > -1e-5).all()


def test_a_track_outlives_a_change_of_the_scan_period_and_the_period_is_reported(scene, run):
    tracker = Tracker(TrackerParameters(scan_period=4.0))
    first, second = scene(seed=11), scene(seed=12, period=12.0)
    for world, begin, stop in ((first, 0.0, 60.0), (second, 60.0, 240.0)):
        for flight in (FLIGHT, ((-30e3, 25e3), (60.0, -40.0)), ((-5e3, -40e3), (20.0, 90.0))):
            world.fly(*flight, begin=begin, end=stop)
        world.clutter(40.0, begin=begin, end=stop, nearest=70e3)
    for name in ("times", "distances", "azimuths"):
        getattr(first, name).extend(getattr(second, name))
    run(tracker, first.messages())
    watch = tracker.health.watches["scan period, s"]
    assert watch.expected == 4.0
    assert watch.observed == pytest.approx(12.0, rel=0.01)


def test_memory_is_flat_over_a_thousand_scans(scene):
    world = scene(seed=13)
    position, velocity = (np.array(vector) for vector in FLIGHT)
    for begin in range(0, 4000, 200):
        world.fly(position - velocity * begin, velocity, begin=float(begin), end=begin + 140.0)
    world.clutter(4.0, end=4000.0)
    messages = list(world.messages(sectors=1, end=4000.0))
    tracker = Tracker(TrackerParameters())
    held = []
    tracemalloc.start()
    try:
        for number, message in enumerate(messages):
            tracker.process(message)
            if number % 50 == 49:
                held.append(tracemalloc.get_traced_memory()[0])
    finally:
        tracemalloc.stop()
    assert tracker.health.counts["tracks confirmed"] >= 15
    early, late = held[4:8], held[-8:]
    # Plots that wait come and go; what grew with every scan by a single row would exceed this.
    assert max(late) < max(early) + 60e3


@settings(max_examples=60)
@given(
    messages=st.lists(
        st.tuples(
            st.integers(0, 200),
            hnp.arrays(np.uint8, st.integers(0, 6).map(lambda n: n * PLOT.itemsize)),
        ),
        max_size=12,
    )
)
def test_any_bytes_leave_the_tracker_alive_and_its_numbers_finite(messages):
    tracker = Tracker(TrackerParameters(scan_period=1.0))
    with np.errstate(invalid="ignore", over="ignore"):
        for tick, raw in messages:
            table = tracker.process(Table(10**18 + tick * NANOSECONDS // 4, raw.view(PLOT)))
            for name in ("x", "y", "vx", "vy", "covariance", "time_offset"):
                assert np.isfinite(table.rows[name]).all()
    tracker.flush()


def test_flush_of_a_tracker_that_saw_nothing(tracker):
    assert len(tracker.flush().rows) == 0
