# SPDX-License-Identifier: Apache-2.0
"""Gates, selection and resolution against simulated plots."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from secondary_proc.calculators.alpha_beta_dynamics import dynamic_error, random_variance
from secondary_proc.calculators.gate_size import (
    alpha_beta_gate,
    hit_probability,
    line_gate,
    sigmas_for_hits,
    three_gates,
)
from secondary_proc.calculators.plot_selection import (
    nearest_in_metres,
    select_plot,
    selection_outcome,
)
from secondary_proc.calculators.sequential_filter import Gains, run_filter
from secondary_proc.calculators.track_resolution import (
    confusion_probability,
    own_plot_probability,
    resolved_distance,
)
from secondary_proc.expected_quality import correct_selection, gate_probability


@pytest.mark.parametrize("shape", ["coordinate", "rectangle", "ellipse"])
def test_gates_are_hit_as_often_as_simulated(shape):
    random = np.random.default_rng(3)
    off = random.normal(size=(40_000, 2))
    inside = {
        "coordinate": np.abs(off[:, 0]) <= 1.7,
        "rectangle": np.abs(off).max(axis=1) <= 1.7,
        "ellipse": np.hypot(*off.T) <= 1.7,
    }[shape]
    expected = float(hit_probability(1.7, shape))
    assert abs(inside.mean() - expected) < 4 * np.sqrt(expected * (1 - expected) / len(off))
    assert sigmas_for_hits(expected, shape) == pytest.approx(1.7)


def test_the_ellipse_is_the_gate_of_the_tracker():
    assert hit_probability(2.5) == pytest.approx(gate_probability(2.5))


@given(alpha=st.floats(0.1, 1.0), beta=st.floats(0.02, 1.0))
def test_the_gate_of_a_filter_has_its_errors(alpha, beta):
    narrow, medium, wide = three_gates(alpha, beta, intensity=0.7, misses=2)
    assert narrow == pytest.approx(3.0 * np.sqrt(float(random_variance("residual", alpha, beta))))
    assert medium - narrow == pytest.approx(0.7 * float(dynamic_error("predicted", alpha, beta)))
    assert wide > medium


def test_after_misses_a_gate_has_the_errors_of_a_simulation():
    random = np.random.default_rng(5)
    alpha, beta, misses, scans, tracks = 0.5, 0.2, 2, 80, 20_000
    none = np.zeros(scans)
    gains = Gains(none + alpha, none + beta, none, none)
    start = (np.zeros(tracks), np.zeros(tracks))
    _, smoothed, velocity = run_filter(gains, random.normal(size=(scans, tracks)), start)
    ahead = smoothed[-1] + (misses + 1) * velocity[-1]
    expected = alpha_beta_gate(alpha, beta, misses=misses, sigmas=1.0) ** 2
    found = (random.normal(size=tracks) - ahead).var()
    assert abs(found - expected) < 4 * expected * np.sqrt(2.0 / tracks)
    # A target that accelerates, and no errors.
    time = np.arange(scans + 10.0)
    path = 0.5 * time**2
    _, smoothed, velocity = run_filter(gains, path[:scans], (np.zeros(()), np.zeros(())))
    lag = path[scans + misses] - smoothed[-1] - (misses + 1) * velocity[-1]
    quiet = alpha_beta_gate(alpha, beta, misses=misses)
    moved = alpha_beta_gate(alpha, beta, misses=misses, intensity=1.0)
    assert moved - quiet == pytest.approx(lag, rel=1e-6)


def test_a_line_gains_from_plots_and_loses_by_misses():
    assert np.all(np.diff(line_gate(np.arange(2, 20))) < 0)
    assert np.all(np.diff(line_gate(5, np.arange(5))) > 0)


@pytest.mark.parametrize("detection", [1.0, 0.7])
def test_scans_come_out_as_calculated(detection):
    random = np.random.default_rng(6)
    trials, density, gate = 40_000, 0.08, 2.5
    own = random.normal(size=(trials, 2))
    distance = np.where(random.random(trials) < detection, (own**2).sum(axis=1), np.inf)
    # The nearest false plot: the area free of them is exponential.
    false = random.exponential(1.0 / (np.pi * density), trials)
    false, distance = (
        np.where(false > gate**2, np.inf, false),
        np.where(distance > gate**2, np.inf, distance),
    )
    outcome = selection_outcome(density, 1.0, gate, detection)
    assert outcome.correct + outcome.wrong + outcome.none == pytest.approx(1.0)
    for expected, share in (
        (float(outcome.correct), np.mean(distance < false)),
        (float(outcome.wrong), np.mean(false < distance)),
        (float(outcome.none), np.mean(np.isinf(false) & np.isinf(distance))),
    ):
        assert abs(share - expected) < 4 * np.sqrt(expected * (1 - expected) / trials)


@given(density=st.floats(1e-4, 1.0), along=st.floats(0.1, 5.0), across=st.floats(0.1, 5.0))
def test_the_ellipse_never_selects_worse_than_the_circle(density, along, across):
    ellipse = correct_selection(np.array([density]), np.array([(along * across) ** 2]))[0]
    assert nearest_in_metres(density, along, across) <= ellipse + 1e-12
    equal = nearest_in_metres(density, along, along)
    assert equal == pytest.approx(1.0 / (1.0 + 2.0 * np.pi * density * along**2))


def test_rules_select_their_own_plots():
    differences = np.array([[2.0, 0.0], [0.0, 1.5], [2.1, 0.0]])
    covariance = np.stack([np.diag([4.0, 0.25]), np.diag([4.0, 0.25]), np.diag([4.0, 0.01])])
    assert select_plot(differences, covariance, "distance") == 1
    assert select_plot(differences, covariance, "ellipse") == 0
    # The third is nearly as near and much more accurate.
    assert select_plot(differences, covariance, "likelihood") == 2
    assert select_plot(differences, covariance, "distance", sigmas=2.0) == 0
    assert select_plot(differences, covariance, sigmas=0.5) is None
    assert select_plot(np.zeros((0, 2)), np.zeros((0, 2, 2))) is None


@pytest.mark.parametrize("distance", [0.2, 1.0, 2.5])
def test_tracks_are_confused_as_often_as_simulated(distance):
    random = np.random.default_rng(7)
    trials = 40_000
    first, second = random.normal(size=trials), distance + random.normal(size=trials)
    own = np.abs(first) < np.abs(second)
    other = np.abs(second - distance) < np.abs(first - distance)
    one_to_one = first**2 + (second - distance) ** 2 < second**2 + (first - distance) ** 2
    for expected, share in (
        (float(own_plot_probability(distance)), own.mean()),
        (float(confusion_probability(distance, "nearest")), np.mean(~(own & other))),
        (float(confusion_probability(distance, "assignment")), np.mean(~one_to_one)),
    ):
        assert abs(share - expected) < 4 * np.sqrt(expected * (1 - expected) / trials)


@given(distance=st.floats(0.0, 6.0))
def test_one_plot_for_one_track_confuses_least(distance):
    assert confusion_probability(distance, "assignment") <= confusion_probability(
        distance, "nearest"
    )
    wide = own_plot_probability(distance, 9.0)
    assert wide == pytest.approx(float(own_plot_probability(distance)), abs=1e-7)


@pytest.mark.parametrize("rule", ["book", "nearest", "assignment"])
def test_resolved_distance_is_the_inverse(rule):
    m = resolved_distance(0.05, rule)
    assert confusion_probability(m, rule) == pytest.approx(0.05)


def test_unknown_names_are_refused():
    with pytest.raises(ValueError, match="circle"):
        hit_probability(1.0, "circle")
    with pytest.raises(ValueError, match="circle"):
        sigmas_for_hits(0.5, "circle")
    with pytest.raises(ValueError, match="amplitude"):
        select_plot(np.zeros((1, 2)), np.eye(2)[None], "amplitude")
    with pytest.raises(ValueError, match="guess"):
        confusion_probability(1.0, "guess")
    with pytest.raises(ValueError, match="sign"):
        resolved_distance(0.9, "assignment")
