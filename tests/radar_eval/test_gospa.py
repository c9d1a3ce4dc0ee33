# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import datetime

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from stonesoup.metricgenerator.ospametric import GOSPAMetric
from stonesoup.types.state import State

from radar_eval.gospa import gospa

NOW = datetime.datetime(2000, 1, 1)


def points(generator, number):
    return generator.uniform(0.0, 3000.0, (number, 2))


def as_states(positions):
    return [State([[x], [y]], timestamp=NOW) for x, y in positions]


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 8), st.integers(0, 8), st.integers(0, 10_000), st.sampled_from([1.0, 2.0]))
def test_it_equals_stonesoup(targets, tracks, seed, order):
    generator = np.random.default_rng(seed)
    x, y = points(generator, targets), points(generator, tracks)
    if not targets and not tracks:
        return
    ours = gospa(x, y, cutoff=800.0, order=order)
    metric = GOSPAMetric(c=800.0, p=order)
    theirs = metric.compute_gospa_metric(as_states(y), as_states(x))[0].value
    assert ours.distance == pytest.approx(theirs["distance"], rel=1e-9)
    assert ours.localisation == pytest.approx(theirs["localisation"], rel=1e-9, abs=1e-9)
    assert ours.missed == pytest.approx(theirs["missed"], rel=1e-9, abs=1e-9)
    assert ours.false == pytest.approx(theirs["false"], rel=1e-9, abs=1e-9)


@given(st.integers(0, 6), st.integers(0, 6), st.integers(0, 6), st.integers(0, 1000))
def test_it_is_a_metric(a, b, c, seed):
    generator = np.random.default_rng(seed)
    x, y, z = points(generator, a), points(generator, b), points(generator, c)

    def distance(one, other):
        return gospa(one, other, cutoff=1000.0).distance

    assert distance(x, x) == 0.0
    assert distance(x, y) == pytest.approx(distance(y, x))
    assert distance(x, z) <= distance(x, y) + distance(y, z) + 1e-6


def test_its_parts_are_what_they_say():
    result = gospa([[0, 0], [5000, 0]], [[30, 40], [0, 9000], [9000, 9000]], cutoff=1000.0)
    assert result.localisation == 2500.0
    assert result.missed == 1000.0**2 / 2
    assert result.false == 2 * 1000.0**2 / 2
    assert result.assigned == 1
    assert result.distance**2 == pytest.approx(result.localisation + result.missed + result.false)


def test_impossible_parameters_are_refused():
    with pytest.raises(ValueError, match="cutoff"):
        gospa([], [], cutoff=0.0)
    with pytest.raises(ValueError, match="order"):
        gospa([], [], cutoff=1.0, order=0.5)
