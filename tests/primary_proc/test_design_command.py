# SPDX-License-Identifier: Apache-2.0
"""The `design` command: the numbers of the book, the same design as the node's, curves, and clear refusals."""

from __future__ import annotations

import json

import pytest

from primary_proc.design import design
from primary_proc.design_command import main
from primary_proc.methods.designed_method import CANDIDATES, choose_program
from primary_proc.methods.requirements import Requirements
from primary_proc.parameters import ExtractorParameters
from radar_common.frames import TWO_PI


@pytest.fixture
def printed(capsys):
    def run(*arguments):
        assert main([*arguments, "--json"]) == 0
        return json.loads(capsys.readouterr().out)

    return run


def test_a_design_of_the_book(printed):
    """3/4-2 at P_fa = 4e-3: p_N = 0.1219, x_0 = 2.052; sinc^2 burst of 11 pulses, a_0 = 2 is detected with 0.44."""
    found = printed("--pfa", "4e-3", "--n0", "11", "--pattern", "sinc2", "--detector", "3/4-2")
    assert found["noise_probability"] == pytest.approx(0.1219, abs=1e-4)
    assert found["first_threshold"] == pytest.approx(2.052, abs=1e-3)
    assert found["false_starts"] == pytest.approx(4e-3, rel=1e-6)
    needed = found["required_snr_db"]["steady"]["0.5"] - found["normaliser_loss_db"]
    assert 3.0 < needed < 4.0


def test_it_prints_the_design_of_the_node(printed):
    found = printed("--detector", "3/3-2", "--false-plots", "50", "--beamwidth-deg", "2.0")
    parameters = ExtractorParameters(detector="3/3-2", false_plots_per_scan=50.0, beamwidth_deg=2.0)
    plan = design(parameters, 1024, TWO_PI / 4096)
    assert found["noise_probability"] == plan.method.noise_probability
    assert found["false_plots"] == plan.method.false_plots
    assert found["pulses_in_burst"] == pytest.approx(plan.requirements.pulses)


def test_a_parameter_file_is_the_start_and_options_win(printed, repository):
    path = repository / "src/primary_proc/config/plot_extractor.yaml"
    assert printed("--params", str(path))["detector"] == ExtractorParameters().detector
    assert printed("--params", str(path), "--detector", "4/4-2")["detector"] == "4/4-2"


def test_the_designer_takes_the_candidate_that_needs_the_least_signal(printed):
    asked = {"false_plots": 10.0, "rings": 1024, "pulses_per_scan": 4096.0, "gap": 10}
    requirements = Requirements(**asked, pattern="gaussian", pulses=19.0)
    name, _ = choose_program(requirements)
    needed = {
        candidate: printed("--detector", candidate, "--n0", "19")["required_snr_db"]["steady"][
            "0.9"
        ]
        for candidate in CANDIDATES[-3:]
    }
    assert name == min(needed, key=needed.__getitem__)
    with pytest.raises(ValueError, match="no program"):
        choose_program(Requirements(**asked, pattern="gaussian", pulses=1.5))


@pytest.mark.parametrize(
    ("arguments", "reason"),
    [
        (["--detector", "5/3-2"], "detector"),
        (["--pfa", "0.5"], "out of reach"),
        (["--rings", "0"], "rings"),
        (["--n0", "1"], "no program"),
        (["--n0", "1", "--detector", "3/4-2"], "too narrow"),
        (["--params", "missing.yaml"], "missing.yaml"),
    ],
)
def test_what_cannot_be_is_refused_with_the_reason(arguments, reason, capsys):
    assert main(arguments) == 1
    output = capsys.readouterr()
    assert not output.out
    assert output.err.startswith("error: ")
    assert reason in output.err
    assert output.err.count("\n") == 1


def test_the_table_names_every_target(capsys):
    assert main(["--detector", "3/4-2"]) == 0
    text = capsys.readouterr().out
    for word in ("steady", "slow-dominant", "false plots per turn", "SNR for P_d 0.9"):
        assert word in text


def test_the_curves_are_drawn(tmp_path, capsys):
    folder = tmp_path / "new"
    assert (
        main(["--detector", "3/4-2", "--figures", str(folder), "--book-figures", str(folder)]) == 0
    )
    names = {path.name for path in folder.iterdir()}
    assert names == {
        "design.png",
        "kuzmin_thresholds.png",
        "kuzmin_false_alarms.png",
        "kuzmin_detection.png",
        "kuzmin_azimuth.png",
    }
    assert all(path.read_bytes().startswith(b"\x89PNG") for path in folder.iterdir())
    assert capsys.readouterr().err == ""
