# SPDX-License-Identifier: Apache-2.0
"""The tracker on made-up flights: what it finds, when, and that nothing depends on north or on the period."""

from __future__ import annotations

from collections import Counter

import numpy as np
import pytest

from radar_common.frames import enu_from_polar
from radar_common.tables import NANOSECONDS, TRACK, EndReason, Table, TrackStatus
from secondary_proc.parameters import TrackerParameters
from secondary_proc.tracker import Tracker

FLIGHTS = [
    ((20e3, 10e3), (-150.0, 60.0)),
    ((-30e3, 25e3), (120.0, -90.0)),
    ((-5e3, -40e3), (20.0, 210.0)),
    ((45e3, -15e3), (-80.0, 170.0)),
]


def confirmed(rows):
    return set(rows["id"][rows["status"] == TrackStatus.CONFIRMED].tolist())


def errors(rows, times, truth):
    """Distance of a track's rows from a flight."""
    position, velocity = truth
    where = position + velocity * times[:, None]
    return np.hypot(rows["x"] - where[:, 0], rows["y"] - where[:, 1])


def assert_one_track_each(rows, times, truths, after=30.0, largest=300.0):
    ids = confirmed(rows)
    assert len(ids) == len(truths)
    for truth in truths:
        near = [
            i
            for i in ids
            if (errors(rows, times, truth)[(rows["id"] == i) & (times > after)] < largest).all()
        ]
        assert len(near) == 1


@pytest.mark.parametrize("smoother", ["kalman", "alpha_beta"])
@pytest.mark.parametrize("initiation", ["likelihood_ratio", "l_of_m"])
def test_each_target_gets_one_track(scene, run, smoother, initiation):
    world = scene(seed=1)
    for flight in FLIGHTS:
        world.fly(*flight)
    tracker = Tracker(TrackerParameters(smoother=smoother, initiation=initiation))
    rows, times = run(tracker, world.messages())
    assert_one_track_each(rows, times, world.truths)
    for truth in world.truths:
        last = (errors(rows, times, truth) < 300.0) & (times > 60.0)
        np.testing.assert_allclose(rows["vx"][last], truth[1][0], atol=15.0)
        np.testing.assert_allclose(rows["vy"][last], truth[1][1], atol=15.0)
    assert tracker.period == pytest.approx(4.0, rel=0.01)


def test_the_smoothed_position_is_better_than_the_plot(scene, run, tracker):
    world = scene(seed=2)
    for flight in FLIGHTS:
        world.fly(*flight, end=160.0)
    rows, times = run(tracker, world.messages())
    late = (rows["hits"] > 10) & np.isfinite(rows["plot_range"])
    x, y = enu_from_polar(rows["plot_range"], rows["plot_azimuth"])
    raw, smooth = [], []
    for truth in world.truths:
        mine = late & (errors(rows, times, truth) < 500.0)
        where = truth[0] + truth[1] * times[mine, None]
        raw.append(np.hypot(x[mine] - where[:, 0], y[mine] - where[:, 1]))
        smooth.append(errors(rows[mine], times[mine], truth))
    raw, smooth = np.concatenate(raw), np.concatenate(smooth)
    assert len(raw) > 80
    assert np.mean(smooth**2) < 0.6 * np.mean(raw**2)


def test_a_track_is_updated_within_one_sector_of_its_plot(scene, tracker):
    world = scene(seed=3)
    for flight in FLIGHTS:
        world.fly(*flight)
    known = set()
    for message in world.messages():
        table = tracker.process(message)
        now = {(r["range"], r["azimuth"]) for r in message.rows}
        seen = {
            (r["plot_range"], r["plot_azimuth"])
            for r in table.rows
            if r["status"] == TrackStatus.CONFIRMED and np.isfinite(r["plot_range"])
        }
        assert seen <= known | now
        known = now


@pytest.mark.parametrize("turn", [0.5, 2.0, np.pi])
def test_a_turned_scene_gives_turned_tracks(scene, run, turn):
    def tracks(angle):
        world = scene(seed=4)
        for flight in FLIGHTS:
            world.fly(*flight)
        world.clutter(20.0)
        world.azimuths = [np.mod(a + angle, 2 * np.pi) for a in world.azimuths]
        return run(Tracker(TrackerParameters()), world.messages())[0]

    plain, turned = tracks(0.0), tracks(turn)
    assert len(plain) == len(turned)
    for name in ("id", "status", "hits", "misses", "time_offset"):
        np.testing.assert_array_equal(plain[name], turned[name])
    # Azimuth runs clockwise: x' = x cos + y sin.
    for x, y in (("x", "y"), ("vx", "vy")):
        expected_x = plain[x] * np.cos(turn) + plain[y] * np.sin(turn)
        expected_y = plain[y] * np.cos(turn) - plain[x] * np.sin(turn)
        np.testing.assert_allclose(turned[x], expected_x, rtol=1e-4, atol=0.2)
        np.testing.assert_allclose(turned[y], expected_y, rtol=1e-4, atol=0.2)


def test_the_radars_place_in_the_map_shifts_the_tracks(scene, run):
    def tracks(**place):
        world = scene(seed=5)
        world.fly(*FLIGHTS[0])
        return run(Tracker(TrackerParameters(**place)), world.messages())[0]

    plain, shifted = tracks(), tracks(radar_x=1000.0, radar_y=-2000.0, radar_z=50.0)
    for name, shift in (("x", 1000.0), ("y", -2000.0), ("z", 50.0), ("vx", 0.0)):
        np.testing.assert_allclose(shifted[name], plain[name] + shift, atol=0.02)


def test_a_later_clock_gives_the_same_tracks(scene, run):
    def tracks(shift):
        world = scene(seed=6)
        world.fly(*FLIGHTS[1])
        messages = [Table(m.stamp + shift, m.rows) for m in world.messages()]
        return run(Tracker(TrackerParameters()), messages)[0]

    assert tracks(0).tobytes() == tracks(12_345 * NANOSECONDS).tobytes()


@pytest.mark.parametrize("sense", [1.0, -1.0])
@pytest.mark.parametrize("direction", [1.0, -1.0])
def test_crossing_north_is_nothing_special(scene, run, tracker, sense, direction):
    world = scene(seed=7, sense=sense)
    # Fast across the beam, over north in the middle; and one that stays right at north.
    world.fly((-direction * 9e3, 12e3), (direction * 240.0, 0.0))
    world.fly((1.0, 50e3), (0.0, -200.0))
    world.fly((1e4, -2e4), (50.0, 50.0))
    rows, times = run(tracker, world.messages())
    assert_one_track_each(rows, times, world.truths)
    rows = rows[np.isin(rows["id"], list(confirmed(rows)))]
    assert (rows["misses"] == 0).all()
    # All but those from before the rotation was known.
    late = [d for d, t in zip(world.distances, world.times, strict=True) if t > 10.0]
    assert set(late) <= set(rows["plot_range"].tolist())


def test_misses_are_counted_once_a_turn(scene, run):
    tracker = Tracker(TrackerParameters(confirmed_misses=6))
    world = scene(seed=8)
    world.fly((30e3, 3e3), (-100.0, 10.0), end=40.0)
    world.fly((-20e3, -20e3), (90.0, 10.0), end=120.0)
    world.clutter(30.0, end=120.0, nearest=60e3)
    rows, times = run(tracker, world.messages())
    lost = [i for i in confirmed(rows) if times[rows["id"] == i].max() < 90.0]
    assert len(lost) == 1
    life = rows[rows["id"] == lost[0]]
    coast = ~np.isfinite(life["plot_range"])
    assert list(life["misses"][coast]) == [1, 2, 3, 4, 5, 6]
    assert list(life["status"][coast]) == [TrackStatus.COASTING] * 5 + [TrackStatus.ENDED]
    assert list(life["end_reason"]) == [EndReason.ALIVE] * (len(life) - 1) + [EndReason.MISSES]
    assert tracker.health.counts["tracks ended: misses"] == 1
    gaps = np.diff(times[rows["id"] == lost[0]][coast])
    np.testing.assert_allclose(gaps, 4.0, atol=0.05)


def test_a_track_ends_when_its_score_has_fallen_by_more_than_its_misses_may_cost(scene, run):
    world = scene(seed=17)
    world.fly((30e3, 3e3), (-100.0, 10.0), end=40.0)
    world.fly((-20e3, -20e3), (90.0, 10.0), end=60.0)
    messages = list(world.messages(end=64.0))
    tracker = Tracker(TrackerParameters(scan_period=4.0))
    run(tracker, messages[: 44 * 8], flush=False)
    store = tracker._tracks._store
    assert (store["best"] >= store["score"]).all()
    store["best"][store["misses"] > 0] += 30.0
    rows, _ = run(tracker, messages[44 * 8 :], flush=False)
    ended = rows["status"] == TrackStatus.ENDED
    assert list(rows["misses"][ended]) == [2]
    assert list(rows["end_reason"][ended]) == [EndReason.SCORE]


@pytest.mark.parametrize("factor", [3.0, 1.0 / 3.0])
def test_tracks_live_through_a_change_of_the_period(scene, run, tracker, factor):
    first, second = scene(seed=9), scene(seed=10, period=4.0 * factor)
    change = 60.0
    end = change + 60.0 * max(factor, 0.7)
    for world, begin, stop in ((first, 0.0, change), (second, change, end)):
        for flight in FLIGHTS:
            world.fly(*flight, begin=begin, end=stop)
        world.clutter(40.0, begin=begin, end=stop, nearest=60e3)
    first.times += second.times
    first.distances += second.distances
    first.azimuths += second.azimuths
    rows, times = run(tracker, first.messages())
    assert tracker.period == pytest.approx(4.0 * factor, rel=0.01)
    assert_one_track_each(rows, times, first.truths[: len(FLIGHTS)], largest=400.0)


def test_a_lost_sector_ends_only_the_tracks_in_it(scene, run):
    tracker = Tracker(TrackerParameters(confirmed_misses=6))
    world = scene(seed=11)
    world.fly((0.0, 30e3), (20.0, 100.0), end=120.0)
    world.fly((0.0, -30e3), (20.0, 100.0), end=120.0)
    world.clutter(60.0, end=120.0)
    keep = [
        not (t > 60.0 and np.cos(a) > 0.5) for t, a in zip(world.times, world.azimuths, strict=True)
    ]
    for name in ("times", "distances", "azimuths"):
        column = getattr(world, name)
        column[:] = [value for value, kept in zip(column, keep, strict=True) if kept]
    rows, times = run(tracker, world.messages())
    last = {i: times[rows["id"] == i].max() for i in confirmed(rows)}
    assert len(last) == 2
    assert 75.0 < min(last.values()) < 95.0 < max(last.values())


def test_ids_are_never_used_again_and_every_end_is_told_once(scene, run, tracker):
    world = scene(seed=12, detection=0.8)
    for flight in FLIGHTS:
        world.fly(*flight, end=60.0)
    world.clutter(150.0, end=100.0)
    rows, times = run(tracker, world.messages(end=200.0))
    ended = rows["status"] == TrackStatus.ENDED
    assert Counter(rows["id"][ended].tolist()).most_common(1)[0][1] == 1
    # Nothing was left alive 100 s after the last plot, and nothing follows an end.
    assert set(rows["id"].tolist()) == set(rows["id"][ended].tolist())
    for i in set(rows["id"].tolist()):
        assert rows["status"][rows["id"] == i][-1] == TrackStatus.ENDED
    assert (~np.isfinite(rows["plot_range"][ended])).all()
    begun = {}
    for i, when in zip(rows["id"].tolist(), times, strict=True):
        begun.setdefault(i, when)
    assert len(tracker._tracks) == 0
    told = Counter(EndReason(reason) for reason in rows["end_reason"][ended].tolist())
    assert (rows["end_reason"][~ended] == EndReason.ALIVE).all()
    assert told[EndReason.NOT_CONFIRMED] > 20
    assert told[EndReason.MISSES] + told[EndReason.SCORE] >= len(FLIGHTS)
    counted = {
        name: number for name, number in tracker.health.counts.items() if "tracks ended" in name
    }
    assert counted == {
        f"tracks ended: {reason.name.lower().replace('_', ' ')}": number
        for reason, number in told.items()
    }


def test_a_target_that_flies_out_of_range_ends_at_once(scene, run):
    tracker = Tracker(TrackerParameters(maximum_range=40e3))
    world = scene(seed=18)
    world.fly((20e3, 20e3), (180.0, 180.0), end=100.0)
    world.fly((-20e3, -20e3), (50.0, 10.0), end=100.0)
    rows, _ = run(tracker, world.messages())
    ended = rows[rows["status"] == TrackStatus.ENDED]
    gone = ended[np.hypot(ended["x"], ended["y"]) > 40e3]
    assert list(gone["end_reason"]) == [EndReason.OUT_OF_COVERAGE]
    assert list(gone["misses"]) == [1]


def test_no_plot_is_used_twice(scene, run, tracker):
    world = scene(seed=13)
    # Two that fly side by side, closer than the gates.
    world.fly((20e3, 20e3), (100.0, 0.0))
    world.fly((20e3, 20.4e3), (100.0, 0.0))
    world.clutter(50.0)
    rows, _ = run(tracker, world.messages())
    plots = rows[np.isfinite(rows["plot_range"]) & (rows["hits"] > 2)]
    keys = Counter(zip(plots["plot_range"].tolist(), plots["plot_azimuth"].tolist(), strict=True))
    assert max(keys.values()) == 1


@pytest.mark.parametrize("sectors", [1, 8, 32, 64])
def test_the_cut_into_messages_changes_nothing_that_matters(scene, run, tracker, sectors):
    world = scene(seed=14, detection=0.9)
    for flight in FLIGHTS:
        world.fly(*flight)
    world.clutter(50.0)
    rows, times = run(tracker, world.messages(sectors=sectors))
    assert_one_track_each(rows, times, world.truths)


def test_tracks_survive_a_change_of_parameters(scene, run, tracker):
    world = scene(seed=15)
    for flight in FLIGHTS:
        world.fly(*flight)
    messages = list(world.messages())
    half = len(messages) // 2
    before, _ = run(tracker, messages[:half], flush=False)
    tracker.reconfigure(TrackerParameters(smoother="alpha_beta", confirmed_misses=3))
    after, _ = run(tracker, messages[half:])
    assert confirmed(before) == confirmed(after)


def test_what_is_no_table_of_plots_is_refused(tracker, start):
    with pytest.raises(TypeError, match="plots"):
        tracker.process(Table(start, np.zeros(1, TRACK)))


def test_slow_pairs_open_no_track(scene, run):
    world = scene(seed=16, noise=0.2)
    world.fly((20e3, 20e3), (0.0, 0.0))
    world.fly((-20e3, 20e3), (150.0, 0.0))
    rows, times = run(Tracker(TrackerParameters(minimum_speed=90.0)), world.messages())
    assert_one_track_each(rows, times, world.truths[1:])


def test_an_unknown_rotation_is_bridged_by_the_hint(make_plots, start, run):
    # Whole turns with one time for all plots: no rotation can be seen in them.
    messages = []
    for turn in range(12):
        x, y = 10e3 + 400.0 * turn, 20e3 - 200.0 * turn
        rows = make_plots([np.hypot(x, y)], [np.arctan2(x, y)], [0.0])
        messages.append(Table(start + 4 * turn * NANOSECONDS, rows))
    rows, _ = run(Tracker(TrackerParameters(scan_period=4.0)), messages)
    assert len(confirmed(rows)) == 1
    assert (rows["misses"] == 0).all()
