# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import numpy as np
import pytest

from radar_eval.published import registry
from radar_eval.published.false_tracks import handed_over
from radar_eval.published.registry import RESULTS
from radar_eval.published.result import PublishedResult, Row, to_digits

FIRST_DELIVERY = {
    "kuzmin-3-program-detectors",
    "kuzmin-3-detection-probability",
    "kuzmin-3-azimuth-accuracy",
    "kuzmin-4-alpha-beta",
    "kuzmin-4-false-tracks",
    "kuzmin-4-gates",
}


def test_all_results_are_registered_under_their_names():
    assert set(RESULTS) >= FIRST_DELIVERY
    assert all(result.name == name for name, result in RESULTS.items())


@pytest.mark.parametrize("name", sorted(FIRST_DELIVERY))
def test_every_row_holds(command, name):
    result = command("reproduce", name, "--json")
    printed = result.json()
    assert printed["name"] == name
    assert printed["source"]
    assert len(printed["rows"]) >= 3
    assert [row["label"] for row in printed["rows"] if not row["holds"]] == []
    assert printed["holds"] is True
    assert result.code == 0
    for row in printed["rows"]:
        assert {"label", "published", "expected", "ours", "tolerance", "holds"} <= set(row)


@pytest.mark.parametrize("name", sorted(FIRST_DELIVERY))
def test_what_does_not_follow_is_explained(name):
    for row in RESULTS[name].compute():
        differs = row.published is not None and abs(row.published - row.expected) > 2 * max(
            row.tolerance, to_digits(row.published)
        )
        assert bool(row.finding) or not differs, row


def test_a_row_that_does_not_hold_fails_the_command(command, monkeypatch):
    wrong = PublishedResult("wrong", "nobody", lambda: [Row("two", 2.0, 2.0, 2.1, 0.01)])
    monkeypatch.setitem(registry.RESULTS, "wrong", wrong)
    result = command("reproduce", "wrong", "--json")
    assert result.code == 1
    assert result.json()["holds"] is False
    assert "DIFFERS" in command("reproduce", "wrong").out


def test_the_list_names_all(command):
    names = [line.split()[0] for line in command("reproduce", "--list").out.splitlines()]
    assert names == list(RESULTS)
    assert [r["name"] for r in command("reproduce", "--list", "--json").json()] == names


def test_an_unknown_name_is_one_clear_error(command):
    result = command("reproduce", "nothing")
    assert result.code == 1
    assert "no published result 'nothing'" in result.err


def test_a_number_is_held_to_its_last_digit():
    assert to_digits(0.8103) == pytest.approx(0.00005, rel=0.01)
    assert to_digits(8.9909e-4) == pytest.approx(0.5e-8, rel=0.01)
    assert to_digits(5.9375e-06) == pytest.approx(0.5e-10, rel=0.01)


def test_handed_over_tracks_equal_a_simulation():
    """Gates that hold a false plot by chance, followed plot by plot, without the formula."""
    probability, scans, starts = 0.2, 6000, 20
    generator = np.random.default_rng(9)
    tracks, confirmed = [], 0
    for _ in range(scans):
        found = generator.random(len(tracks)) < probability
        following = [(*t, int(hit)) for t, hit in zip(tracks, found, strict=True)]
        confirmed += sum(sum(t) >= 3 and t[-1] for t in following)
        alive = [t for t in following if sum(t) < 3 and len(t) < 4 and sum(t) + 4 - len(t) >= 3]
        # Every plot that no gate took starts a track.
        tracks = alive + [(1,)] * max(starts - int(found.sum()), 0)
    expected = handed_over(3, 4, probability) * starts * scans
    assert confirmed == pytest.approx(expected, abs=5.0 * np.sqrt(expected) + 0.01 * expected)
