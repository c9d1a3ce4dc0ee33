# SPDX-License-Identifier: Apache-2.0
"""Entry point of `ros2`: chooses the verb, imports that one alone, turns its result into an exit code."""

from __future__ import annotations

import argparse
import importlib
import os
import signal
import sys
from collections.abc import Sequence
from types import ModuleType

from ros2_embedded.cli.catalogue import COMMANDS, NOT_OFFERED_COMMANDS, Command


def main(argv: Sequence[str] | None = None) -> int | str | None:
    """Run `ros2`.

    Args:
        argv: The words after `ros2`; those of the process if None.

    Returns:
        What `sys.exit` takes: an exit code, or a message for standard error (exit code 1).
        An interrupt gives 2 and an orderly termination 15, the numbers of the signals.
    """
    words = list(sys.argv[1:] if argv is None else argv)
    refusal = _refusal(words)
    if refusal is not None:
        return refusal
    parser, chosen = _build_parser(words)
    args = parser.parse_args(words)
    if chosen is None:
        args.help_parser.print_help()
        return 0
    # A reader at the other end of a pipe must see each line when it is printed.
    if not args.use_python_default_buffering and hasattr(sys.stdout, "reconfigure"):
        sys.stdout.reconfigure(line_buffering=True)
    return _run(chosen, args)


def _run(verb: ModuleType, args: argparse.Namespace) -> int | str | None:
    try:
        result: int | str | None = verb.main(args)
        sys.stdout.flush()
    except KeyboardInterrupt:
        return int(signal.SIGINT)
    except BrokenPipeError:
        # Python flushes standard output once more at exit; the reader is gone.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 1
    except RuntimeError as error:
        return str(error)
    except Exception as error:
        # By name, since the verbs that do without rclpy must not pay for its import.
        if type(error).__name__ == "ExternalShutdownException":
            return int(signal.SIGTERM)
        raise
    return result


def _refusal(words: Sequence[str]) -> str | None:
    """Say so if the words ask for what the full `ros2` has and this one has not."""
    names = [word for word in words if not word.startswith("-")]
    if names and names[0] in NOT_OFFERED_COMMANDS:
        return f"'ros2 {names[0]}' is not offered by the embedded runtime"
    command = COMMANDS.get(names[0]) if names else None
    if command is not None and len(names) > 1 and names[1] in command.not_offered:
        return f"'ros2 {names[0]} {names[1]}' is not offered by the embedded runtime"
    return None


def _build_parser(words: Sequence[str]) -> tuple[argparse.ArgumentParser, ModuleType | None]:
    """Build the parser with the arguments of the chosen verb only, and import that verb."""
    # No option before the verb takes a value, so the bare words are command and verb.
    names = [word for word in words if not word.startswith("-")]
    parser = argparse.ArgumentParser(
        prog="ros2", description="The command-line tool for ROS 2, as the embedded runtime has it."
    )
    parser.add_argument(
        "--use-python-default-buffering",
        action="store_true",
        help="do not force line buffering of standard output",
    )
    parser.set_defaults(help_parser=parser)
    subparsers = _add_subparsers(parser, "ros2 <command>")
    chosen: ModuleType | None = None
    for name, command in COMMANDS.items():
        command_parser = subparsers.add_parser(
            name, help=command.summary, description=command.summary
        )
        if names[:1] != [name]:
            continue
        if command.verbs:
            chosen = _add_verbs(command_parser, name, command, names[1] if names[1:] else None)
        else:
            chosen = importlib.import_module(f"ros2_embedded.cli.{name}")
            chosen.add_arguments(command_parser)
    return parser, chosen


def _add_verbs(
    parser: argparse.ArgumentParser, name: str, command: Command, selected: str | None
) -> ModuleType | None:
    if name == "topic":
        parser.add_argument(
            "--include-hidden-topics", action="store_true", help="Consider hidden topics as well"
        )
    parser.set_defaults(help_parser=parser)
    verbs = _add_subparsers(parser, f"ros2 {name} <command>")
    chosen: ModuleType | None = None
    for verb, summary in command.verbs.items():
        verb_parser = verbs.add_parser(verb, help=summary, description=summary)
        if verb == selected:
            chosen = importlib.import_module(f"ros2_embedded.cli.{name}.{verb}")
            chosen.add_arguments(verb_parser)
    return chosen


def _add_subparsers(
    parser: argparse.ArgumentParser, usage: str
) -> argparse._SubParsersAction[argparse.ArgumentParser]:
    return parser.add_subparsers(
        title="Commands", metavar=f"Call `{usage} -h` for more detailed usage."
    )


if __name__ == "__main__":
    sys.exit(main())
