# SPDX-License-Identifier: Apache-2.0
"""The tables of CFAR thresholds and of required signal-to-noise ratios: complete, and all rows hold."""

from __future__ import annotations

import pytest

from radar_eval.published.registry import RESULTS

# 90 points of five quantities; 18 points of eleven, and one value of another library.
SIZES = {"cfar-thresholds": 90 * 5, "required-snr": 18 * 11 + 1}


@pytest.mark.parametrize("name", SIZES)
def test_every_row_holds(name):
    rows = list(RESULTS[name].compute())
    assert [row for row in rows if not row.holds] == []
    assert len({row.label for row in rows}) == len(rows) == SIZES[name]
    assert all(row.tolerance < 1e-5 for row in rows if row.label.endswith("dB"))
