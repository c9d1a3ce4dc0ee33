# SPDX-License-Identifier: Apache-2.0
"""Emitters located per second: all in one call against filterpy's extended Kalman filter, emitter by emitter."""

from __future__ import annotations

import time

import numpy as np
import pytest
from filterpy.kalman import ExtendedKalmanFilter

from bearing_tracker.emitters import DEFAULT_FILTER, FILTERS, FilterSettings, Prior

STEPS = 8
PERIOD = 2.0
STD = 0.01


def bearings(emitters, seed=1):
    """Observer's places, shape (T, 2), and azimuths, shape (T, n)."""
    random = np.random.default_rng(seed)
    seconds = PERIOD * np.arange(STEPS + 1)
    observer = np.column_stack([150.0 * seconds, 40.0 * np.sin(seconds)])
    places = random.uniform([-40e3, 20e3], [40e3, 100e3], (emitters, 2))
    relative = places - observer[:, None]
    azimuth = np.arctan2(relative[..., 0], relative[..., 1])
    return observer, azimuth + STD * random.standard_normal(azimuth.shape)


def begun(name, emitters):
    chosen = FILTERS[name](FilterSettings())
    observer, azimuth = bearings(emitters)
    places = np.repeat(observer[:, None], emitters, axis=1)
    prior = Prior.between(5e3, 150e3, speed_std=15.0, emitters=emitters)
    belief = chosen.start(azimuth[0], np.full(emitters, STD), places[0], prior)
    return chosen, belief, places, azimuth


def updates_per_second(benchmark, name, emitters):
    chosen, belief, places, azimuth = begun(name, emitters)
    seconds, std = np.full(emitters, PERIOD), np.full(emitters, STD)
    heard = np.ones(emitters, dtype=bool)

    def work():
        later = belief
        for look in range(1, STEPS + 1):
            later = chosen.step(later, seconds, places[look], azimuth[look], std, heard)

    if benchmark is not None:
        benchmark.pedantic(work, rounds=5, warmup_rounds=1)
        return emitters * STEPS / benchmark.stats.stats.min
    times = []
    for _ in range(4):
        begin = time.perf_counter()
        work()
        times.append(time.perf_counter() - begin)
    return emitters * STEPS / min(times)


def filterpy_updates_per_second(emitters):
    _, belief, places, azimuth = begun("ekf", emitters)
    step = np.eye(4) + PERIOD * np.eye(4, k=2)

    def jacobian(x, place):
        east, north = x[0, 0] - place[0], x[1, 0] - place[1]
        square = east**2 + north**2
        return np.array([[north / square, -east / square, 0.0, 0.0]])

    def seen(x, place):
        return np.array([[np.arctan2(x[0, 0] - place[0], x[1, 0] - place[1])]])

    def wrapped(a, b):
        return np.mod(a - b + np.pi, 2 * np.pi) - np.pi

    filters = []
    for row in range(emitters):
        one = ExtendedKalmanFilter(dim_x=4, dim_z=1)
        one.x, one.P = belief.mean[row, 0, 0][:, None], belief.covariance[row, 0, 0]
        one.F, one.Q, one.R = step, 1e-4 * np.eye(4), np.array([[STD**2]])
        filters.append(one)
    begin = time.perf_counter()
    for look in range(1, STEPS + 1):
        for row, one in enumerate(filters):
            place = (places[look, row],)
            one.predict()
            one.update(
                azimuth[look, row], jacobian, seen, args=place, hx_args=place, residual=wrapped
            )
    return emitters * STEPS / (time.perf_counter() - begin)


@pytest.mark.parametrize("name", [DEFAULT_FILTER, "range_parameterised_ckf", "ekf", "ckf"])
def test_against_filterpy(benchmark, ratio, name):
    ours = updates_per_second(benchmark, name, 1000)
    peer = max(filterpy_updates_per_second(100) for _ in range(3))
    each = 7 if name.startswith("range") else 1
    ratio(
        f"emitters, {name}, 1000 at once",
        ours / peer * each,
        f"times filterpy's EKF, filter by filter; {ours:.0f} emitters/s against {peer / each:.0f}",
    )


def test_growth(benchmark, ratio):
    few = updates_per_second(None, DEFAULT_FILTER, 100)
    many = updates_per_second(benchmark, DEFAULT_FILTER, 5000)
    ratio("emitters, rate of 5000 over that of 100", many / few, "near 1 is linear growth")


def test_estimates(benchmark, ratio):
    chosen, belief, *_ = begun(DEFAULT_FILTER, 1000)
    benchmark(lambda: chosen.estimate(belief))
    rate = 1000 / benchmark.stats.stats.min
    ratio("emitters, estimates with information and bound", rate, "a second")
