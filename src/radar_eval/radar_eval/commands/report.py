# SPDX-License-Identifier: Apache-2.0
"""`report`: a self-contained page about a bag, with pictures and scores."""

from __future__ import annotations

import argparse
from pathlib import Path

from radar_common.health import Health
from radar_eval.command_line import dropped_lines, run
from radar_eval.commands.score import add_evaluation_arguments, evaluate_arguments
from radar_eval.report import PAGE, write_report
from radar_eval.run_record import RunRecord


def main(argv: list[str] | None = None) -> int:
    """Run the command.

    Args:
        argv: arguments; None takes those of the process.

    Returns:
        Exit code.
    """
    parser = argparse.ArgumentParser(prog="report", description=__doc__)
    add_evaluation_arguments(parser)
    parser.add_argument("--out", required=True, metavar="DIR", help="folder to write into")
    parser.add_argument("--title", help="of the page (default: name of the bag)")
    return run(_report, parser.parse_args(argv))


def _report(arguments: argparse.Namespace) -> int:
    health = Health()
    evaluation = evaluate_arguments(arguments, health)
    title = arguments.title or Path(arguments.bag).resolve().name
    write_report(evaluation, RunRecord.read(arguments.bag), health, title, arguments.out)
    for line in dropped_lines(health):
        print(line)
    print(Path(arguments.out) / PAGE)
    return 0
