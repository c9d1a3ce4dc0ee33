# SPDX-License-Identifier: Apache-2.0
"""Every number of the book's second chapter, and the simulated video that its formulas are held to."""

from __future__ import annotations

from dataclasses import replace

import pytest

from radar_eval.published import gate_video, level_quantisation, time_gate
from radar_eval.published.registry import RESULTS
from radar_eval.published.result import to_digits

NAMES = {
    "kuzmin-2-quantisation": 150,
    "kuzmin-2-sampling": 45,
    "kuzmin-2-time-gate": 30,
    "kuzmin-2-pulse-in-gate": 90,
}


@pytest.fixture(scope="module", params=sorted(NAMES))
def rows(request):
    found = list(RESULTS[request.param].compute())
    assert len(found) >= NAMES[request.param]
    return found


def test_every_row_holds(rows):
    assert [row for row in rows if not row.holds] == []


def test_labels_name_one_number_each(rows):
    labels = [row.label for row in rows]
    assert len(set(labels)) == len(labels)


def test_what_does_not_follow_is_explained(rows):
    for row in rows:
        differs = row.published is not None and abs(row.published - row.expected) > 2 * max(
            row.tolerance, to_digits(row.published)
        )
        assert bool(row.finding) or not differs, row


def test_rows_are_computed_and_not_copied(monkeypatch):
    """A calculator that is wrong must show: the rows fail where it enters."""
    monkeypatch.setattr(level_quantisation, "least_risk_threshold", lambda a: a / 2.0)
    wrong = [row for row in level_quantisation._least_risk() if not row.holds]
    assert len(wrong) >= 8


def test_simulated_rows_feel_the_noise_model(monkeypatch):
    book = gate_video.gate_video("book")
    slow = replace(book, envelope=gate_video.gate_video("physical").envelope)
    monkeypatch.setattr(time_gate, "gate_video", lambda model: slow)
    assert [row for row in time_gate._noise() if not row.holds]
