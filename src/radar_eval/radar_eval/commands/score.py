# SPDX-License-Identifier: Apache-2.0
"""`score`: plots, tracks, fused bearings and emitters of a bag held against its truth."""

from __future__ import annotations

import argparse

import numpy as np

from radar_common.health import Health
from radar_eval.command_line import dropped_lines, print_json, run
from radar_eval.evaluation import ScoreOptions
from radar_eval.run_record import RunRecord
from radar_eval.score_names import describe_scores
from radar_eval.whole_bag import WholeBag, evaluate_bag


def main(argv: list[str] | None = None) -> int:
    """Run the command.

    Args:
        argv: arguments; None takes those of the process.

    Returns:
        Exit code.
    """
    parser = argparse.ArgumentParser(prog="score", description=__doc__)
    add_evaluation_arguments(parser)
    parser.add_argument("--json", action="store_true", help="print the scores for machines")
    return run(_score, parser.parse_args(argv))


def add_evaluation_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments that say what to evaluate and how.

    Args:
        parser: to add to.
    """
    default = ScoreOptions()
    parser.add_argument("bag", help="bag with results and /truth")
    parser.add_argument("--truth", metavar="BAG", help="bag to take /truth from instead")
    parser.add_argument(
        "--gate-range",
        type=float,
        default=default.gate_range,
        metavar="M",
        help="farthest in range that a plot of a target may lie from it (default %(default)s)",
    )
    parser.add_argument(
        "--gate-azimuth",
        type=float,
        default=float(np.degrees(default.gate_azimuth)),
        metavar="DEG",
        help="the same in azimuth (default %(default)s)",
    )
    parser.add_argument(
        "--scan-period", type=float, metavar="S", help="default: estimated from the plots"
    )
    parser.add_argument(
        "--gospa-cutoff",
        type=float,
        default=default.gospa_cutoff,
        metavar="M",
        help="distance at which a track is no track of a target (default %(default)s)",
    )


def evaluate_arguments(arguments: argparse.Namespace, health: Health) -> WholeBag:
    """Evaluate what the arguments name.

    Args:
        arguments: as parsed.
        health: counts what was dropped while reading.

    Returns:
        The evaluations.
    """
    options = ScoreOptions(
        gate_range=arguments.gate_range,
        gate_azimuth=float(np.radians(arguments.gate_azimuth)),
        scan_period=arguments.scan_period,
        gospa_cutoff=arguments.gospa_cutoff,
    )
    return evaluate_bag(arguments.bag, options, truth_path=arguments.truth, health=health)


def _score(arguments: argparse.Namespace) -> int:
    health = Health()
    evaluation = evaluate_arguments(arguments, health)
    scores = evaluation.scores(RunRecord.read(arguments.bag))
    if arguments.json:
        print_json(scores)
    else:
        for name, value, meaning in describe_scores(scores):
            print(f"{name:<30} {value:>10}  {meaning}")
        for line in dropped_lines(health):
            print(line)
    return 0
