# SPDX-License-Identifier: Apache-2.0
"""`demo`: three processes simulate, extract and track; their bag is scored and shown as a page."""

from __future__ import annotations

import argparse
import shutil
from pathlib import Path

from primary_proc.design import requirements_for
from primary_proc.figures.design_curves import draw_design
from primary_proc.parameters import ExtractorParameters
from primary_proc.prediction import predict_extractor
from radar_common.frames import TWO_PI
from radar_eval.command_line import run
from radar_eval.commands import report, score
from radar_eval.errors import EvaluationError
from radar_eval.live_chain import record_live_chain
from radar_sim.scenario import load_scenario


def main(argv: list[str] | None = None) -> int:
    """Run the command.

    Args:
        argv: arguments; None takes those of the process.

    Returns:
        Exit code.
    """
    return run(_demo, _parser().parse_args(argv))


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="demo", description=__doc__)
    parser.add_argument(
        "--out", required=True, metavar="DIR", type=Path, help="folder for all of it"
    )
    parser.add_argument("--scenario", default="airport", help="of the simulator (default airport)")
    parser.add_argument("--scans", type=int, default=40, help="antenna turns (default 40)")
    parser.add_argument(
        "--rate", type=float, default=5.0, help="simulated seconds a second (default 5)"
    )
    parser.add_argument("--seed", type=int, default=1, help="of the simulator (default 1)")
    return parser


def _demo(arguments: argparse.Namespace) -> int:
    bag, logs, page = (arguments.out / name for name in ("bag", "logs", "report"))
    for folder in (bag, logs, page, arguments.out / "design"):
        # A bag is never overwritten; the remains of the demo before are in its way.
        shutil.rmtree(folder, ignore_errors=True)
    _print_design(arguments.scenario, arguments.out / "design")
    print(f"simulating {arguments.scans} scans of {arguments.scenario!r} in three processes …")
    record_live_chain(
        bag,
        logs,
        scenario=arguments.scenario,
        scans=arguments.scans,
        rate=arguments.rate,
        seed=arguments.seed,
    )
    code = score.main([str(bag)]) or report.main([str(bag), "--out", str(page)])
    if not code:
        print(f"\nlook at {page / 'index.html'}")
    return code


def _print_design(scenario: str, folder: Path) -> None:
    """Say beforehand what the extractor will do; the scores at the end say what it did."""
    radar = load_scenario(scenario).radar
    parameters = ExtractorParameters()
    step = TWO_PI / radar.pulses_per_scan
    requirements = requirements_for(parameters, radar.cells, step)
    try:
        prediction = predict_extractor(parameters, requirements, radar.cells)
    except ValueError as error:
        raise EvaluationError(f"the extractor's defaults do not fit {scenario}: {error}") from error
    needed = prediction.required_snr_db["steady"]["0.9"]
    print(
        f"the extractor is designed for {prediction.false_plots:.3g} false plots a scan: "
        f"{prediction.detector} finds 90 % of steady targets "
        + ("nowhere" if needed is None else f"from {needed:.1f} dB on")
    )
    print(f"its curves: {draw_design(prediction, folder)}")
