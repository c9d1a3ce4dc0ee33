# SPDX-License-Identifier: Apache-2.0
"""The study of initiation: its plots, its counting and its picture, in small."""

from __future__ import annotations

import numpy as np
import pytest

from radar_eval.figures.initiation import draw_initiation
from radar_eval.figures.style import as_png
from radar_eval.studies.initiation_trials import (
    DETECTION,
    LONGEST_DELAY,
    PERIOD,
    Outcome,
    make_trial,
    rules,
    try_rule,
)
from secondary_proc.calculators.track_detection import track_detection
from secondary_proc.parameters import TrackerParameters


def rule(family, label):
    return next(r for r in rules() if (r.family, r.label) == (family, label))


def test_plots_are_those_of_the_targets_and_as_many_false_ones():
    trial = make_trial(50.0, 60, 30, seed=3)
    assert (np.diff(trial.rows["time_offset"]) >= 0.0).all()
    assert len(trial.first) == 30
    # The targets' plots are stronger by far, on average.
    count = len(trial.rows)
    assert abs(count - 50.0 * 60) < 30 * 60
    assert np.nanmin(trial.first) >= 12 * PERIOD
    again = make_trial(50.0, 60, 30, seed=3)
    assert np.array_equal(trial.rows.view("V1"), again.rows.view("V1"))


def test_without_false_plots_the_delay_is_the_calculated_one():
    outcome = try_rule(make_trial(0.5, 45, 60, seed=2), rule("l of m", "3/4"))
    confirmed = track_detection(np.full(40, DETECTION), 3, 4)
    # Scans from the scan before the first to confirmation, less the wait for the first plot.
    expected = (1.0 - confirmed).sum() - (1.0 / DETECTION - 1.0)
    assert outcome.false_tracks == 0
    assert outcome.targets == 60
    assert abs(outcome.delay - expected) < 4.0 * 1.0 / np.sqrt(60)


def test_a_weaker_rule_is_quicker_and_lets_more_through():
    trial = make_trial(80.0, 30, 20, seed=4)
    loose, sure = (try_rule(trial, rule("l of m", label)) for label in ("2/2", "4/5"))
    assert loose.false_tracks > 10 * max(sure.false_tracks, 1)
    assert loose.delay < sure.delay < LONGEST_DELAY


def test_rules_can_be_set():
    for each in rules():
        TrackerParameters(**each.parameters)
    assert len({(each.family, each.label) for each in rules()}) == len(rules())


@pytest.mark.parametrize("none", [0])
def test_the_figure_shows_every_outcome(none):
    made = [
        Outcome(r.family, r.label, r.wanted, density, 15.0 * n, 1.0 + n, n, 10)
        for density in (100.0, 300.0)
        for n, r in enumerate(rules(), start=none)
    ]
    figure = draw_initiation(made)
    points = [line for axes in figure.axes for line in axes.lines if line.get_marker() == "o"]
    assert len(points) == len(made)
    assert as_png(figure, dpi=40).startswith(b"\x89PNG")
