# SPDX-License-Identifier: Apache-2.0
"""Two targets near each other make two plots where the signal shows two; one target stays one."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.stats import binom

from primary_proc.calculators.pulse.burst_shape import pulses_in_burst
from primary_proc.detectors.burst_detector import bursts
from primary_proc.estimators.azimuth_estimator import Centres
from primary_proc.plots.close_targets import TargetSeparator
from primary_proc.plots.ring_merge import Groups

CONFIDENCE = 0.999
SCAN = 4096
BEAM = np.radians(1.4) / (2 * np.pi / SCAN)
AMPLITUDE = np.sqrt(2.0) * 10.0
# Where pairs are put: far enough apart for the cells beside one to be free of the next.
PULSES, CELLS = np.meshgrid(np.arange(100, SCAN - 100, 130), np.arange(40, 480, 55))
PAIRS = np.stack([PULSES.ravel(), CELLS.ravel()], 1)


def plots_a_pair(
    scene, extract, cut, beams, cells, *, seed=1, fast=False, single=False, **parameters
):
    """How many plots each pair of equal targets gives, at 20 dB, by its distance in azimuth and range."""
    rng = np.random.default_rng(seed)
    middle = PAIRS + np.stack([rng.uniform(-5, 5, len(PAIRS)), rng.random(len(PAIRS))], 1)
    half = np.array([beams * BEAM / 2.0, cells / 2.0])
    targets = [(p, c, AMPLITUDE) for p, c in middle + half]
    if not single:
        targets += [(p, c, AMPLITUDE) for p, c in middle - half]
    made = scene(seed, SCAN, 512, targets, pulses_per_scan=SCAN, beamwidth_deg=1.4, fast=fast)
    plots, _ = extract(
        made.sectors(*cut(256, made)), beamwidth_deg=1.4, false_plots_per_scan=0.1, **parameters
    )
    pulse = plots["azimuth"] / made.step
    cell = (plots["range"] - made.range_start) / made.range_step
    near = (np.abs(pulse - PAIRS[:, :1]) < 60) & (np.abs(cell - PAIRS[:, 1:]) < 8)
    return near.sum(axis=1)


@pytest.mark.parametrize("fast", [False, True])
@pytest.mark.parametrize("estimator", ["start-end", "weights-amplitude"])
def test_one_target_is_one_plot(scene, extract, cut, fast, estimator):
    count = plots_a_pair(
        scene, extract, cut, 0.0, 0.0, single=True, fast=fast, azimuth_estimator=estimator
    )
    assert (count == 1).mean() > 0.99


@pytest.mark.parametrize(
    ("beams", "cells", "share"),
    [
        (1.25, 0.0, 0.70),
        (1.5, 0.0, 0.97),
        (2.0, 0.0, 0.97),
        (0.0, 2.0, 0.65),
        (0.0, 2.5, 0.93),
        (0.0, 3.0, 0.97),
        (1.25, 1.0, 0.70),
    ],
)
def test_two_targets_are_two_plots(scene, extract, cut, beams, cells, share):
    """In azimuth by beamwidths and in range by cells; the phase between the two decides where they overlap."""
    count = plots_a_pair(scene, extract, cut, beams, cells)
    low = binom.ppf(1.0 - CONFIDENCE, len(PAIRS), share)
    assert (count == 2).sum() >= low
    assert (count >= 3).mean() < 0.05
    assert (count == 0).sum() == 0


def test_without_the_rule_they_were_one(scene, extract, cut):
    """A valley that no signal has turns the rule for a common ring off; it is what tells these apart."""
    with_rule = plots_a_pair(scene, extract, cut, 1.5, 0.0)
    without = plots_a_pair(scene, extract, cut, 1.5, 0.0, split_valley_db=60.0)
    assert (without == 2).mean() < 0.7 < (with_rule == 2).mean()


class Flat:
    """A signal in which nothing is to be seen."""

    def around(self, ring, pulse, reach):
        return np.ones((len(ring), 2 * reach + 1))


def separated(rows, powers, positions, std=0.5):
    """What becomes of one group: sets of (ring, start)."""
    ring, start, end = np.array(rows).T
    table = bursts(ring, start, end, False)
    table["power"] = powers
    separator = TargetSeparator("gaussian", 19.0, 4.7, 6, 76, 3.0)
    centres = Centres(np.array(positions, float), np.full(len(rows), std))
    found = separator.separate(Groups(table, np.zeros(1, np.int64)), centres, Flat())
    parts = np.split(found.groups.bursts, found.groups.first[1:])
    assert len(found.burst) == len(found.centres.position) == sum(map(len, parts))
    return {frozenset((int(b["ring"]), int(b["start"])) for b in part) for part in parts}


def test_a_weak_ring_between_two_strong_ones():
    rows = [(10, 100, 125), (11, 104, 121), (12, 100, 125), (13, 103, 122)]
    whole = {frozenset((ring, start) for ring, start, _ in rows)}
    place = [110.0] * 4
    assert separated(rows, [100.0, 60.0, 100.0, 50.0], place) == whole, "no valley of 3 dB"
    apart = {frozenset({(10, 100), (11, 104)}), frozenset({(12, 100), (13, 103)})}
    assert separated(rows, [100.0, 40.0, 90.0, 50.0], place) == apart
    beyond = {frozenset({(10, 100)}), frozenset({(11, 104), (12, 100), (13, 103)})}
    assert separated(rows, [90.0, 40.0, 100.0, 50.0], place) == beyond, "with the stronger side"


def test_azimuths_that_contradict_each_other():
    """Two rings, each with a burst of its own 24 pulses from the other's."""
    rows = [(10, 100, 125), (11, 124, 149)]
    assert len(separated(rows, [100.0, 80.0], [110.0, 134.0])) == 2
    assert len(separated(rows, [100.0, 80.0], [110.0, 134.0], std=8.0)) == 1, "not beyond doubt"
    assert len(separated(rows, [100.0, 8.0], [110.0, 134.0])) == 1, "a fragment"


def test_an_extended_echo_stays_whole():
    many_rings = [(ring, 100, 125) for ring in range(10, 17)]
    assert len(separated(many_rings, [100, 10, 100, 10, 100, 10, 100], [110.0] * 7)) == 1
    long_chain = [(10, 100, 125), (11, 126, 150), (10, 152, 180)]
    assert len(separated(long_chain, [100.0] * 3, [110.0, 136.0, 164.0])) == 1


def test_a_point_target_has_the_width_the_separator_allows(scene, extract):
    """The longest bursts of single targets, at strengths up to 60 dB, are not suspicious."""
    pulses = pulses_in_burst("gaussian", np.radians(1.4), 2 * np.pi / SCAN)
    targets = [(p, 60.5, 8.0 * 1.6**n) for n, p in enumerate(range(80, 1000, 76))]
    made = scene(4, 1080, 128, targets, pulses_per_scan=SCAN, beamwidth_deg=1.4)
    plots, _ = extract(made.sectors(), beamwidth_deg=1.4, false_plots_per_scan=0.1)
    strong = plots[plots["snr_db"] > 12.0]
    assert len(strong) == len(targets)
    assert strong["pulse_count"].max() < 2.6 * pulses
