# SPDX-License-Identifier: Apache-2.0
"""The picture shows targets where they are, in every direction, however the turn is cut into messages."""

from __future__ import annotations

import numpy as np
import pytest

from primary_proc.ppi import PlanPosition
from radar_common.tables import Table, sweep_dtype

PIXELS = 101
TARGETS = [(0.5, 90), (1.9, 40), (3.1, 70), (4.0, 20), (6.2, 60)]


@pytest.fixture
def rows():
    rng = np.random.default_rng(1)
    rows = np.zeros(720, sweep_dtype(100))
    rows["azimuth"] = np.arange(720) * (2 * np.pi / 720)
    rows["range_step"] = 10.0
    rows["video"] = rng.rayleigh(1.0, (720, 100))
    for azimuth, cell in TARGETS:
        rows["video"][np.abs(rows["azimuth"] - azimuth) < 0.03, cell] = 100.0
    return rows


@pytest.mark.parametrize("size", [720, 100, 7, 2])
@pytest.mark.parametrize("shift", [0, 333])
def test_targets_are_where_they_are(rows, size, shift):
    picture = PlanPosition(PIXELS)
    rows = np.roll(rows, -shift)
    complete = [
        picture.paint(Table(0, rows[first : first + size])) for first in range(0, len(rows), size)
    ]
    assert complete.count(True) <= 1
    for azimuth, cell in TARGETS:
        distance = (cell + 0.5) / 100 * (PIXELS / 2)
        row = round(50 - distance * np.cos(azimuth))
        column = round(50 + distance * np.sin(azimuth))
        assert picture.image[row - 1 : row + 2, column - 1 : column + 2].max() == 255, azimuth
    assert (picture.image == 255).sum() < 60
    assert not picture.image[0, 0], "outside the range"


def test_two_turns_are_two_pictures(rows):
    picture = PlanPosition(PIXELS)
    parts = np.split(np.concatenate([rows, rows]), 24)
    assert sum(picture.paint(Table(0, part)) for part in parts) == 2


def test_what_has_no_place_or_value_is_black(rows):
    picture = PlanPosition(PIXELS)
    rows["video"][:] = np.nan
    picture.paint(Table(0, rows))
    rows["azimuth"] = np.nan
    assert not picture.paint(Table(0, rows))
    assert not picture.image.any()
