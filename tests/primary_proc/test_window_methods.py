# SPDX-License-Identifier: Apache-2.0
"""Every sliding-window detector does what its design predicts: in noise, on targets, in the whole extractor."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.stats import binom, norm, poisson

from primary_proc.calculators.pulse.burst_shape import burst_shape
from primary_proc.methods.requirements import Requirements
from primary_proc.methods.window_methods import WINDOW_METHODS
from primary_proc.methods.window_targets import DETECTION_TRIALS
from primary_proc.normalisers.fixed_level import FixedLevel
from radar_common.frames import wrap_pi

CONFIDENCE = 0.999
SIGMAS = norm.isf((1.0 - CONFIDENCE) / 2.0)
# A prediction by trial has an error of its own.
TRIED = SIGMAS * 0.5 / np.sqrt(DETECTION_TRIALS)
ASKED = Requirements(
    false_plots=250.0,
    rings=400,
    pulses_per_scan=1024.0,
    gap=6,
    pattern="gaussian",
    pulses=12.4,
    snr_db=6.0,
)
NOISE_RINGS, NOISE_PULSES, BLOCK = 1200, 1792, 256
SNR_DB = (2.0, 4.0, 6.0)
TARGETS_TRIED = 1000


@pytest.fixture(params=list(WINDOW_METHODS), scope="module")
def settled(request):
    return WINDOW_METHODS[request.param].settle(ASKED)


@pytest.fixture(scope="module")
def noise():
    """Power of cells of noise over its mean."""
    rng = np.random.default_rng(3)
    return rng.standard_exponential((NOISE_PULSES, NOISE_RINGS), np.float32)


def detect(settled, ratios, longest=10_000):
    quantiser = settled.quantiser(FixedLevel(ratios.shape[1], 1.0))
    detector = settled.detector(ratios.shape[1], longest)
    found, ones = [], 0
    for first in range(0, len(ratios), BLOCK):
        found.append(detector.detect(quantiser.quantise(ratios[first : first + BLOCK]), first))
        ones += quantiser.ones
    return np.concatenate(found), ones


def test_noise_starts_bursts_as_often_as_predicted(settled, noise):
    """Bursts of noise come in crowds: those are counted like drops, and the bursts with the crowds' spread."""
    found, ones = detect(settled, noise)
    assert abs(ones / noise.size - settled.noise_probability) < SIGMAS * np.sqrt(
        settled.noise_probability / noise.size
    )
    expected = settled.false_starts * noise.size
    alone = settled.noise.last
    spread = np.sqrt(expected * (2.0 - alone) / alone)
    assert abs(len(found) - expected) < SIGMAS * spread
    found = found[np.lexsort((found["start"], found["ring"]))]
    follows = (found["ring"][1:] == found["ring"][:-1]) & (
        found["start"][1:] - found["end"][:-1] <= ASKED.gap
    )
    crowds = len(found) - np.count_nonzero(follows)
    low, high = poisson.interval(CONFIDENCE, expected * alone)
    assert 0.98 * low <= crowds <= 1.02 * high, "the share of crowds is good to 0.01"
    assert expected > 500


def echoes(rng, snr_db, target, count=TARGETS_TRIED):
    """Targets anywhere between two pulses, one a ring; powers over the noise's mean, and their places."""
    offset = rng.uniform(-0.5, 0.5, count)
    shape = burst_shape(ASKED.pattern, ASKED.pulses, offset, book=False).T
    voltage = np.sqrt(2.0) * 10.0 ** (snr_db / 20.0) * shape
    if target == "fast":
        voltage = voltage * np.abs(rng.standard_normal((*shape.shape, 2)) @ [1, 1j]) / np.sqrt(2.0)
    lead = np.zeros((40, count))
    voltage = np.concatenate([lead, voltage, lead])
    quadratures = rng.standard_normal((2, *voltage.shape))
    power = ((voltage + quadratures[0]) ** 2 + quadratures[1] ** 2) / 2.0
    return power.astype(np.float32), 40 + (len(shape) - 1) / 2.0 + offset


@pytest.mark.parametrize("target", ["steady", "fast"])
def test_targets_are_detected_as_predicted(settled, target):
    rng = np.random.default_rng(17)
    near = 2.0 * ASKED.pulses
    for snr_db in SNR_DB:
        ratios, place = echoes(rng, snr_db, target)
        found, _ = detect(settled, ratios)
        middle = (found["start"] + found["end"]) / 2.0 - settled.window.pulses / 2.0
        hits = np.unique(found["ring"][np.abs(middle - place[found["ring"]]) < near])
        expected = float(settled.detection_probability(snr_db, target))
        low, high = (
            binom.interval(CONFIDENCE, TARGETS_TRIED, np.clip(expected + side * TRIED, 0, 1))[index]
            for side, index in ((-1, 0), (1, 1))
        )
        assert low <= len(hits) <= high, (snr_db, expected)


def test_a_strong_target_is_one_burst_where_its_errors_are_those_stated(settled):
    ratios, place = echoes(np.random.default_rng(23), 20.0, "steady")
    found, _ = detect(settled, ratios)
    share = settled.false_starts * ratios.size
    assert len(found) <= len(place) + poisson.isf(1.0 - CONFIDENCE, share) + share
    strongest = found[np.argsort(found["start"] - found["end"], kind="stable")]
    own = strongest[np.unique(strongest["ring"], return_index=True)[1]]
    assert len(own) == len(place), "each target has one"
    peak = ratios.max(axis=0)[own["ring"]]
    for table, position in (
        (settled.accuracy, (own["start"] + own["end"]) / 2.0),
        (settled.peak_accuracy, own["centre"]),
    ):
        bias, std = table.look_up(peak)
        error = position - place[own["ring"]] - bias
        assert abs(error.mean()) < SIGMAS * error.std() * np.sqrt(1 / len(place) + 1 / 3000)
        # A first peak far out makes heavy tails, and the variance of a variance is that of the fourth power.
        square = (error / std) ** 2
        spread = square.std() * np.sqrt(1.0 / len(place) + 1.0 / 2500)
        assert abs(square.mean() - 1.0) < SIGMAS * spread + 0.05


@pytest.mark.parametrize("name", ["count", "linear-sum"])
def test_the_shape_of_a_prediction(name):
    settled = WINDOW_METHODS[name].settle(ASKED)
    grid = np.array([[-12.0, 0.0, 4.0], [8.0, 16.0, 60.0]])
    for target in ("steady", "slow", "fast", "slow-dominant", "fast-dominant"):
        found = settled.detection_probability(grid, target)
        assert found.shape == grid.shape
        assert (np.diff(found.ravel()) >= 0.0).all()
        assert found[0, 0] < 0.05
        assert found[1, 2] > 0.99
    chance = np.geomspace(1e-9, 0.3, 40)
    assert (np.diff(settled.quality(chance)) <= 0.0).all()
    assert settled.quality(np.array([1e-8]))[0] > 0.99


def test_all_keep_to_an_order(settled):
    """No window detects a steady target better than the likelihood ratio, none much worse than the count."""
    best, least = (
        float(WINDOW_METHODS[name].settle(ASKED).detection_probability(4.0, "steady"))
        for name in ("likelihood", "count")
    )
    assert least - 0.02 < float(settled.detection_probability(4.0, "steady")) < best + 0.02


SCENE = [(60.2, 20.5, 14.0), (170.0, 70.5, 14.0), (280.7, 0.5, 14.0), (330.0, 94.5, 14.0)]
QUIET = {"false_plots_per_scan": 0.05, "weights_snr_db": 6.0}


def test_the_extractor_gives_one_plot_a_target_wherever_messages_and_north_lie(scene, extract, cut):
    made = scene(12, 420, 96, SCENE)
    truth = np.array([pulse for pulse, _, _ in SCENE])
    for detector in WINDOW_METHODS:
        whole, health = extract(made.sectors(), detector=detector, **QUIET)
        assert len(whole) == len(SCENE), detector
        assert not health.dropped
        place = whole["azimuth"] / made.step
        error = (place - truth) / (whole["azimuth_std"] / made.step)
        assert np.abs(error).max() < 5.0, detector
        assert whole["quality"].min() > 0.999
        plots, _ = extract(made.sectors(*cut(5, made)), detector=detector, **QUIET)
        assert plots["azimuth"] == pytest.approx(whole["azimuth"], abs=1e-9), detector
        for name in ("range", "azimuth_std", "amplitude", "quality"):
            assert plots[name] == pytest.approx(whole[name], rel=1e-6), detector
        turned, health = extract(
            made.rotated(5.3).sectors(*cut(64, made)), detector=detector, **QUIET
        )
        assert not health.dropped
        assert np.abs(wrap_pi(turned["azimuth"] - whole["azimuth"] - 5.3)).max() < 1e-9, detector


def test_false_plots_are_as_many_as_wanted(scene, extract, cut):
    """Also under a noise level that is estimated, of which the detector knows nothing."""
    scans, wanted = 2, 80.0
    made = scene(21, scans * 1024, 256)
    tables = made.sectors(*cut(256, made))
    for detector in WINDOW_METHODS:
        plots, health = extract(
            tables, detector=detector, false_plots_per_scan=wanted, weights_snr_db=6.0
        )
        predicted = health.watches["plots per scan (expected: noise alone)"].expected
        assert predicted == pytest.approx(wanted, rel=0.03), detector
        low, high = poisson.interval(CONFIDENCE, scans * wanted)
        assert 0.98 * low <= len(plots) <= 1.02 * high, detector
        # Quality is a share of noise, hence uniform in it.
        assert 0.4 < plots["quality"].mean() < 0.65, detector


def test_what_is_out_of_reach_is_said():
    few = Requirements(
        false_plots=1e-3, rings=1000, pulses_per_scan=4096.0, gap=3, pattern="gaussian",
        pulses=5.0, second_threshold=6,
    )  # fmt: skip
    with pytest.raises(ValueError, match="second threshold of 6 is over 5"):
        WINDOW_METHODS["count"].settle(few)
    with pytest.raises(ValueError, match="merge"):
        WINDOW_METHODS["count"].settle(
            Requirements(
                false_plots=8e3, rings=400, pulses_per_scan=1024.0, gap=10, pattern="gaussian", pulses=12.0
            )
        )  # fmt: skip


def test_a_new_rotation_has_a_window_of_its_own(scene, extract, cut):
    """Half as many pulses a turn: the register is half as long, and the targets stay one plot each."""
    slow, fast = (
        scene(5, 512, 64, [(p, 30.5, 14.0) for p in range(100, 480, 80)], pulses_per_scan=count)
        for count in (1024, 512)
    )
    tables = slow.sectors(*cut(64, slow))
    for table in fast.sectors(*cut(64, fast)):
        table.rows["azimuth"] = (table.rows["azimuth"] + 512 * slow.step) % (2 * np.pi)
        tables.append(type(table)(table.stamp + 512 * 10**6, table.rows))
    plots, health = extract(tables, detector="count", **QUIET)
    assert health.counts["changes of the rotation"] >= 1
    assert len(plots) == 10
