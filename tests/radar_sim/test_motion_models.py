# SPDX-License-Identifier: Apache-2.0
"""Random motion has the moments that its model states, and is the same whenever one looks."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from radar_common.parameters import ParameterError
from radar_sim.motion import Fleet, Path
from radar_sim.motion.correlated import CorrelatedMotion, WanderSection
from radar_sim.motion.increments import FirstIncrementsMotion, SecondIncrementsMotion
from radar_sim.motion.polynomials import PiecewiseMotion, PolynomialMotion
from radar_sim.motion.sections import MOTIONS, draw_paths
from radar_sim.motion.speed_course import ArcsMotion, SpeedCourseMotion
from radar_sim.motion.turns import centripetal_turn

SIZE = 500
COURSE, SPEED = 0.7, 200.0
# Four standard deviations of the variance of a normal sample, two components of each target.
SPREAD = 4.0 * np.sqrt(2.0 / (2 * SIZE))


def fleet(motion=None, wander=None, size=SIZE, seed=0):
    paths = [Path(1000.0, -500.0, SPEED, COURSE, appears=3.0)] * size
    return Fleet(draw_paths(paths, motion, wander, np.random.default_rng(seed)))


def states(fleet, elapsed):
    """Position about the straight way and velocity, north + i east, shape (targets, times)."""
    target = np.broadcast_to(np.arange(len(fleet))[:, None], (len(fleet), len(elapsed)))
    time = np.broadcast_to(3.0 + np.asarray(elapsed, dtype=float), target.shape)
    state = fleet.state(target, time)
    straight = -500.0 + 1000.0j + SPEED * np.exp(1j * COURSE) * np.asarray(elapsed)
    return state.y + 1j * state.x - straight, state.vy + 1j * state.vx


def variance(values):
    return np.mean(np.abs(values) ** 2, axis=0) / 2.0


def correlation(values, lag):
    product = values[:, lag:] * np.conj(values[:, :-lag])
    return float(np.mean(product.real) / np.mean(np.abs(values) ** 2))


@pytest.mark.parametrize("name", list(MOTIONS))
def test_a_state_does_not_depend_on_who_asks_when(name):
    moving, times = fleet(MOTIONS[name](duration=100.0), size=5), np.linspace(0.0, 150.0, 31)
    together = states(moving, times)
    for number in (30, 0, 17):
        alone = states(moving, times[number : number + 1])
        for part in (0, 1):
            np.testing.assert_array_equal(alone[part][:, 0], together[part][:, number])


@pytest.mark.parametrize("name", list(MOTIONS))
def test_a_path_has_no_gaps_and_its_velocity_is_the_rate_of_its_position(name):
    moving, step = fleet(MOTIONS[name](duration=60.0), size=10), 3e-3
    position, velocity = states(moving, np.arange(13_000, 23_000) * step)
    moved = np.diff(position, axis=1) / step + SPEED * np.exp(1j * COURSE)
    error = np.abs(moved - (velocity[:, 1:] + velocity[:, :-1]) / 2.0)
    # Where the velocity jumps, or its slope, the rate over the joint lies between: a few joints of 10,000.
    jumps = np.abs(np.diff(velocity, axis=1))
    assert (error <= jumps + 20.0 * step).all()
    assert np.median(error) < 1e-6
    assert np.mean(jumps > 0.1) < 1e-3


@pytest.mark.parametrize("name", list(MOTIONS))
def test_after_its_duration_it_moves_straight_on(name):
    _, velocity = states(fleet(MOTIONS[name](duration=40.0), size=20), [40.1, 500.0])
    np.testing.assert_allclose(velocity[:, 0], velocity[:, 1], atol=1e-9)


def test_first_increments_are_independent():
    model = FirstIncrementsMotion(step=5.0, increment_std=30.0, duration=500.0)
    position, _ = states(fleet(model), 5.0 * np.arange(101))
    increments = np.diff(position, axis=1)
    assert variance(increments).mean() == pytest.approx(900.0, rel=SPREAD / 10.0)
    for lag in (1, 2, 5):
        assert abs(correlation(increments, lag)) < 4.0 / np.sqrt(2 * SIZE * (100 - lag))
    # Variance grows as the number of steps.
    for steps in (10, 40, 100):
        assert variance(position[:, steps]) == pytest.approx(900.0 * steps, rel=SPREAD)


def test_second_increments_are_independent():
    model = SecondIncrementsMotion(step=4.0, increment_std=6.0, duration=400.0)
    position, velocity = states(fleet(model), 4.0 * np.arange(101))
    second = np.diff(position, n=2, axis=1)
    assert variance(second).mean() == pytest.approx(36.0, rel=SPREAD / 9.9)
    for lag in (1, 2, 5):
        assert abs(correlation(second, lag)) < 4.0 / np.sqrt(2 * SIZE * (99 - lag))
    for n in (10, 100):
        growth = 36.0 * n * (n + 1) * (2 * n + 1) / 6.0
        assert variance(position[:, n]) == pytest.approx(growth, rel=SPREAD)
    straight = SPEED * np.exp(1j * COURSE)
    assert variance(velocity[:, 49] - straight) == pytest.approx(36.0 / 16.0 * 50, rel=SPREAD)


@pytest.mark.parametrize(
    "model",
    [
        CorrelatedMotion(step=1.0, acceleration_std=3.0, correlation_time=10.0, duration=300.0),
        PiecewiseMotion(acceleration_std=3.0, leg_duration=10.0, duration=300.0),
    ],
    ids=["sequence", "switching"],
)
def test_acceleration_is_correlated_exponentially(model):
    # The velocity is linear within a step of one and, at most joints apart, within a leg of the other.
    _, velocity = states(fleet(model), np.arange(0.0, 299.0, 0.5) + 1e-3)
    acceleration = np.diff(velocity, axis=1)[:, ::2] / 0.5
    # Neighbours are alike over 10 s, so that 300 s hold some 15 independent values.
    assert variance(acceleration).mean() == pytest.approx(9.0, rel=SPREAD)
    for lag in (1, 4, 10):
        spread = 4.0 / np.sqrt(2 * SIZE * 300.0 / (2 * 10.0))
        assert correlation(acceleration, lag) == pytest.approx(np.exp(-lag / 10.0), abs=spread)


def test_white_acceleration_moves_as_its_formula_says():
    model = CorrelatedMotion(step=2.0, acceleration_std=0.5, correlation_time=0.0, duration=200.0)
    position, velocity = states(fleet(model), 2.0 * np.arange(101))
    acceleration = np.diff(velocity, axis=1) / 2.0
    assert variance(acceleration).mean() == pytest.approx(0.25, rel=SPREAD / 10.0)
    assert abs(correlation(acceleration, 1)) < 4.0 / np.sqrt(2 * SIZE * 99)
    total = velocity - SPEED * np.exp(1j * COURSE)
    moved = position[:, :-1] + 2.0 * total[:, :-1] + 2.0 * acceleration
    np.testing.assert_allclose(position[:, 1:], moved, atol=1e-8)


def test_a_polynomial_has_the_coefficients_asked_for():
    model = PolynomialMotion(velocity_std=5.0, acceleration_std=0.4, jerk_std=0.02)
    position, velocity = states(fleet(model), np.arange(5.0))
    third = np.diff(position, n=3, axis=1)
    np.testing.assert_allclose(third[:, 0], third[:, 1], atol=1e-6)
    jerk = third[:, 0]
    acceleration = np.diff(position, n=2, axis=1)[:, 0] - jerk
    first = velocity[:, 0] - SPEED * np.exp(1j * COURSE)
    for values, std in ((jerk, 0.02), (acceleration, 0.4), (first, 5.0)):
        assert variance(values) == pytest.approx(std**2, rel=SPREAD)


def test_some_legs_of_a_piecewise_polynomial_are_uniform():
    model = PiecewiseMotion(acceleration_std=3.0, leg_duration=20.0, uniform=0.6, duration=400.0)
    _, velocity = states(fleet(model), np.arange(0.0, 380.0, 20.0)[:, None].ravel())
    _, soon = states(fleet(model), np.arange(0.0, 380.0, 20.0) + 0.01)
    uniform = np.abs(soon - velocity) < 1e-9
    # Looks a mean leg apart are correlated by 1 / e; counted as half as many.
    assert uniform.mean() == pytest.approx(0.6, abs=4.0 * np.sqrt(0.24 / (uniform.size / 2)))


@given(
    speed=st.floats(20.0, 500.0),
    centripetal=st.floats(-40.0, 40.0),
    acceleration=st.floats(-1.0, 10.0) | st.floats(-1e-3, 1e-3),
    elapsed=st.floats(0.0, 15.0),
)
def test_a_pull_across_the_course_turns_the_faster_the_slower(
    speed, centripetal, acceleration, elapsed
):
    turn, way = centripetal_turn(speed, centripetal, acceleration, elapsed)

    def rates(t, state):
        moving = speed + acceleration * t
        return [centripetal / moving, moving * np.cos(state[0]), moving * np.sin(state[0])]

    flown = solve_ivp(rates, (0.0, elapsed), [0.0, 0.0, 0.0], rtol=1e-10, atol=1e-9).y[:, -1]
    assert float(turn) == pytest.approx(flown[0], abs=1e-6)
    assert complex(way) == pytest.approx(complex(flown[1], flown[2]), abs=1e-3)


def test_manoeuvres_of_speed_and_course_have_the_share_and_size_asked_for():
    model = SpeedCourseMotion(manoeuvre=0.4, acceleration_std=0.3, centripetal_std=5.0)
    paths = draw_paths([Path(0.0, 0.0, SPEED, 0.0)] * 50, model, None, np.random.default_rng(1))
    legs = [leg for path in paths for leg in path.legs]
    duration = np.array([leg.duration for leg in legs])
    assert duration.mean() == pytest.approx(30.0, rel=4.0 / np.sqrt(len(legs)) + 1.0 / 120.0)
    for name, share in (("centripetal", 5.0), ("acceleration", 0.3)):
        values = np.array([getattr(leg, name) for leg in legs])
        moved = values[values != 0.0]
        assert abs(len(moved) / len(legs) - 0.4) < 4.0 * np.sqrt(0.24 / len(legs))
        assert np.mean(moved**2) == pytest.approx(share**2, rel=4.0 * np.sqrt(2.0 / len(moved)))
        assert all(leg.turn_rate == 0.0 for leg in legs)


def test_a_change_of_speed_ends_at_the_bounds():
    model = SpeedCourseMotion(
        manoeuvre=1.0, acceleration_std=5.0, centripetal_std=0.0, speed_min=150.0, speed_max=260.0
    )
    _, velocity = states(fleet(model, size=30), np.arange(0.0, 1000.0, 7.0))
    assert np.abs(velocity).min() >= 150.0 - 1e-6
    assert np.abs(velocity).max() <= 260.0 + 1e-6
    assert np.ptp(np.abs(velocity)) > 100.0


def test_arcs_have_constant_speed_and_normal_curvature():
    model = ArcsMotion(curvature_std=2e-4, leg_duration=20.0)
    moving = fleet(model, size=50)
    _, velocity = states(moving, np.arange(0.0, 3600.0, 5.0))
    np.testing.assert_allclose(np.abs(velocity), SPEED, rtol=1e-12)
    paths = draw_paths([Path(0.0, 0.0, SPEED, 0.0)] * 50, model, None, np.random.default_rng(2))
    curvature = np.array([leg.turn_rate / SPEED for path in paths for leg in path.legs])
    spread = 4.0 * np.sqrt(2.0 / len(curvature))
    assert np.mean(curvature**2) == pytest.approx(4e-8, rel=spread)


def test_wander_is_stationary_and_correlated_exponentially():
    wander = WanderSection(std=40.0, correlation_time=12.0, step=4.0, duration=400.0)
    offset, _ = states(fleet(None, wander), 4.0 * np.arange(101))
    for number in (0, 50, 99):
        assert variance(offset[:, number]) == pytest.approx(1600.0, rel=SPREAD)
    spread = 4.0 / np.sqrt(2 * SIZE * 400.0 / (2 * 12.0))
    assert abs(offset.mean()) < 40.0 * spread
    for lag in (1, 3, 6):
        assert correlation(offset, lag) == pytest.approx(np.exp(-lag / 3.0), abs=spread)


def test_wander_is_added_to_legs_and_to_random_motion_alike():
    wander = WanderSection(std=40.0)
    model = CorrelatedMotion(duration=50.0)
    both, alone = fleet(model, wander, size=3), fleet(model, None, size=3)
    times = np.linspace(0.0, 60.0, 13)
    offset = states(both, times)[0] - states(alone, times)[0]
    assert np.abs(offset).std() > 5.0
    np.testing.assert_allclose(
        states(both, [9000.0])[0] - states(alone, [9000.0])[0],
        states(both, [3600.0])[0] - states(alone, [3600.0])[0],
        atol=1e-5,
    )


def test_one_fleet_holds_targets_of_every_kind():
    rng, paths = np.random.default_rng(5), [Path(0.0, 0.0, SPEED, 0.0)]
    for model in MOTIONS.values():
        paths += draw_paths([Path(0.0, 0.0, SPEED, 0.0)], model(duration=60.0), None, rng)
    mixed = Fleet(paths)
    time = np.full(len(paths), 50.0)
    together = mixed.state(np.arange(len(paths)), time)
    for row, path in enumerate(paths):
        alone = Fleet([path]).state(np.array([0]), time[:1])
        assert (alone.x[0], alone.vy[0]) == (together.x[row], together.vy[row])
    assert mixed.state(np.array([0]), time[:1]).y[0] == pytest.approx(SPEED * 50.0)


def test_too_many_steps_are_refused():
    with pytest.raises(ParameterError, match="at most 200000"):
        CorrelatedMotion(step=0.01, duration=1e6)
