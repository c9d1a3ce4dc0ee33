# SPDX-License-Identifier: Apache-2.0
"""The locator finds emitters from a weaving platform, with and without identities, whatever its inputs do."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

from bearing_tracker.emitter_locator import EmitterLocator
from bearing_tracker.identities import FIRST_OWN
from bearing_tracker.locator_parameters import LocatorParameters
from radar_common.odometry import PlatformState
from radar_common.parameters import ParameterError
from radar_common.tables import BEARING, NANOSECONDS, Table, TrackStatus

STD = np.radians(0.5)
STEP = 2.0
SPEED = 150.0
RAY = {"speed_std": 2.0, "confirm_hits": 3}


class Sortie:
    """Odometry and bearings of a platform that flies east in a weave, or straight."""

    def __init__(self, start, *, weave=30.0, steps=100, seed=1):
        self.start = start
        self.times = STEP * np.arange(steps)
        fine = np.arange(0.0, self.times[-1] + STEP, 0.1)
        course = np.pi / 2 + np.radians(weave) * np.sin(2 * np.pi * fine / 60.0)
        path = np.cumsum(np.stack([np.sin(course), np.cos(course)], axis=1), axis=0) * SPEED * 0.1
        self.places = path[:: round(STEP / 0.1)][:steps]
        self.random = np.random.default_rng(seed)

    def stamp(self, time):
        return self.start + round(time * NANOSECONDS)

    def odometry(self, number, **changes):
        x, y = self.places[number].tolist()
        state = PlatformState(self.stamp(self.times[number]), x, y, 2000.0, 1.5, SPEED, 0.0)
        return dataclasses.replace(state, **changes)

    def azimuths(self, number, emitters):
        apart = np.asarray(emitters) - self.places[number]
        noise = STD * self.random.standard_normal(len(apart))
        return np.mod(np.arctan2(*apart.T) + noise, 2 * np.pi)


@pytest.fixture
def sortie(start):
    return Sortie(start)


def fly(locator, sortie, make_bearings, emitters, identities=0, steps=None, first=0):
    """Fly the sortie; the last row of every emitter by its id."""
    last = {}
    for number in range(first, steps or len(sortie.times)):
        rows = make_bearings(sortie.azimuths(number, emitters), std=STD, identity=identities)
        for table in (
            locator.process(Table(sortie.stamp(sortie.times[number]), rows)),
            locator.process_platform(sortie.odometry(number)),
        ):
            last |= {int(row["id"]): row for row in table.rows}
    last |= {int(row["id"]): row for row in locator.flush().rows}
    return last


def test_emitters_are_found_and_their_range_is_known_after_manoeuvres(sortie, make_bearings):
    locator = EmitterLocator(LocatorParameters(**RAY))
    emitters = [(6e3, 20e3), (25e3, -15e3)]
    last = fly(locator, sortie, make_bearings, emitters, np.array([11, 12]))
    assert last.keys() == {11, 12}
    for row, truth in zip((last[11], last[12]), emitters, strict=True):
        assert row["status"] == TrackStatus.CONFIRMED
        assert row["range_known"]
        assert row["hits"] == len(sortie.times)
        error = np.hypot(row["x"] - truth[0], row["y"] - truth[1])
        spread = np.sqrt(row["covariance"][0] + row["covariance"][5])
        assert error < 3.5 * spread
        assert 0.3 * row["bound_std"] < spread < 3.0 * row["bound_std"]
        watch = locator.health.watches[
            f"emitter {row['id']}: Cramer-Rao bound and error of its place, m"
        ]
        assert (watch.expected, watch.observed) == pytest.approx((row["bound_std"], spread))
    assert not locator.health.dropped


def test_two_that_cross_without_identity_keep_their_numbers(sortie, make_bearings):
    # Seen from the passing platform the far one overtakes the near one.
    emitters = [(8e3, 12e3), (11e3, 36e3)]
    first, final = (np.arctan2(*(np.array(emitters) - place).T) for place in sortie.places[[0, -1]])
    assert np.diff(first) < 0 < np.diff(final)
    locator = EmitterLocator(LocatorParameters(**RAY))
    last = fly(locator, sortie, make_bearings, emitters)
    found = [row for row in last.values() if row["status"] == TrackStatus.CONFIRMED]
    assert len(found) == 2
    assert all(row["id"] >= FIRST_OWN for row in found)
    for truth in emitters:
        errors = [np.hypot(row["x"] - truth[0], row["y"] - truth[1]) for row in found]
        assert min(errors) < 0.25 * truth[1]
    assert all(row["hits"] > 80 for row in found)


def test_without_a_manoeuvre_the_range_stays_unknown(start, make_bearings):
    straight = Sortie(start, weave=0.0, steps=30)
    # An emitter that may be as fast as a car leaves the rate of its bearing open to any range.
    locator = EmitterLocator(LocatorParameters(speed_std=30.0))
    last = fly(locator, straight, make_bearings, [(4e3, 40e3)], 5)
    assert not last[5]["range_known"]
    assert last[5]["range_std"] > 0.3 * last[5]["range"]
    assert last[5]["azimuth_std"] < STD


def test_elevations_give_the_height(sortie, make_bearings):
    locator = EmitterLocator(LocatorParameters(**RAY))
    truth, height = np.array([6e3, 20e3]), 500.0
    for number in range(len(sortie.times)):
        rows = make_bearings(sortie.azimuths(number, [truth]), std=STD, identity=4)
        distance = np.hypot(*(truth - sortie.places[number]))
        rows["elevation"] = np.arctan2(height - 2000.0, distance)
        rows["elevation_std"] = 0.002
        locator.process_platform(sortie.odometry(number))
        locator.process(Table(sortie.stamp(sortie.times[number]), rows))
    assert locator.flush().rows["z"][0] == pytest.approx(height, abs=250.0)


def test_outliers_are_rejected_and_a_wrong_place_is_left(sortie, make_bearings):
    locator = EmitterLocator(LocatorParameters(**RAY, restart_after=5))
    fly(locator, sortie, make_bearings, [(6e3, 20e3)], 3, steps=40)
    moved = fly(locator, sortie, make_bearings, [(8e3, -20e3)], 3, first=40)
    assert locator.health.counts["emitters located anew"] == 1
    assert locator.health.dropped == {"bearings that fit no place of their emitter": 5}
    assert moved[3]["rejected"] == 5
    assert np.hypot(moved[3]["x"] - 8e3, moved[3]["y"] + 20e3) < 8e3


def test_bearings_wait_for_odometry_but_not_for_ever(sortie, make_bearings, start):
    locator = EmitterLocator(LocatorParameters(buffer=0.0, odometry_wait=2.0, confirm_hits=1))
    locator.process_platform(sortie.odometry(0))
    bearing = make_bearings([1.0], std=STD, identity=2)
    assert not len(locator.process(Table(start + NANOSECONDS, bearing)).rows)
    found = locator.process_platform(sortie.odometry(1))
    assert found.rows["id"].tolist() == [2]
    assert found.stamp / NANOSECONDS + found.rows["time_offset"][0] == pytest.approx(
        start / NANOSECONDS + 1.0
    )
    for late in (9, 20):
        locator.process(Table(start + late * NANOSECONDS, bearing))
    assert locator.health.dropped == {"bearings without odometry": 1}


def test_odometry_that_cannot_be_is_refused(sortie, make_bearings):
    locator = EmitterLocator(LocatorParameters())
    locator.process_platform(sortie.odometry(0))
    locator.process_platform(sortie.odometry(1, x=9e6))
    locator.process_platform(sortie.odometry(2))
    locator.process_platform(sortie.odometry(2))
    locator.process_platform(sortie.odometry(3, frame_id="elsewhere"))
    assert locator.health.dropped == {
        "fixes that jump": 1,
        "fixes of a time that has one": 1,
        "odometry in frame elsewhere, not map": 1,
    }


def test_not_to_know_the_own_place_makes_bearings_worse(sortie, make_bearings, start):
    stds = []
    for variance in (0.0, 200.0**2):
        locator = EmitterLocator(LocatorParameters(confirm_hits=1))
        locator.process_platform(sortie.odometry(0, position_variance=variance))
        locator.process(Table(start, make_bearings([1.0], std=STD, identity=2)))
        stds.append(locator.flush().rows["azimuth_std"][0])
    assert stds[0] == pytest.approx(STD, rel=1e-3)
    assert stds[1] > 1.5 * STD


def test_silent_emitters_end_and_their_numbers_are_not_used_again(sortie, make_bearings, start):
    locator = EmitterLocator(LocatorParameters(confirm_hits=2, end_after=20.0))
    fly(locator, sortie, make_bearings, [(6e3, 20e3)], 3, steps=5)
    gone = [
        row
        for number in range(5, 20)
        for row in locator.process_platform(sortie.odometry(number)).rows
    ]
    assert [(row["id"], row["status"]) for row in gone] == [(3, TrackStatus.ENDED)]
    again = fly(locator, sortie, make_bearings, [(6e3, 20e3)], 3, first=20, steps=25)
    assert min(again) >= FIRST_OWN


def test_time_that_goes_back_ends_all(sortie, make_bearings):
    locator = EmitterLocator(LocatorParameters(confirm_hits=2))
    fly(locator, sortie, make_bearings, [(6e3, 20e3)], 3, steps=20)
    table = locator.process(Table(sortie.start, make_bearings([1.0])))
    assert table.rows["status"].tolist() == [TrackStatus.ENDED]
    assert table.rows["time_offset"].tolist() == [0.0]
    assert locator.health.dropped == {"time went back: all emitters ended": 1}
    again = fly(locator, sortie, make_bearings, [(6e3, 20e3)], 3, steps=20)
    assert max(again) >= FIRST_OWN


@pytest.mark.parametrize("spread", [0.0, 2.0])
def test_ten_thousand_bearings_in_a_message_are_bounded(sortie, make_bearings, start, spread):
    random = np.random.default_rng(1)
    rows = make_bearings(
        random.uniform(0.0, 2 * np.pi, 10_000), time_offset=random.uniform(0.0, spread, 10_000)
    )
    locator = EmitterLocator(LocatorParameters(maximum_emitters=100))
    locator.process_platform(sortie.odometry(0))
    locator.process(Table(start, rows))
    locator.process_platform(sortie.odometry(1))
    locator.flush()
    assert locator.health.counts["bearings in"] == 10_000
    assert locator.health.counts["emitters opened"] == 100
    assert locator.health.dropped["bearings over the limit of emitters"] > 100


def test_the_locator_refuses_other_tables_and_impossible_parameters(start):
    with pytest.raises(TypeError, match="bearings"):
        EmitterLocator(LocatorParameters()).process(Table(start, np.zeros(1)))
    for wrong, word in (
        ({"minimum_range": 2e5}, "minimum_range"),
        ({"manoeuvre_acceleration": 0.005}, "manoeuvre_acceleration"),
        ({"buffer": 5.0}, "odometry_wait"),
    ):
        with pytest.raises(ParameterError, match=word):
            LocatorParameters(**wrong)


def test_parameters_can_change_on_the_way(sortie, make_bearings):
    locator = EmitterLocator(LocatorParameters(confirm_hits=2))
    fly(locator, sortie, make_bearings, [(6e3, 20e3)], 3, steps=10)
    locator.reconfigure(locator.parameters.changed({"end_after": 5.0, "tentative_end_after": 5.0}))
    ended = [locator.process_platform(sortie.odometry(number)).rows for number in range(10, 16)]
    assert np.concatenate(ended)["status"].tolist() == [TrackStatus.ENDED]
    assert locator.process(Table(sortie.stamp(40.0), np.zeros(0, BEARING))).rows.size == 0
