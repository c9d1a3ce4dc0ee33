# SPDX-License-Identifier: Apache-2.0
"""The path is exact for uniform motion, does not bridge gaps and jumps, and does not care how fixes arrive."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bearing_tracker.platform_path import Limits, PlatformPath
from radar_common.health import Health

LIMITS = Limits(gap=2.0, ahead=0.5, speed=300.0, memory=20.0)
VELOCITY = np.array([120.0, -80.0, 5.0])
ORIGIN = np.array([1e4, -2e4, 3e3])


def true_place(times):
    return ORIGIN + np.multiply.outer(times, VELOCITY)


def path_of(times, health=None):
    path = PlatformPath(LIMITS, health or Health())
    for time in times:
        path.put(time, tuple(true_place(time)), 4.0)
    return path


@settings(max_examples=40)
@given(
    st.lists(st.integers(0, 100), min_size=2, max_size=30, unique=True),
    st.lists(st.floats(0.0, 12.0), min_size=1, max_size=20),
    st.randoms(),
)
def test_uniform_motion_is_interpolated_exactly_in_any_order_of_arrival(ticks, asked, random):
    fixes = [0.1 * tick for tick in ticks]
    random.shuffle(fixes)
    asked = np.array(asked)
    places = path_of(fixes).at(asked)
    assert places.position[places.known] == pytest.approx(true_place(asked[places.known]), abs=1e-6)
    fixes = np.sort(fixes)
    after = np.clip(np.searchsorted(fixes, asked), 1, len(fixes) - 1)
    short = fixes[after] - fixes[after - 1] <= LIMITS.gap
    inside = (asked >= fixes[0]) & (asked <= fixes[-1] + LIMITS.ahead)
    assert (places.known == (short & inside) | np.isin(asked, fixes)).all()
    assert (places.variance[places.known] == 4.0).all()


def test_nothing_is_known_without_fixes_and_of_one_only_its_own_time():
    assert not path_of([]).at(np.array([0.0])).known.any()
    assert path_of([1.0]).at(np.array([0.5, 1.0, 1.5])).known.tolist() == [False, True, False]


def test_a_single_jump_is_an_error():
    health = Health()
    path = path_of([0.0, 1.0], health)
    path.put(2.0, (9e5, 0.0, 0.0))
    for time in (3.0, 4.0):
        path.put(time, tuple(true_place(time)))
    assert health.dropped == {"fixes that jump": 1}
    places = path.at(np.array([2.0, 3.5]))
    assert places.known.all()
    assert places.position == pytest.approx(true_place(np.array([2.0, 3.5])))


def test_a_jump_that_stays_begins_a_new_piece():
    health = Health()
    path = path_of([0.0, 1.0], health)
    shift = np.array([5e4, 0.0, 0.0])
    for time in (2.0, 3.0, 4.0):
        path.put(time, tuple(true_place(time) + shift))
    assert health.counts == {"jumps of the platform": 1}
    assert not health.dropped
    asked = np.array([0.5, 1.0, 1.5, 2.0, 2.5])
    places = path.at(asked)
    assert places.known.tolist() == [True, True, False, True, True]
    assert places.position[4] == pytest.approx(true_place(2.5) + shift)
    path.put(1.5, tuple(true_place(1.5)))
    assert path.at(np.array([1.2])).position[0] == pytest.approx(true_place(1.2))
    path.put(1.7, (0.0, 0.0, 0.0))
    assert health.dropped == {"fixes that jump": 1}


def test_duplicates_old_and_senseless_fixes_are_dropped():
    health = Health()
    path = path_of([100.0, 101.0, 100.0], health)
    path.put(50.0, (0.0, 0.0, 0.0))
    path.put(102.0, (np.nan, 0.0, 0.0))
    path.put(102.0, (1e12, 0.0, 0.0))
    assert health.dropped == {
        "fixes of a time that has one": 1,
        "fixes older than the path": 1,
        "fixes that are nowhere": 2,
    }


def test_memory_is_bounded():
    path = PlatformPath(LIMITS, Health())
    for time in np.arange(0.0, 500.0, 0.5):
        path.put(float(time), tuple(true_place(time)))
    asked = np.array([path.end - LIMITS.memory, path.end - 1.25])
    assert path.at(asked).known.all()
    assert not path.at(np.array([100.0])).known.any()
