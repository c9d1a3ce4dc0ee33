# SPDX-License-Identifier: Apache-2.0
"""`run_offline`: sweeps, plots and bearings of a bag become plots, tracks, fused bearings and emitters, without ROS."""

from __future__ import annotations

import argparse
import dataclasses
from collections.abc import Iterable

from radar_common.bag import STORAGES
from radar_eval.command_line import print_json, progress, run
from radar_eval.offline import Content, run_offline
from radar_eval.run_record import RunRecord


def main(argv: list[str] | None = None) -> int:
    """Run the command.

    Args:
        argv: arguments; None takes those of the process.

    Returns:
        Exit code.
    """
    return run(_run, _parser().parse_args(argv))


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="run_offline", description=__doc__)
    parser.add_argument(
        "bag", help="bag with /radar/sweeps, or else /radar/plots, and /passive/bearings"
    )
    parser.add_argument("--out", required=True, metavar="BAG2", help="bag to write")
    parser.add_argument(
        "--params", metavar="FILE", help="ROS 2 parameter file with a section for each node"
    )
    parser.add_argument("--storage", choices=sorted(STORAGES), default="mcap")
    parser.add_argument("--json", action="store_true", help="print the summary for machines")
    return parser


def _run(arguments: argparse.Namespace) -> int:
    def shown(messages: Iterable[tuple[str, Content]], total: int) -> Iterable[tuple[str, Content]]:
        return progress(messages, "processing", total=total, unit="messages")

    record = run_offline(
        arguments.bag,
        arguments.out,
        parameters=arguments.params,
        storage=arguments.storage,
        progress=shown,
    )
    if arguments.json:
        print_json(dataclasses.asdict(record))
    else:
        for line in _summary(record):
            print(line)
    return 0


def _summary(record: RunRecord) -> list[str]:
    lines = []
    for name, stage in record.stages.items():
        spent = f" ({stage.seconds:.2f} s)" if stage.seconds else ""
        lines.append(f"{name}{spent}")
        lines += [f"  {number:>10}  {what}" for what, number in stage.counts.items()]
        lines += [f"  {number:>10}  dropped: {why}" for why, number in stage.dropped.items()]
        lines += [
            f"  {watch['observed']:>10.4g}  {what} (expected {watch['expected']:.4g})"
            for what, watch in stage.watches.items()
        ]
    if record.plots_per_second > 0.0:
        lines.append(f"{record.plots_per_second:.0f} plots/s")
    return lines
