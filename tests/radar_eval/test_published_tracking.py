# SPDX-License-Identifier: Apache-2.0
"""Every number of the book's fourth chapter."""

from __future__ import annotations

import re

import pytest

from radar_eval.published import false_tracks
from radar_eval.published.registry import RESULTS
from radar_eval.published.result import to_digits

NAMES = {
    "kuzmin-4-motion": 14,
    "kuzmin-4-gates": 35,
    "kuzmin-4-selection": 55,
    "kuzmin-4-track-parameters": 90,
    "kuzmin-4-alpha-beta": 60,
    "kuzmin-4-alpha-beta-dynamics": 180,
    "kuzmin-4-false-tracks": 80,
    "kuzmin-4-track-detection": 70,
    "kuzmin-4-estimation": 230,
}


@pytest.fixture(scope="module")
def page(repository):
    return (repository / "docs" / "kuzmin_chapter_4.md").read_text("utf-8")


@pytest.fixture(scope="module")
def computed():
    return {name: list(RESULTS[name].compute()) for name in NAMES}


@pytest.fixture(scope="module", params=sorted(NAMES))
def rows(request, computed):
    found = computed[request.param]
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


def test_false_tracks_are_computed_and_not_copied(monkeypatch):
    monkeypatch.setattr(false_tracks, "false_tracks_kept", lambda empty, misses: float(misses))
    wrong = [row for row in false_tracks.false_tracks() if not row.holds]
    assert len(wrong) >= 20


def test_the_page_counts_the_rows(page, computed):
    counts = {name: len(rows) for name, rows in computed.items()}
    tabled = dict(re.findall(r"^\| `(kuzmin-4-[a-z-]+)` \| [^|]+ \| (\d+) \|", page, re.MULTILINE))
    assert {name: int(count) for name, count in tabled.items()} == counts
    assert f"{sum(counts.values())} rows" in page
