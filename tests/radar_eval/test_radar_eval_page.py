# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
import re

import pytest

from radar_eval.commands import import_asterix
from radar_eval.evaluation import ScoreOptions
from radar_eval.published.registry import RESULTS
from radar_eval.score_names import MEANINGS


@pytest.fixture(scope="module")
def page(repository):
    return (repository / "docs" / "radar_eval.md").read_text("utf-8")


def test_every_score_is_defined(page):
    defined = set(re.findall(r"`([a-z_]+)`", page))
    defined |= {"scans_to_confirmation" + suffix for suffix in ("_mean", "_median")}
    assert set(MEANINGS) <= defined


def test_every_published_result_is_listed(page):
    assert all(f"`{name}`" in page for name in RESULTS)


def test_every_option_of_the_import_is_explained(page, capsys):
    with pytest.raises(SystemExit):
        import_asterix.main(["--help"])
    options = set(re.findall(r"--[a-z-]+", capsys.readouterr().out)) - {"--help", "--out"}
    assert all(option in page for option in options)


def test_the_numbers_are_those_of_the_defaults(page):
    options = ScoreOptions()
    assert f"Δr/{options.gate_range:.0f} m" in page
    assert "Δφ/1.5°" in page
    assert math.degrees(options.gate_azimuth) == pytest.approx(1.5)
    assert f"c = {options.gospa_cutoff:.0f} m" in page
    assert f"more than {options.settled_after} hits" in page
    assert f"{options.plots_of_target} labelled plots or more" in page
    assert f"more than {options.longest_gap:.0f} scans apart" in page


def test_the_example_runs(page, world, write_bag, monkeypatch):
    plots = world.plots()
    bag = write_bag(world.tables(plots, world.tracks(plots, world.owner(plots))), "tracks")
    monkeypatch.chdir(bag.parent)
    example = re.search(r"```python\n(.*?)```", page, re.DOTALL)[1]
    names = {}
    exec(compile(example, "docs/radar_eval.md", "exec"), names)
    assert len(names["errors"].index) > 100
