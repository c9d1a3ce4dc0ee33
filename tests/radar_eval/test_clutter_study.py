# SPDX-License-Identifier: Apache-2.0
"""The study of false plots in clutter: the default holds the wanted rate, and what the page excepts is as it says."""

from __future__ import annotations

import json
from functools import cache

import numpy as np
import pytest

from primary_proc.parameters import ExtractorParameters
from radar_eval.figures.clutter_rates import draw_clutter_rates
from radar_eval.figures.style import as_png
from radar_eval.studies import registry
from radar_eval.studies.clutter_rates import SCENARIOS, WANTED, Outcome, outcomes
from radar_eval.studies.clutter_scene import make_scene
from radar_eval.studies.registry import STUDIES, Study
from radar_sim.scenario import scenario_names

DEFAULT = ExtractorParameters().normaliser
EXCEPTED = {"land", "point_clutter"}


@cache
def ran(name, normaliser=DEFAULT):
    """Outcomes without and with control, of a scene smaller than the study's."""
    return tuple(outcomes(make_scene(name, 15, 10, seed=2), (normaliser,)))


def test_the_scenarios_are_the_simulator_s():
    assert set(SCENARIOS) <= set(scenario_names())


@pytest.mark.study
@pytest.mark.parametrize("name", sorted(set(SCENARIOS) - EXCEPTED))
def test_the_default_holds_the_wanted_rate(name):
    free, held = ran(name)
    assert WANTED / 2 <= held.settled <= 2 * WANTED
    assert held.false_plots[0] == free.false_plots[0], "nothing is raised in the first turn"
    assert free.coverage_raised == free.largest_raise_db == 0.0
    if name in ("sea", "rain"):
        assert free.settled > 5 * WANTED
        assert held.coverage_raised > 0.05
    if name in ("noise", "jamming"):
        assert held == Outcome(**(free.as_dict() | {"controlled": True}))


@pytest.mark.study
def test_masts_are_echoes_until_a_map_knows_them():
    _, averaged = ran("point_clutter")
    _, mapped = ran("point_clutter", "clutter-map")
    assert averaged.settled > 100.0
    assert mapped.false_plots[-1] < 2 * WANTED + 4.4 * np.sqrt(2 * WANTED)
    assert mapped.false_plots[2] > 100, "not swallowed at once"


@pytest.mark.study
def test_targets_are_told_from_false_plots():
    free, held = ran("noise")
    assert held.clear_looks == 60
    assert held.clutter_looks == 0
    assert np.isnan(held.clutter_found)
    assert held.clear_found > 0.9
    assert len(held.false_plots) == 15
    free, _ = ran("sea")
    assert free.clutter_looks > 10
    assert free.clutter_found > 0.8


def test_the_figure_shows_every_outcome():
    made = [
        Outcome(name, kind, controlled, [9], 9.0, 1, 0.5, 0, np.nan, 0.0, 0.0)
        for name in SCENARIOS
        for kind in ("cell-averaging", "clutter-map")
        for controlled in (False, True)
    ]
    figure = draw_clutter_rates(made)
    points = [line for line in figure.axes[0].lines if line.get_marker() == "o"]
    assert len(points) == len(made)
    assert as_png(figure, dpi=40).startswith(b"\x89PNG")
    assert as_png(draw_clutter_rates(made), dpi=40) == as_png(draw_clutter_rates(made), dpi=40)


def test_a_study_writes_and_prints_its_numbers(command, tmp_path, monkeypatch):
    def run(folder):
        (folder / "small.png").write_bytes(b"picture")
        return {"value": 1.5, "none": float("nan")}

    monkeypatch.setitem(registry.STUDIES, "small", Study("small", "a small one", run))
    result = command("study", "small", "--out", tmp_path / "new", "--json")
    assert (result.code, result.json()) == (0, {"value": 1.5, "none": None})
    assert json.loads((tmp_path / "new" / "small.json").read_text("utf-8")) == result.json()
    listed = command("study", "small", "--out", tmp_path / "new").out.split()
    assert [line.rsplit("/", 1)[1] for line in listed] == ["small.json", "small.png"]


def test_studies_are_listed(command):
    assert [line.split()[0] for line in command("study", "--list").out.splitlines()] == list(
        STUDIES
    )
    assert [s["name"] for s in command("study", "--list", "--json").json()] == list(STUDIES)


def test_what_cannot_be_studied_is_one_clear_error(command, tmp_path):
    result = command("study", "nothing", "--out", tmp_path)
    assert (result.code, "no study 'nothing'" in result.err) == (1, True)
    (tmp_path / "file").write_text("", "utf-8")
    result = command("study", "clutter", "--out", tmp_path / "file")
    assert (result.code, "cannot write" in result.err) == (1, True)
    with pytest.raises(SystemExit):
        command("study", "clutter")
