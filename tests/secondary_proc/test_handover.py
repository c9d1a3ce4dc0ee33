# SPDX-License-Identifier: Apache-2.0
"""A tracker goes on with the tracks of one that has ended: in memory, by a file, and after a kill."""

from __future__ import annotations

import os
import signal
import subprocess
import sys

import numpy as np
import pytest

from radar_common.health import Health
from radar_common.tables import NANOSECONDS, EndReason, Table, TrackStatus
from secondary_proc.handover import Handover, HandoverError
from secondary_proc.parameters import TrackerParameters
from secondary_proc.smoothing import SMOOTHERS
from secondary_proc.state_file import StateFile
from secondary_proc.tracker import Tracker

FLIGHTS = [
    ((20e3, 10e3), (-150.0, 60.0)),
    ((-30e3, 25e3), (120.0, -90.0)),
    ((-5e3, -40e3), (20.0, 210.0)),
]


@pytest.fixture
def messages(scene):
    world = scene(seed=1, detection=0.9)
    for flight in FLIGHTS:
        world.fly(*flight, end=100.0)
    world.clutter(30.0, end=100.0)
    return list(world.messages())


def confirmed(rows):
    return set(rows["id"][rows["status"] == TrackStatus.CONFIRMED].tolist())


@pytest.mark.parametrize("smoother", sorted(SMOOTHERS))
def test_ids_and_states_continue_in_another_tracker(messages, run, smoother):
    parameters = TrackerParameters(smoother=smoother, radar_x=3e3, radar_y=-2e3)
    whole, times = run(Tracker(parameters), messages)
    half = len(messages) // 2
    first = Tracker(parameters)
    before, _ = run(first, messages[:half], flush=False)
    second = Tracker(parameters)
    second.resume(first.handover())
    after, _ = run(second, messages[half:])
    assert len(confirmed(before)) == len(FLIGHTS)
    assert confirmed(after) == confirmed(before)
    settled = (messages[half].stamp - messages[0].stamp) / NANOSECONDS + 8.0
    for track in confirmed(before):
        same = whole[(whole["id"] == track) & (times > settled) & np.isfinite(whole["plot_range"])]
        mine = after[np.isin(after["plot_range"], same["plot_range"])]
        assert (mine["id"] == track).all()
        assert len(mine) == len(same) > 5
        # A plot that waited for its competitors at the end of the first tracker is lost with it.
        assert set((same["hits"] - mine["hits"]).tolist()) <= {0, 1}
        assert np.median(np.hypot(mine["x"] - same["x"], mine["y"] - same["y"])) < 100.0


def test_what_is_not_alive_is_left_behind_and_no_id_comes_again(messages, run):
    first = Tracker(TrackerParameters())
    rows, _ = run(first, messages[: len(messages) // 2], flush=False)
    handover = Handover(Table(messages[len(messages) // 2].stamp, rows))
    assert set(handover.alive()["id"].tolist()) <= confirmed(rows)
    second = Tracker(TrackerParameters())
    second.resume(handover)
    after, _ = run(second, messages[len(messages) // 2 :])
    fresh = set(after["id"].tolist()) - set(handover.alive()["id"].tolist())
    assert fresh
    assert min(fresh) > rows["id"].max()


def test_tracks_are_taken_over_before_the_first_message_only(messages):
    tracker = Tracker(TrackerParameters())
    tracker.process(messages[0])
    with pytest.raises(RuntimeError, match="first message"):
        tracker.resume(tracker.handover())


@pytest.mark.parametrize(
    ("later", "reason"), [(3600, EndReason.MISSES), (-3600, EndReason.TIME_WENT_BACK)]
)
def test_tracks_of_another_time_end_with_the_reason(messages, run, later, reason):
    first = Tracker(TrackerParameters())
    run(first, messages, flush=False)
    second = Tracker(TrackerParameters())
    handover = first.handover()
    second.resume(handover)
    shifted = [Table(m.stamp + later * NANOSECONDS, m.rows) for m in messages]
    rows, _ = run(second, shifted)
    mine = np.isin(rows["id"], handover.alive()["id"]) & (rows["status"] == TrackStatus.ENDED)
    assert len(rows[mine]) == len(handover.alive()) > 0
    assert set(rows["end_reason"][mine].tolist()) == {reason}
    assert len(confirmed(rows) - set(handover.alive()["id"].tolist())) == len(FLIGHTS)


def test_a_file_gives_back_what_was_saved_but_for_reserved_ids(messages, run, tmp_path):
    tracker = Tracker(TrackerParameters())
    run(tracker, messages, flush=False)
    saved, path = tracker.handover(), tmp_path / "tracks.npz"
    saved.save(path)
    loaded = Handover.load(path)
    assert loaded.tracks.rows.tobytes() == saved.tracks.rows.tobytes()
    assert (loaded.tracks.stamp, loaded.period) == (saved.tracks.stamp, saved.period)
    assert loaded.next_id > saved.next_id
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize(
    "content", [b"", b"no file of ours", b"PK\x03\x04broken", b"\x93NUMPY\x01\x00"]
)
def test_a_broken_file_is_told_and_costs_nothing(content, tmp_path):
    path = tmp_path / "tracks.npz"
    path.write_bytes(content)
    with pytest.raises(HandoverError, match="state file"):
        Handover.load(path)
    health = Health()
    StateFile(str(path), 2.0, health).restore(Tracker(TrackerParameters()))
    assert sum(health.dropped.values()) == 1


def test_a_file_that_cannot_be_written_is_told(messages, tmp_path):
    health, tracker = Health(), Tracker(TrackerParameters())
    state = StateFile(str(tmp_path / "nowhere" / "tracks.npz"), 2.0, health)
    state.restore(tracker)
    tracker.process(messages[0])
    state.keep(tracker, messages[0].stamp)
    assert sum(health.dropped.values()) == 1


_CHILD = """
import sys
import numpy as np
from radar_common.health import Health
from radar_common.tables import Table
from secondary_proc.parameters import TrackerParameters
from secondary_proc.state_file import StateFile
from secondary_proc.tracker import Tracker
tracker, state = Tracker(TrackerParameters()), StateFile(sys.argv[2], 0.5, Health())
with np.load(sys.argv[1]) as held:
    for number, stamp in enumerate(held["stamps"].tolist()):
        tracker.process(Table(stamp, held[str(number)]))
        state.keep(tracker, stamp)
print("working", flush=True)
sys.stdin.read()
"""


def test_tracks_survive_a_kill(messages, run, tmp_path):
    half, state = len(messages) // 2, tmp_path / "state.npz"
    stamps = np.array([message.stamp for message in messages[:half]])
    rows = {str(number): message.rows for number, message in enumerate(messages[:half])}
    np.savez(tmp_path / "plots.npz", stamps=stamps, **rows)
    command = [sys.executable, "-c", _CHILD, str(tmp_path / "plots.npz"), str(state)]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as child:
        assert child.stdout.readline() == b"working\n"
        os.kill(child.pid, signal.SIGKILL)
    tracker = Tracker(TrackerParameters())
    StateFile(str(state), 2.0, Health()).restore(tracker)
    after, _ = run(tracker, messages[half:])
    assert tracker.health.counts["tracks resumed"] == len(FLIGHTS)
    assert tracker.health.counts["tracks confirmed"] == 0
    assert len(confirmed(after)) == len(FLIGHTS)
