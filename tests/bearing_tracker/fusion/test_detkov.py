# SPDX-License-Identifier: Apache-2.0
"""The paper's test in the configuration in which its first row comes out, 120 runs that no search has seen."""

from __future__ import annotations

import numpy as np
import pytest

from bearing_tracker.fusion import FILTERS
from radar_eval.published import detkov
from radar_eval.published.detkov_trials import (
    REGRESSION,
    follow,
    normalised_error,
    rms_angle,
    simulate,
)

FUSED = 2


@pytest.fixture(scope="module")
def trials():
    return simulate(REGRESSION, 120, np.random.default_rng(7))


@pytest.fixture(scope="module")
def dcmp(trials):
    return follow(REGRESSION, trials, FILTERS["dcmp"](REGRESSION.channels), ["map", "mmse"])


def test_the_first_row(trials, dcmp):
    (active, passive, fused), _ = rms_angle(dcmp, trials, "map")
    assert fused == pytest.approx(0.0899, abs=0.003)
    assert active == pytest.approx(0.142, abs=0.006)
    assert passive == pytest.approx(0.221, abs=0.012)


def test_both_channels_are_better_than_either_and_no_filter_beats_the_one_that_knows(trials, dcmp):
    oracle = follow(REGRESSION, trials, FILTERS["oracle"](REGRESSION.channels), ["mmse"])
    known, _ = rms_angle(oracle, trials, "mmse")
    for output in ("map", "mmse"):
        found, _ = rms_angle(dcmp, trials, output)
        assert (found >= known).all()
        assert found[FUSED] < min(found[:FUSED])
    assert rms_angle(dcmp, trials, "mmse")[0][FUSED] <= rms_angle(dcmp, trials, "map")[0][FUSED]
    # A filter that is told everything is consistent: within five standard errors of 120 independent runs.
    assert normalised_error(oracle, trials, "mmse") == pytest.approx(1.0, abs=0.05)


def test_the_covariance_tells_the_error(trials, dcmp):
    for output in ("map", "mmse"):
        assert 0.8 < normalised_error(dcmp, trials, output)[FUSED] < 1.1


def test_jamming_and_silence_are_seen(dcmp):
    step = np.arange(1, REGRESSION.steps + 1)
    active, passive = np.moveaxis(dcmp.undisturbed[:, FUSED], -1, 0)
    jammed, silent = (step >= 55) & (step <= 100), (step >= 205) & (step <= 250)
    assert np.mean(active[jammed].mean(axis=1) < 0.5) >= 0.9
    assert np.mean(passive[silent].mean(axis=1) < 0.5) >= 0.9
    assert np.mean(active[step <= 50] > 0.5) > 0.9
    assert np.mean(passive[step <= 50] > 0.5) > 0.9


def test_a_part_of_the_table_holds(monkeypatch):
    monkeypatch.setattr(detkov, "_RUNS", 40)
    monkeypatch.setattr(detkov, "_LITERAL", {})
    kept = {k: v for k, v in detkov._REGRESSION.items() if k[0] == "as printed"}
    monkeypatch.setattr(detkov, "_REGRESSION", kept)
    rows = list(detkov.detkov_table())
    assert [row.label for row in rows if not row.holds] == []
    assert len(rows) == 3
    assert all(row.standard_error > 0.0 for row in rows)
    assert all(row.finding for row in rows)


@pytest.mark.study
def test_the_whole_table_holds():
    rows = list(detkov.detkov_table())
    assert len(rows) == 54
    assert [row.label for row in rows if not row.holds] == []
