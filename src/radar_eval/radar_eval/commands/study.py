# SPDX-License-Identifier: Apache-2.0
"""`study`: measures what the packages do in many circumstances, and draws it."""

from __future__ import annotations

import argparse
import json
from pathlib import Path

from radar_eval.command_line import finite, print_json, run
from radar_eval.errors import EvaluationError
from radar_eval.studies.registry import STUDIES, find_study


def main(argv: list[str] | None = None) -> int:
    """Run the command.

    Args:
        argv: arguments; None takes those of the process.

    Returns:
        Exit code.
    """
    parser = argparse.ArgumentParser(prog="study", description=__doc__)
    parser.add_argument("name", nargs="?", help="of a study")
    parser.add_argument("--list", action="store_true", help="list the studies")
    parser.add_argument("--out", metavar="DIR", type=Path, help="folder for numbers and pictures")
    parser.add_argument("--json", action="store_true", help="print the numbers for machines")
    arguments = parser.parse_args(argv)
    if arguments.list == (arguments.name is not None):
        parser.error("name a study, or --list them")
    if arguments.name is not None and arguments.out is None:
        parser.error("a study needs --out DIR")
    return run(_list if arguments.list else _study, arguments)


def _list(arguments: argparse.Namespace) -> int:
    if arguments.json:
        print_json([{"name": study.name, "title": study.title} for study in STUDIES.values()])
    else:
        for study in STUDIES.values():
            print(f"{study.name:<16} {study.title}")
    return 0


def _study(arguments: argparse.Namespace) -> int:
    study, folder = find_study(arguments.name), arguments.out
    try:
        folder.mkdir(parents=True, exist_ok=True)
        numbers = finite(study.run(folder))
        text = json.dumps(numbers, indent=2, allow_nan=False)
        (folder / f"{study.name}.json").write_text(text + "\n", encoding="utf-8")
    except OSError as error:
        raise EvaluationError(f"cannot write to {folder}: {error}") from error
    if arguments.json:
        print(text)
    else:
        for path in sorted(folder.glob(f"{study.name}*")):
            print(path)
    return 0
