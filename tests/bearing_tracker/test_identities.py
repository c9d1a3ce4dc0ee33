# SPDX-License-Identifier: Apache-2.0
"""No number is given twice, not even by the process that follows one that was killed."""

from __future__ import annotations

import numpy as np

from bearing_tracker.identities import FIRST_OWN, Identities
from radar_common.tables import NANOSECONDS

START = 1_700_000_000 * NANOSECONDS


def test_wanted_numbers_are_given_once():
    identities = Identities()
    identities.start(START)
    first = identities.take(np.array([7, 0, 7, 8]))
    assert first[[0, 3]].tolist() == [7, 8]
    assert (first[[1, 2]] >= FIRST_OWN).all()
    assert len(set(first.tolist()) | set(identities.take(np.array([7, 8, 9])).tolist())) == 7


def test_a_restart_in_the_middle_gives_other_numbers():
    numbers = []
    for seconds in (0, 10, 20):
        identities = Identities()
        identities.start(START + seconds * NANOSECONDS)
        identities.start(START)
        numbers += identities.take(np.zeros(500, int)).tolist()
    assert len(set(numbers)) == 1500
    assert max(numbers) < 1 << 32
