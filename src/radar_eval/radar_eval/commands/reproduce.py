# SPDX-License-Identifier: Apache-2.0
"""`reproduce`: published numbers beside what the packages of this chain compute."""

from __future__ import annotations

import argparse

from radar_eval.command_line import print_json, run
from radar_eval.published.registry import RESULTS, find_result
from radar_eval.published.result import Row


def main(argv: list[str] | None = None) -> int:
    """Run the command.

    Args:
        argv: arguments; None takes those of the process.

    Returns:
        Exit code: 0 if every row holds.
    """
    parser = argparse.ArgumentParser(prog="reproduce", description=__doc__)
    parser.add_argument("name", nargs="?", help="of a published result")
    parser.add_argument("--list", action="store_true", help="list the results and their sources")
    parser.add_argument("--json", action="store_true", help="print for machines")
    arguments = parser.parse_args(argv)
    if arguments.list == (arguments.name is not None):
        parser.error("name a result, or --list them")
    return run(_list if arguments.list else _reproduce, arguments)


def _list(arguments: argparse.Namespace) -> int:
    if arguments.json:
        print_json([{"name": r.name, "source": r.source} for r in RESULTS.values()])
    else:
        for result in RESULTS.values():
            print(f"{result.name:<32} {result.source}")
    return 0


def _reproduce(arguments: argparse.Namespace) -> int:
    result = find_result(arguments.name)
    rows = list(result.compute())
    holds = all(row.holds for row in rows)
    if arguments.json:
        print_json(
            {
                "name": result.name,
                "source": result.source,
                "rows": [row.as_dict() for row in rows],
                "holds": holds,
            }
        )
    else:
        _print_table(result.source, rows)
    return 0 if holds else 1


def _print_table(source: str, rows: list[Row]) -> None:
    print(source)
    width = max(len(row.label) for row in rows)
    print(f"{'':<{width}}  {'published':>11} {'expected':>11} {'ours':>11}")
    for row in rows:
        published = "-" if row.published is None else f"{row.published:.6g}"
        error = "" if row.standard_error is None else f" ± {row.standard_error:.2g}"
        verdict = error if row.holds else f"{error}  DIFFERS"
        print(
            f"{row.label:<{width}}  {published:>11} {row.expected:>11.6g} {row.ours:>11.6g}{verdict}"
        )
    for finding in dict.fromkeys(row.finding for row in rows if row.finding):
        print(f"note: {finding}")
    print(f"{sum(row.holds for row in rows)} of {len(rows)} rows hold")
