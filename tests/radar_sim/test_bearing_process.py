# SPDX-License-Identifier: Apache-2.0
"""Bearing processes are stationary with the covariance stated, and violations follow chain and script."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from radar_sim.bearings.process import BearingProcesses, transition
from radar_sim.bearings.sections import ActiveChannelSection, BearingProcessSection, IntervalSection
from radar_sim.bearings.violations import Violations, one_hot

ALPHA, MU = st.floats(1e-5, 1.0), st.floats(1e-3, 5.0)


@given(ALPHA, MU, st.floats(0.0, 10.0), st.floats(0.0, 10.0))
def test_two_steps_are_one(alpha, mu, first, second):
    parts = transition(alpha, mu, second) @ transition(alpha, mu, first)
    np.testing.assert_allclose(parts, transition(alpha, mu, first + second), atol=1e-9)


@given(ALPHA, MU, st.floats(0.01, 10.0))
def test_a_step_keeps_the_covariance(alpha, mu, step):
    covariance = np.array([[1.0, -alpha], [-alpha, alpha**2 + mu**2]])
    gamma = np.sqrt(1.0 - np.exp(-2.0 * alpha * step)) * np.array([[1.0, 0.0], [-alpha, mu]])
    phi = transition(alpha, mu, step)
    after = phi @ covariance @ phi.T + gamma @ gamma.T
    np.testing.assert_allclose(after, covariance, rtol=1e-12, atol=1e-12)


def test_processes_have_the_autocorrelation_of_the_model():
    section = BearingProcessSection(
        azimuth_deg=30.0, deviation_deg=4.0, correlation_time=10.0, frequency=0.5
    )
    size, times = 1000, np.arange(0.0, 21.0)
    processes = BearingProcesses([section] * size, np.random.default_rng(0))
    bearing, rate = processes.state(np.repeat(times[:, None], size, axis=1))
    about = bearing - np.radians(30.0)
    variance = np.radians(4.0) ** 2
    for lag in (0, 1, 3, 6, 13):
        expected = np.exp(-lag / 10.0) * np.cos(0.5 * lag)
        # A product of two normal variables of correlation r has the variance 1 + r².
        bound = 4.0 * np.sqrt((1.0 + expected**2) / size)
        for begin in (0, 7):
            found = np.mean(about[begin] * about[begin + lag]) / variance
            assert abs(found - expected) < bound
    for step in (0, 20):
        assert np.var(rate[step]) == pytest.approx(
            variance * (0.01 + 0.25), rel=4.0 * np.sqrt(2.0 / size)
        )


def test_a_process_is_the_same_whoever_asks_and_runs_on_between_its_steps():
    sections = [BearingProcessSection(), BearingProcessSection(step=0.5, frequency=1.0)]
    whole, parts = (BearingProcesses(sections, np.random.default_rng(1)) for _ in range(2))
    times = np.repeat(np.arange(0.0, 900.0, 0.25)[:, None], 2, axis=1)
    bearing, rate = whole.state(times)
    for rows in (slice(0, 7), slice(3000, 3600), slice(40, 50)):
        np.testing.assert_array_equal(parts.state(times[rows])[0], bearing[rows])
    step = transition(1 / 350.0, 0.16, 0.25)
    moved = step @ np.array([bearing[4, 0], rate[4, 0]])
    assert moved == pytest.approx([bearing[5, 0], rate[5, 0]])


def test_scripted_violations_are_where_the_script_has_them():
    script = [IntervalSection(begins=5.0, ends=8.0), IntervalSection(begins=20.0, ends=21.0)]
    violations = Violations(ActiveChannelSection(), script, 1.0, np.random.default_rng(0))
    at = violations.at(np.arange(0.0, 25.0))
    assert np.flatnonzero(at).tolist() == [5, 6, 7, 20]


def test_a_chain_of_violations_has_the_probabilities_asked_for():
    section = ActiveChannelSection(begin_probability=0.1, end_probability=0.3)
    number = 40_000
    violations = Violations(section, [], 0.5, np.random.default_rng(2))
    states = violations.at(0.5 * np.arange(number))
    assert not states[0]
    begins = np.mean(states[1:][~states[:-1]])
    ends = np.mean(~states[1:][states[:-1]])
    assert begins == pytest.approx(0.1, abs=4.0 * np.sqrt(0.09 / np.sum(~states)))
    assert ends == pytest.approx(0.3, abs=4.0 * np.sqrt(0.21 / np.sum(states)))
    again = Violations(section, [], 0.5, np.random.default_rng(2))
    for first in (100, 3000, 0):
        times = 0.5 * np.arange(first, first + 50) + 0.2
        np.testing.assert_array_equal(again.at(times), states[first : first + 50])


def test_health_is_one_hot_and_empty_where_there_is_no_state():
    health = one_hot(np.array([False, True]))
    np.testing.assert_array_equal(health[:, :2], [[1.0, 0.0], [0.0, 1.0]])
    assert np.isnan(health[:, 2:]).all()
