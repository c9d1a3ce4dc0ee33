# SPDX-License-Identifier: Apache-2.0
"""The closed forms of motion against numerical integration and against what one sees at once."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad

from radar_sim.motion import Fleet, Leg, Path, displacement

LEGS = st.builds(
    Leg,
    duration=st.floats(0.5, 120.0),
    turn_rate=st.floats(-0.2, 0.2),
    acceleration=st.floats(-0.5, 5.0),
)
PATHS = st.builds(
    Path,
    x=st.floats(-1e5, 1e5),
    y=st.floats(-1e5, 1e5),
    speed=st.floats(300.0, 600.0),
    course=st.floats(-10.0, 10.0),
    legs=st.lists(LEGS, max_size=4).map(tuple),
    appears=st.floats(0.0, 100.0),
)


def state_of(fleet, target, time):
    return fleet.state(np.array([target]), np.array([float(time)]))


@given(
    speed=st.floats(0.0, 500.0),
    course=st.floats(-7.0, 7.0),
    turn_rate=st.floats(-0.3, 0.3) | st.floats(-1e-4, 1e-4),
    acceleration=st.floats(-5.0, 5.0),
    elapsed=st.floats(-5.0, 60.0),
)
def test_displacement_is_the_integral_of_velocity(speed, course, turn_rate, acceleration, elapsed):
    way = complex(displacement(speed, course, turn_rate, acceleration, elapsed))

    def velocity(t):
        return (speed + acceleration * t) * np.exp(1j * (course + turn_rate * t))

    north = quad(lambda t: velocity(t).real, 0.0, elapsed)[0]
    east = quad(lambda t: velocity(t).imag, 0.0, elapsed)[0]
    assert way == pytest.approx(north + 1j * east, abs=1e-5)


@given(st.lists(PATHS, min_size=1, max_size=4))
def test_position_and_velocity_are_continuous_from_leg_to_leg(paths):
    fleet = Fleet(paths)
    for target, path in enumerate(paths):
        time = path.appears
        for leg in path.legs:
            time += leg.duration
            before, after = (
                state_of(fleet, target, time - 1e-7),
                state_of(fleet, target, time + 1e-7),
            )
            for name in ("x", "y", "vx", "vy"):
                assert getattr(before, name) == pytest.approx(getattr(after, name), abs=1e-3)


@given(PATHS, st.floats(0.0, 300.0))
def test_velocity_is_the_rate_of_position(path, since):
    fleet, step = Fleet([path]), 1e-3
    time = path.appears + since
    before, here, after = (state_of(fleet, 0, time + k * step) for k in (-1, 0, 1))
    # Over a joint of two legs the rate changes by at most the jump of the acceleration times the step.
    for position, rate in (("x", "vx"), ("y", "vy")):
        moved = (getattr(after, position) - getattr(before, position)) / (2.0 * step)
        assert moved == pytest.approx(getattr(here, rate), abs=1.0)


def test_a_straight_leg_leads_straight_on_for_ever():
    state = state_of(Fleet([Path(1000.0, 2000.0, 100.0, np.pi / 2)]), 0, 500.0)
    assert (state.x[0], state.y[0]) == pytest.approx((51_000.0, 2000.0))
    assert (state.vx[0], state.vy[0]) == pytest.approx((100.0, 0.0), abs=1e-9)


def test_a_full_circle_to_the_right_comes_back():
    rate = np.radians(3.0)
    fleet = Fleet([Path(0.0, 0.0, 150.0, 0.0, (Leg(120.0, turn_rate=rate),))])
    quarter, whole = state_of(fleet, 0, 30.0), state_of(fleet, 0, 120.0)
    radius = 150.0 / rate
    assert (quarter.x[0], quarter.y[0]) == pytest.approx((radius, radius))
    assert (whole.x[0], whole.y[0]) == pytest.approx((0.0, 0.0), abs=1e-6)


def test_a_target_is_there_from_take_off_to_landing():
    fleet = Fleet([Path(0.0, 0.0, 1.0, 0.0, appears=5.0, disappears=9.0)])
    times = np.array([4.999, 5.0, 8.999, 9.0])
    assert fleet.present(np.zeros(4, int), times).tolist() == [False, True, True, False]


def test_no_target_is_no_trouble():
    fleet = Fleet([])
    assert len(fleet) == 0
    assert fleet.state(np.empty(0, int), np.empty(0)).x.shape == (0,)
