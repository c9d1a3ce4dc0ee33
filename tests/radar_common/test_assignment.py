# SPDX-License-Identifier: Apache-2.0
"""The sparse assignment is as good as the dense one over all pairs."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import linear_sum_assignment

from radar_common.assignment import assign

SIZES = st.integers(0, 12)


@given(SIZES, SIZES, st.floats(0.0, 1.0), st.integers(0, 2**31))
def test_no_other_assignment_is_worth_more(lefts, rights, density, seed):
    random = np.random.default_rng(seed)
    left, right = np.nonzero(random.random((lefts, rights)) < density)
    gain = random.uniform(0.1, 5.0, len(left))
    chosen = assign(left, right, gain)
    assert len(set(left[chosen])) == len(set(right[chosen])) == len(chosen)
    assert (np.diff(chosen) > 0).all()
    table = np.zeros((lefts, rights))
    table[left, right] = gain
    best = table[linear_sum_assignment(table, maximize=True)].sum()
    assert gain[chosen].sum() == pytest.approx(best)


def test_a_large_gain_of_one_does_not_cost_two_smaller_ones_more():
    # 0-0 is worth 3, but 0-1 and 1-0 together are worth 4.
    left, right = np.array([0, 0, 1]), np.array([0, 1, 0])
    assert assign(left, right, np.array([3.0, 2.0, 2.0])).tolist() == [1, 2]
    assert assign(left, right, np.array([5.0, 2.0, 2.0])).tolist() == [0]
