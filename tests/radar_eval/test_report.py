# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import base64
import io
import json
import re
from html.parser import HTMLParser

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from PIL import Image
from scipy.stats import binomtest

from radar_common.health import Health
from radar_eval.errors import EvaluationError
from radar_eval.evaluation import ScoreOptions, evaluate
from radar_eval.figures import style
from radar_eval.figures.life_chart import draw_life_chart
from radar_eval.figures.over_range import wilson_interval
from radar_eval.report import write_report
from radar_eval.run_record import RunRecord, StageRecord
from radar_eval.whole_bag import WholeBag

RUN = RunRecord(
    5000.0,
    {
        "tracker": StageRecord(
            1.5,
            {"plots in": 180},
            {"too far": 3},
            {"period, s": {"expected": 4.0, "observed": 4.1}},
        )
    },
)


class Page(HTMLParser):
    """Collects what a page refers to and says."""

    void = frozenset({"meta", "img", "path", "use", "br"})

    def __init__(self, text):
        super().__init__()
        self.references, self.words, self.open = [], [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        if tag not in self.void:
            self.open.append(tag)
        self.references += [v for k, v in attributes if k in ("src", "href", "xlink:href")]

    def handle_endtag(self, tag):
        if tag not in self.void:
            assert self.open.pop() == tag

    def handle_data(self, data):
        self.words.append(data)


@pytest.fixture(scope="module")
def evaluation(new_world):
    world = new_world()
    plots = world.plots()
    return evaluate(world.tables(plots, world.tracks(plots, world.owner(plots))), ScoreOptions())


@pytest.fixture(scope="module")
def report(evaluation, tmp_path_factory):
    folder = tmp_path_factory.mktemp("reports") / "deep" / "report"
    write_report(WholeBag(evaluation), RUN, Health(), "A <small> world", folder)
    return folder


def test_the_page_stands_by_itself(report):
    page = Page((report / "index.html").read_text("utf-8"))
    assert page.open == []
    assert page.references
    assert all(reference.startswith(("data:", "#")) for reference in page.references)


def test_the_page_says_what_was_scored_and_what_the_pipelines_counted(report):
    text = " ".join(Page((report / "index.html").read_text("utf-8")).words)
    assert "A <small> world" in text
    for words in ("targets tracked", "6 / 6", "dropped: too far", "plots in", "expected 4"):
        assert words in text


def test_the_picture_is_in_the_page_and_beside_it(report):
    text = (report / "index.html").read_text("utf-8")
    embedded = base64.b64decode(re.search(r"data:image/png;base64,([^\"]+)", text)[1])
    assert embedded == (report / "ppi.png").read_bytes()
    with Image.open(io.BytesIO(embedded)) as picture:
        assert picture.size[0] == picture.size[1] >= 1500
        pixels = np.asarray(picture.convert("RGB")).astype(int)
    night = [int(style.NIGHT[i : i + 2], 16) for i in (1, 3, 5)]
    drawn = np.any(np.abs(pixels - night) > 20, axis=2).mean()
    assert 0.005 < drawn < 0.5


def test_each_confirmed_track_has_its_colour_in_the_picture(report, evaluation):
    with Image.open(report / "ppi.png") as picture:
        pixels = np.asarray(picture.convert("RGB")).reshape(-1, 3).astype(int)
    for colour in set(style.track_colours(evaluation.history.ids)):
        wanted = [int(colour[i : i + 2], 16) for i in (1, 3, 5)]
        assert np.sum(np.all(np.abs(pixels - wanted) < 12, axis=1)) > 50, colour


def test_the_scores_are_written_for_machines(report):
    scores = json.loads((report / "scores.json").read_text("utf-8"))
    assert scores["targets"] == 6
    assert scores["plots_per_second"] == 5000.0


def test_the_same_bag_gives_the_same_report(report, evaluation, tmp_path):
    write_report(WholeBag(evaluation), RUN, Health(), "A <small> world", tmp_path / "again")
    for name in ("index.html", "ppi.png", "scores.json"):
        assert (report / name).read_bytes() == (tmp_path / "again" / name).read_bytes()


def test_a_bag_without_tracks_can_be_reported(world, tmp_path):
    write_report(
        WholeBag(evaluate(world.tables(), ScoreOptions())), None, Health(), "none", tmp_path
    )
    text = (tmp_path / "index.html").read_text("utf-8")
    assert "Health" not in text
    assert json.loads((tmp_path / "scores.json").read_text("utf-8"))["tracks_per_target"] is None


def test_false_tracks_have_a_line_of_their_own(world):
    plots = world.plots()
    one_track_of_all = np.zeros(len(plots), int)
    tables = world.tables(plots, world.tracks(plots, one_track_of_all))
    evaluation = evaluate(tables, ScoreOptions())
    assert evaluation.history.false.any()
    labels = [t.get_text() for t in draw_life_chart(evaluation).axes[0].get_yticklabels()]
    assert labels[-1] == "no target"


def test_a_report_that_cannot_be_written_is_one_clear_error(evaluation, tmp_path):
    (tmp_path / "file").write_text("in the way", encoding="utf-8")
    with pytest.raises(EvaluationError, match="report"):
        write_report(WholeBag(evaluation), None, Health(), "none", tmp_path / "file")


@given(st.integers(1, 500), st.floats(0.0, 1.0))
def test_intervals_equal_those_of_scipy(number, share):
    hits = round(share * number)
    ours = wilson_interval(np.array([hits / number]), np.array([number]))
    theirs = binomtest(hits, number).proportion_ci(0.95, method="wilson")
    # Ours rounds the quantile to 1.96.
    assert ours[0][0] == pytest.approx(theirs.low, abs=1e-4)
    assert ours[1][0] == pytest.approx(theirs.high, abs=1e-4)
