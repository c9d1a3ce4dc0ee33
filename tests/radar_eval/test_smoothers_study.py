# SPDX-License-Identifier: Apache-2.0
"""The study of smoothers: flights are what they are called, and the default follows them best."""

from __future__ import annotations

import numpy as np
import pytest

from radar_eval.figures.smoothers import draw_smoothers
from radar_eval.figures.style import as_png
from radar_eval.studies.smoother_flights import FLIGHTS, QUIET, Radar, plots_of
from radar_eval.studies.smoother_outcome import Outcome
from radar_eval.studies.smoother_trials import track_alone
from radar_eval.studies.smoothers import CONTESTANTS, PERIODS, compare_smoothers
from secondary_proc.parameters import TrackerParameters

GRAVITY = 9.80665


@pytest.mark.parametrize("flight", FLIGHTS, ids=lambda flight: flight.name)
def test_flights_manoeuvre_as_their_names_say(flight):
    radar = Radar(0.5, range_std=0.0, azimuth_std=0.0, detection=1.0)
    plotted = plots_of(flight, radar, 3, np.random.default_rng(1))
    seconds = np.diff(plotted.time, axis=0)[..., None]
    pull = np.linalg.norm(np.diff(plotted.velocity, axis=0) / seconds, axis=-1)
    middle = plotted.time[1:]
    assert pull[middle < QUIET].max() < 1e-6
    wanted = {"change of speed": 3.0, "straight": 0.0}.get(flight.name)
    if wanted is None:
        wanted = float(flight.name.split()[1]) * GRAVITY
    assert pull.max() == pytest.approx(wanted, rel=0.01, abs=1e-6)
    np.testing.assert_allclose(plotted.range, np.linalg.norm(plotted.position, axis=-1))


def test_a_lone_straight_target_keeps_its_track_and_its_gate():
    radar = Radar(4.0)
    plotted = plots_of(FLIGHTS[0], radar, 50, np.random.default_rng(2))
    trial = track_alone(plotted, radar, TrackerParameters())
    assert (trial.opened.sum(axis=0) == 1).all()
    assert trial.lost.mean() < 0.01
    taken = np.isfinite(trial.state[..., 0])
    assert (taken <= plotted.found).all()
    assert taken.sum() > 0.9 * plotted.found.sum()


def test_the_default_follows_best_what_it_is_set_for():
    outcomes = compare_smoothers(30, seed=3, periods=(4.0,), flights=FLIGHTS[1:3])
    assert TrackerParameters().smoother == next(iter(CONTESTANTS))
    best = {o.flight: o for o in outcomes if o.smoother == "imm"}
    for outcome in outcomes:
        ours = best[outcome.flight]
        assert ours.position_rms < 1.1 * outcome.position_rms
        assert ours.lost <= outcome.lost + 0.1
    assert all(o.position_rms < 1.1 * o.plot_rms for o in best.values())


def test_the_figure_shows_every_outcome():
    made = [
        Outcome(name, flight.name, period, 9, 100.0, 50.0, 5.0, 0.1, 1.0, 4.0)
        for period in PERIODS
        for flight in FLIGHTS
        for name in CONTESTANTS
    ]
    figure = draw_smoothers(made)
    points = sum(
        len(line.get_xdata())
        for axes in figure.axes
        for line in axes.lines
        if line.get_marker() != "None"
    )
    assert points == 3 * len(made)
    assert as_png(figure, dpi=20).startswith(b"\x89PNG")
