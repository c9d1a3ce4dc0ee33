# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import json
import subprocess
import sys

import pytest

from radar_common.bag import topics
from radar_common.tables import PLOTS_TOPIC, TRACKS_TOPIC, TRUTH_TOPIC
from radar_eval.command_line import finite

COMMANDS = ["import_asterix", "run_offline", "score", "report", "reproduce"]
ASKED_FOR = {
    "targets", "targets_tracked", "tracks_per_target", "plots_in_tracks", "false_tracks",
    "rms_raw_m", "rms_tracked_m", "plots_per_second", "scans", "duration_s",
}  # fmt: skip


@pytest.fixture
def tracked(command, fixture_bags, tiny_parameters, tmp_path):
    """A fixture bag run through the chain by the command."""
    out = tmp_path / "tracked"
    result = command(
        "run_offline", fixture_bags / "tiny_mcap", "--out", out, "--params", tiny_parameters
    )
    assert result.code == 0, result.err
    return out


def test_a_run_says_how_the_pipelines_fared(command, fixture_bags, tiny_parameters, tmp_path):
    result = command(
        "run_offline", fixture_bags / "tiny_sqlite3", "--out", tmp_path / "out",
        "--params", tiny_parameters, "--json",
    )  # fmt: skip
    assert result.code == 0
    assert result.json()["stages"]["plot_extractor"]["counts"]["pulses in"] == 3600
    assert set(topics(tmp_path / "out")) == {PLOTS_TOPIC, TRACKS_TOPIC, TRUTH_TOPIC}


def test_scores_are_one_object_with_all_that_was_asked_for(command, tracked):
    result = command("score", tracked, "--json")
    assert result.code == 0
    assert result.err == ""
    scores = result.json()
    assert set(scores) >= ASKED_FOR
    assert scores["targets_tracked"] >= 2
    assert scores["scans"] == 12


def test_truth_may_come_from_another_bag(command, tracked, fixture_bags):
    own = command("score", tracked, "--json").json()
    other = command("score", tracked, "--truth", fixture_bags / "tiny_mcap", "--json").json()
    assert own == other


def test_a_report_says_where_it_is(command, tracked, tmp_path):
    result = command("report", tracked, "--out", tmp_path / "report", "--title", "Tiny")
    assert result.code == 0
    assert result.out.strip() == str(tmp_path / "report" / "index.html")
    assert "<title>Tiny" in (tmp_path / "report" / "index.html").read_text("utf-8")
    scores = json.loads((tmp_path / "report" / "scores.json").read_text("utf-8"))
    assert scores == command("score", tracked, "--json").json()


def test_an_existing_bag_is_never_overwritten(command, tracked, fixture_bags):
    for name, source in (("run_offline", fixture_bags / "tiny_mcap"), ("import_asterix", "x.ast")):
        result = command(name, source, "--out", tracked)
        assert result.code == 1
        assert "exists" in result.err


def test_wrong_parameters_are_one_clear_error(command, fixture_bags, tmp_path):
    path = tmp_path / "wrong.yaml"
    path.write_text("tracker:\n  ros__parameters:\n    gate_sigmas: 99.0\n", encoding="utf-8")
    result = command(
        "run_offline", fixture_bags / "tiny_mcap", "--out", tmp_path / "o", "--params", path
    )
    assert result.code == 1
    assert "gate_sigmas must be in" in result.err


def test_an_empty_recording_is_one_clear_error(command, tmp_path):
    (tmp_path / "empty.ast").write_bytes(b"")
    result = command("import_asterix", tmp_path / "empty.ast", "--out", tmp_path / "out")
    assert result.code == 1
    assert result.err == "error: no target report of category 48 could be decoded\n"
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    "arguments",
    [["--false-plots", "-3"], ["--min-range", "nan"], ["--radar", "20"], ["--date", "x"]],
)
def test_impossible_arguments_are_refused(command, tmp_path, arguments):
    with pytest.raises(SystemExit) as refused:
        command("import_asterix", "x.ast", "--out", tmp_path / "out", *arguments)
    assert refused.value.code == 2


@pytest.mark.parametrize("name", COMMANDS)
def test_every_command_explains_itself(command, name, capsys):
    with pytest.raises(SystemExit) as ended:
        command(name, "--help")
    assert ended.value.code == 0


def test_a_reader_that_leaves_is_no_error(tracked):
    script = "import sys; from radar_eval.commands.score import main; sys.exit(main(sys.argv[1:]))"
    process = subprocess.Popen(
        [sys.executable, "-c", script, str(tracked)], stdout=subprocess.PIPE, stderr=subprocess.PIPE
    )
    process.stdout.close()
    assert process.stderr.read() == b""
    assert process.wait(60) == 0


def test_json_holds_no_number_that_json_does_not_know():
    value = {"a": float("nan"), "b": [1.0, float("inf")], "c": ({"d": -float("inf")}, "text", 3)}
    assert finite(value) == {"a": None, "b": [1.0, None], "c": [{"d": None}, "text", 3]}
