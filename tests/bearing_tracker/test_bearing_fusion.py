# SPDX-License-Identifier: Apache-2.0
"""The fusion follows targets through jamming, lost tracks and strobes, and through whatever its inputs do."""

from __future__ import annotations

import numpy as np
import pytest

from bearing_tracker.bearing_fusion import BearingFusion
from bearing_tracker.fusion_parameters import FusionParameters
from bearing_tracker.identities import FIRST_OWN
from radar_common.frames import wrap_pi
from radar_common.parameters import ParameterError
from radar_common.tables import (
    BEARING,
    NANOSECONDS,
    PLOT,
    TRACK,
    BearingChannel,
    Table,
    TrackStatus,
)

WARM_UP = 20.0
JAM = (40.0, 80.0)


def errors(flight, rows, times):
    return wrap_pi(rows["azimuth"] - np.array([flight.azimuth(time) for time in times]))


def rms(values):
    return np.sqrt(np.mean(np.square(values)))


@pytest.fixture
def target(flight):
    return flight((20e3, 30e3), (-150.0, -50.0), track=7, source=3)


@pytest.fixture
def fusion():
    return BearingFusion(FusionParameters())


def test_under_jamming_the_fused_bearing_is_better_than_either_channel(channels, flight, run):
    # Six at once cost as much as one.
    flights = [
        flight((30e3 * np.sin(turn), 30e3 * np.cos(turn)), (-150.0, -50.0), number, number)
        for number, turn in enumerate(np.arange(0.5, 6.0, 1.0), start=1)
    ]
    messages = channels(flights, jam=JAM, end=110.0).messages
    clear_error, jammed_error = {}, {}
    for name in ("dcmp", "active", "passive"):
        rows, times = run(BearingFusion(FusionParameters(filter=name)), messages)
        wrong = np.zeros(len(rows))
        for one in flights:
            mine = rows["id"] == one.track
            wrong[mine] = errors(one, rows[mine], times[mine])
        assert set(rows["id"].tolist()) == {one.track for one in flights}
        jammed = (times > JAM[0] + 4.0) & (times < JAM[1])
        clear = (times > WARM_UP) & ~((times >= JAM[0]) & (times < JAM[1] + 4.0))
        clear_error[name], jammed_error[name] = rms(wrong[clear]), rms(wrong[jammed])
        if name == "dcmp":
            assert np.square(wrong / rows["azimuth_std"])[times > WARM_UP].mean() < 1.5
            assert rows["active_health"][clear, 1].mean() < 0.15
            assert rows["active_health"][jammed, 1].mean() > 0.7
            assert np.isnan(rows["active_health"][:, 2:]).all()
    assert clear_error["dcmp"] < min(clear_error["active"], clear_error["passive"])
    assert jammed_error["dcmp"] < 1.1 * min(jammed_error["active"], jammed_error["passive"])
    assert jammed_error["dcmp"] < 0.6 * jammed_error["active"]


def test_a_strobe_without_a_track_becomes_a_target_of_its_own(channels, flight, run, fusion):
    strobe = flight((-30e3, 10e3), (50.0, 100.0), source=9, seen=(1e9, 1e9))
    rows, times = run(fusion, channels([strobe]).messages)
    assert len(set(rows["id"].tolist())) == 1
    assert rows["id"][0] >= FIRST_OWN
    assert (rows["channel"] == BearingChannel.FUSED).all()
    late = times > WARM_UP
    assert rms(errors(strobe, rows, times)[late]) < 0.01
    assert np.isfinite(rows["rate_std"]).all()
    assert times[0] == pytest.approx(2.3), "the third bearing confirms it"


@pytest.mark.parametrize("source", [0, 3])
def test_a_target_outlives_its_track_and_takes_the_next_one(channels, flight, run, fusion, source):
    both = {"position": (20e3, 30e3), "velocity": (-150.0, -50.0)}
    before = flight(**both, track=7, source=source, seen=(0.0, 30.0))
    after = flight(**both, track=8, seen=(70.0, 1e9), heard=(1e9, 1e9))
    rows, times = run(fusion, channels([before, after], end=100.0).messages)
    assert set(rows["id"].tolist()) == {7}
    silent = (times > 32.0) & (times < 70.0)
    assert 30 < np.count_nonzero(silent) < 50
    assert rms(errors(before, rows, times)[silent]) < 0.01
    assert np.count_nonzero(times > 71.0) > 40, "rows of both channels again"


def test_identities_that_crossed_are_parted(channels, flight, run):
    right = flight((5e3, 30e3), (-100.0, 0.0), track=1, source=21)
    left = flight((-5e3, 30e3), (100.0, 0.0), track=2, source=22)
    # The finder's numbers jump to the other target, as after a restart.
    swapped = [
        flight(right.position, right.velocity, track=1, source=22, heard=(60.0, 1e9)),
        flight(left.position, left.velocity, track=2, source=21, heard=(60.0, 1e9)),
    ]
    right.heard = left.heard = (0.0, 50.0)
    for one in swapped:
        one.seen = (1e9, 1e9)
    # They are apart again when they are heard anew.
    fusion = BearingFusion(FusionParameters(end_after=60.0, release_after=4))
    rows, times = run(fusion, channels([right, left, *swapped], end=120.0).messages)
    assert fusion.health.counts["identities parted from their targets"] >= 1
    last = times > 100.0
    for number, truth in ((1, right), (2, left)):
        mine = last & (rows["id"] == number)
        assert rms(errors(truth, rows[mine], times[mine])) < 0.01


def test_targets_that_either_channel_keeps_alone_are_joined(flight, channels, run):
    both = {"position": (20e3, 30e3), "velocity": (-150.0, -50.0)}
    before = flight(**both, track=7, source=3, seen=(0.0, 20.0))
    after = flight(**both, track=8, seen=(22.0, 1e9), heard=(1e9, 1e9))
    messages = channels([before, after], end=60.0).messages
    for message in messages:
        # The tracker still coasts on the old track when it opens a new one, so its end is not told.
        if message.rows.dtype == TRACK:
            message.rows["status"][np.isnan(message.rows["plot_azimuth"])] = TrackStatus.COASTING
    fusion = BearingFusion(FusionParameters(end_after=8.0))
    rows, times = run(fusion, messages)
    assert set(rows["id"][times < 30.0].tolist()) == {7, 8}
    assert set(rows["id"][times > 45.0].tolist()) == {7}
    assert fusion.health.counts["targets joined"] == 1
    last = times > 45.0
    assert rms(errors(before, rows[last], times[last])) < 0.006


def test_plots_serve_without_a_tracker(flight, make_bearings, start):
    random = np.random.default_rng(5)
    truth = flight((20e3, 30e3), (-150.0, -50.0))
    fusion = BearingFusion(FusionParameters(active_input="plots"))
    out = []
    for time in np.arange(0.0, 60.0, 2.0):
        plots = np.zeros(1, PLOT)
        plots["azimuth"] = truth.azimuth(time) + 0.003 * random.standard_normal()
        plots["azimuth_std"], plots["range"] = 0.003, np.hypot(*truth.at(time))
        stamp = start + round(time * NANOSECONDS)
        out.append(fusion.process(Table(stamp, plots)).rows)
        heard = make_bearings(truth.azimuth(time) + 0.01 * random.standard_normal())
        out.append(fusion.process(Table(stamp + 1000, heard)).rows)
    assert len(set(np.concatenate(out)["id"].tolist())) == 1
    assert fusion.health.counts["targets opened"] == 1
    with pytest.raises(TypeError, match="plots"):
        fusion.process(Table(start, np.zeros(0)))


# The window ends inside a look of 0.7 s whenever a message arrives.
@pytest.mark.parametrize("look", [0.0, 0.05, 0.7])
def test_order_of_arrival_within_the_buffer_does_not_matter(channels, target, run, look):
    parameters = FusionParameters(look=look)
    messages = channels([target], end=30.0).messages
    random = np.random.default_rng(2)
    delayed = [m.stamp + random.uniform(0.0, 0.9e9) * (m.rows.dtype == BEARING) for m in messages]
    shuffled = [messages[number] for number in np.argsort(delayed, kind="stable")]
    assert [m.stamp for m in shuffled] != [m.stamp for m in messages]
    straight, times = run(BearingFusion(parameters), messages)
    again, again_times = run(BearingFusion(parameters), shuffled)
    for name in ("azimuth", "azimuth_std", "rate", "id"):
        assert straight[name] == pytest.approx(again[name])
    assert times == pytest.approx(again_times)


def test_duplicated_messages_change_nothing(channels, target, run):
    messages = channels([target], end=30.0).messages
    fusion = BearingFusion(FusionParameters())
    once, _ = run(BearingFusion(FusionParameters()), messages)
    twice, _ = run(fusion, [message for message in messages for _ in range(2)])
    assert twice["azimuth"] == pytest.approx(once["azimuth"])
    assert fusion.health.dropped["duplicate sightings"] > 0


def test_a_clock_that_goes_back_begins_anew_with_other_numbers(channels, flight, run, fusion):
    strobe = flight((-30e3, 10e3), (50.0, 100.0), seen=(1e9, 1e9))
    messages = channels([strobe], end=20.0).messages
    rows, _ = run(fusion, messages + messages)
    assert fusion.health.dropped["time went back: all targets ended"] >= 1
    assert len(set(rows["id"].tolist())) == 2


def test_a_new_process_goes_on_in_the_middle_of_a_run(channels, flight, target, run):
    strobe = flight((-30e3, 10e3), (50.0, 100.0), seen=(1e9, 1e9))
    messages = channels([target, strobe], end=40.0).messages
    half = len(messages) // 2
    first, _ = run(BearingFusion(FusionParameters()), messages[:half])
    second, times = run(BearingFusion(FusionParameters()), messages[half:])
    own = [{int(n) for n in rows["id"] if n >= FIRST_OWN} for rows in (first, second)]
    assert len(own[0]) == len(own[1]) == 1
    assert not own[0] & own[1]
    late, followed = times > times[0] + 10.0, second["id"] == target.track
    assert rms(errors(target, second[late & followed], times[late & followed])) < 0.006


@pytest.mark.parametrize("spread", [0.0, 2.0])
def test_ten_thousand_bearings_in_a_message_are_bounded(make_bearings, start, spread, fusion):
    random = np.random.default_rng(1)
    rows = make_bearings(
        random.uniform(0.0, 2 * np.pi, 10_000),
        identity=random.integers(0, 3, 10_000),
        time_offset=random.uniform(0.0, spread, 10_000),
    )
    fusion.process(Table(start, rows))
    fusion.flush()
    told = fusion.health.dropped
    assert fusion.health.counts["passive bearings in"] == 10_000
    if spread == 0.0:
        assert told["sightings over the limit of a look"] > 2000
        assert told["sightings of one identity twice in a look"] > 6000
    assert fusion.health.counts["targets opened"] <= 2000 + fusion.health.counts["targets ended"]


def test_the_fusion_survives_a_change_of_parameters(channels, target, fusion):
    messages = channels([target], end=40.0).messages
    rows = []
    for number, message in enumerate(messages):
        if number == len(messages) // 2:
            fusion.reconfigure(fusion.parameters.changed({"output": "map", "buffer": 0.2}))
        rows.append(fusion.process(message).rows)
    assert set(np.concatenate(rows)["id"].tolist()) == {7}


def test_impossible_parameters_are_refused():
    with pytest.raises(ParameterError, match="tentative_end_after"):
        FusionParameters(end_after=1.0)
    with pytest.raises(ParameterError, match="minimum_std"):
        FusionParameters(minimum_std=0.1)


def test_a_target_never_heard_takes_no_bearing_of_one_that_it_crosses(
    channels, flight, run, fusion
):
    # Both pass north at 40 s; the finder hears one of them only and tells no identities.
    heard = flight((-8e3, 30e3), (200.0, 0.0), track=1)
    mute = flight((8e3, 30e3), (-200.0, 0.0), track=2, heard=(1e9, 1e9))
    rows, times = run(fusion, channels([heard, mute], end=80.0).messages)
    columns = fusion._targets.columns
    assert set(columns["id"].tolist()) == {1, 2}
    assert np.isfinite(columns["heard"][columns["id"] == 1]).all()
    assert columns["heard"][columns["id"] == 2, BearingChannel.PASSIVE] == -np.inf
    for number, truth in ((1, heard), (2, mute)):
        mine = (rows["id"] == number) & (times > WARM_UP)
        assert rms(errors(truth, rows[mine], times[mine])) < 0.006


def test_plots_at_other_ranges_do_not_swap_targets_that_cross(flight, start):
    # One passes slowly behind the other, at errors larger than the angle between them.
    flights = flight((-4e3, 20e3), (100.0, 0.0)), flight((-7.2e3, 40e3), (180.0, 0.0))
    random = np.random.default_rng(1)
    fusion, far = BearingFusion(FusionParameters(active_input="plots")), {}
    for time in np.arange(0.0, 80.0, 2.0):
        plots = np.zeros(2, PLOT)
        plots["azimuth_std"], plots["radial_speed"] = 0.01, np.nan
        plots["range"] = [np.hypot(*one.at(time)) for one in flights]
        noise = 0.01 * random.standard_normal(2)
        plots["azimuth"] = np.mod([one.azimuth(time) for one in flights] + noise, 2 * np.pi)
        fusion.process(Table(start + round(time * NANOSECONDS), plots))
        for row in fusion._targets.columns:
            assert far.setdefault(int(row["id"]), row["range"] > 30e3) == (row["range"] > 30e3)
    assert sorted(far.values()) == [False, True]
