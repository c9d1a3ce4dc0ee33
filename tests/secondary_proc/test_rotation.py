# SPDX-License-Identifier: Apache-2.0
"""The antenna's rotation from nothing but times and azimuths."""

from __future__ import annotations

import numpy as np
import pytest

from secondary_proc.rotation import Rotation

TWO_PI = 2.0 * np.pi


def feed(rotation, times, azimuths, step=0.125):
    order = np.argsort(times, kind="stable")
    times, azimuths = times[order], azimuths[order]
    edges = np.arange(times[0], times[-1] + step, step)
    for first, last in zip(
        np.searchsorted(times, edges), np.searchsorted(times, edges + step), strict=True
    ):
        rotation.observe(times[first:last], azimuths[first:last])


def turning(random, period, begin, end, per_second, sense=1.0, phase=1.0, noise=0.002):
    times = np.sort(random.uniform(begin, end, random.poisson(per_second * (end - begin))))
    turn = sense * TWO_PI * times / period + phase
    return times, np.mod(turn + noise * random.standard_normal(len(times)), TWO_PI)


@pytest.mark.parametrize("sense", [1.0, -1.0])
@pytest.mark.parametrize("period", [0.5, 2.5, 4.0, 12.0])
def test_period_and_sense_are_found(period, sense):
    rotation = Rotation()
    feed(rotation, *turning(np.random.default_rng(1), period, 0.0, 3 * period, 50.0, sense))
    assert rotation.locked
    assert rotation.known
    assert rotation.sense == sense
    assert rotation.period == pytest.approx(period, rel=2e-3)


def test_it_is_found_within_half_a_turn_of_a_busy_sky():
    rotation = Rotation()
    feed(rotation, *turning(np.random.default_rng(2), 4.0, 0.0, 2.0, 50.0))
    assert rotation.locked
    assert rotation.period == pytest.approx(4.0, rel=0.03)


@pytest.mark.parametrize("per_second", [500.0, 5000.0])
def test_it_is_found_and_kept_among_thousands_of_plots(per_second):
    rotation = Rotation()
    feed(rotation, *turning(np.random.default_rng(2), 4.0, 0.0, 12.0, per_second))
    assert rotation.locked
    assert rotation.locks == 1
    assert rotation.period == pytest.approx(4.0, rel=2e-3)


def test_three_targets_suffice():
    # Each at its own azimuth, moving; nothing else.
    random = np.random.default_rng(3)
    rotation = Rotation()
    turns = np.arange(12)
    azimuth = np.concatenate([0.4 + 0.01 * turns, 2.9 - 0.02 * turns, 4.0 + 0.005 * turns])
    times = 4.0 * (np.tile(turns, 3) + azimuth / TWO_PI)
    feed(rotation, times, azimuth + 0.002 * random.standard_normal(len(azimuth)))
    assert rotation.period == pytest.approx(4.0, rel=0.01)
    assert rotation.sense == 1.0


def test_one_target_does_not_contradict_the_hint():
    turns = np.arange(10)
    rotation = Rotation(hint=4.0)
    feed(rotation, 4.0 * turns + 0.7, np.full(10, 1.1))
    assert rotation.period == pytest.approx(4.0, rel=0.01)


@pytest.mark.parametrize("factor", [3.0, 1.0 / 3.0])
def test_a_change_of_the_period_is_followed(factor):
    random = np.random.default_rng(4)
    rotation = Rotation()
    feed(rotation, *turning(random, 4.0, 0.0, 20.0, 30.0))
    feed(rotation, *turning(random, 4.0 * factor, 20.0, 20.0 + 8.0 * factor, 30.0, phase=2.0))
    assert rotation.locked
    assert rotation.period == pytest.approx(4.0 * factor, rel=0.01)


def test_in_doubt_no_passage_is_told_but_not_for_ever():
    random = np.random.default_rng(5)
    rotation = Rotation()
    feed(rotation, *turning(random, 4.0, 0.0, 20.0, 30.0))
    assert rotation.tells_passages(20.0)
    times = np.linspace(20.0, 21.0, 40)
    feed(rotation, times, random.uniform(0, TWO_PI, 40))
    assert not rotation.locked
    assert not rotation.tells_passages(21.0)
    assert rotation.tells_passages(21.0 + 9 * 4.0)


def test_a_lost_sector_and_wild_plots_do_no_harm():
    random = np.random.default_rng(6)
    times, azimuths = turning(random, 4.0, 0.0, 24.0, 40.0)
    seen = (azimuths < 2.0) | (azimuths > 4.0)
    times, azimuths = times[seen], azimuths[seen]
    wild = random.random(len(times)) < 0.1
    azimuths = np.where(wild, random.uniform(0, TWO_PI, len(times)), azimuths)
    rotation = Rotation()
    feed(rotation, times, azimuths)
    assert rotation.locked
    assert rotation.period == pytest.approx(4.0, rel=0.01)


def test_noise_without_rotation_is_not_taken_for_one():
    random = np.random.default_rng(7)
    rotation = Rotation()
    feed(rotation, np.sort(random.uniform(0, 20.0, 400)), random.uniform(0, TWO_PI, 400))
    assert not rotation.locked
    assert not rotation.known


def test_after_a_long_silence_the_period_stays_and_the_phase_is_new():
    random = np.random.default_rng(8)
    rotation = Rotation()
    feed(rotation, *turning(random, 4.0, 0.0, 20.0, 30.0))
    times, azimuths = turning(random, 4.0, 3600.0, 3604.0, 30.0, phase=5.0)
    rotation.observe(times[:3], azimuths[:3])
    assert not rotation.locked
    assert rotation.period == pytest.approx(4.0, rel=0.01)
    feed(rotation, times[3:], azimuths[3:])
    assert rotation.locked
    assert rotation.period == pytest.approx(4.0, rel=0.02)
