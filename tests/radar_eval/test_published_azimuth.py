# SPDX-License-Identifier: Apache-2.0
"""Every row of the first and third chapters' azimuth results holds, and what differs is explained."""

from __future__ import annotations

import pytest

from radar_eval.published.registry import RESULTS
from radar_eval.published.result import to_digits


@pytest.mark.parametrize(
    ("name", "rows"), [("kuzmin-1-azimuth", 30), ("kuzmin-3-potential-accuracy", 95)]
)
def test_every_row_holds_and_what_differs_is_explained(name, rows):
    found = list(RESULTS[name].compute())
    assert len(found) >= rows
    assert [row for row in found if not row.holds] == []
    assert len({row.label for row in found}) == len(found)
    for row in found:
        differs = row.published is not None and abs(row.published - row.expected) > 2 * max(
            row.tolerance, to_digits(row.published)
        )
        assert bool(row.finding) or not differs, row
