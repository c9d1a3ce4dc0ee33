# SPDX-License-Identifier: Apache-2.0
"""Sightings leave in order of time whatever their order of arrival, and none that came in time is lost."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from bearing_tracker.looks import looks
from bearing_tracker.sightings import SIGHTING
from bearing_tracker.timeline import Timeline
from radar_common.health import Health
from radar_common.tables import NANOSECONDS

START = 1_700_000_000 * NANOSECONDS


def sightings(times, *, identity=0, azimuth=1.0, channel=1):
    rows = np.zeros(len(times), SIGHTING)
    rows["time"], rows["id"], rows["azimuth"], rows["channel"] = times, identity, azimuth, channel
    return rows


def arrive(timeline, times):
    """What leaves when one sighting arrives after the other, each with the time as its stamp."""
    out = []
    for time in times:
        timeline.advance("finder", START + round(time * NANOSECONDS))
        timeline.put(sightings([time], azimuth=0.001 * time))
        out.append(timeline.take(timeline.now - 1.0))
    out.append(timeline.take_all())
    return np.concatenate(out)


@settings(max_examples=40)
@given(st.lists(st.integers(0, 10_000), min_size=2, max_size=40, unique=True), st.randoms())
def test_order_of_arrival_within_the_window_does_not_matter(milliseconds, random):
    times = sorted(1e-3 * ms for ms in milliseconds)
    delayed = sorted(times, key=lambda time: time + random.uniform(0.0, 0.9))
    health = Health()
    # The first message sets the origin of time; it is the same in both orders.
    timelines = [Timeline(1.0, health) for _ in range(2)]
    for timeline in timelines:
        timeline.advance("finder", START)
    straight, shuffled = arrive(timelines[0], times), arrive(timelines[1], delayed)
    assert straight["time"].tolist() == times
    assert shuffled.tobytes() == straight.tobytes()
    assert not health.dropped


def test_duplicates_and_late_ones_are_dropped_and_counted():
    health = Health()
    timeline = Timeline(1.0, health)
    timeline.advance("finder", START)
    timeline.put(sightings([0.5, 0.5, 2.0]))
    assert timeline.take(1.0)["time"].tolist() == [0.5]
    timeline.put(sightings([0.9, 1.5]))
    assert timeline.take_all()["time"].tolist() == [1.5, 2.0]
    assert health.dropped == {"duplicate sightings": 1, "sightings too late to be put in order": 1}


def test_each_source_has_its_own_clock():
    timeline = Timeline(1.0, Health())
    timeline.advance("radar", START + 100 * NANOSECONDS)
    assert not timeline.went_back("finder", START)
    assert not timeline.went_back("radar", START + 95 * NANOSECONDS)
    assert timeline.went_back("radar", START + 90 * NANOSECONDS)
    assert timeline.stamp == START + 100 * NANOSECONDS


def test_looks_hold_one_channel_and_each_identity_once():
    rows = np.concatenate(
        [
            sightings([0.0, 0.01, 0.02, 0.04], identity=[1, 2, 1, 0], channel=1),
            sightings([0.03], identity=1, channel=0),
            sightings([0.2, 0.2], identity=0, channel=1),
        ]
    )
    health = Health()
    cut = list(looks(rows[np.argsort(rows["time"], kind="stable")], 0.05, 2, health))
    assert [look["channel"][0] for look in cut] == [0, 1, 1]
    assert [look["time"].tolist() for look in cut] == [[0.03], [0.0, 0.01], [0.2, 0.2]]
    assert health.dropped == {
        "sightings of one identity twice in a look": 1,
        "sightings over the limit of a look": 1,
    }
