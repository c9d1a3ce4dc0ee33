# SPDX-License-Identifier: Apache-2.0
"""`demo`: three processes simulate, extract and track; their bag is scored and shown as a page."""

from __future__ import annotations

import argparse
import shutil
from pathlib import Path

from radar_eval.command_line import run
from radar_eval.commands import report, score
from radar_eval.live_chain import record_live_chain


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
    for folder in (bag, logs, page):
        # A bag is never overwritten; the remains of the demo before are in its way.
        shutil.rmtree(folder, ignore_errors=True)
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
