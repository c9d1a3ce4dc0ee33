# SPDX-License-Identifier: Apache-2.0
"""`ros2 run`: become the executable of a package."""

from __future__ import annotations

import argparse
import os
import shlex
import sys

from ros2_embedded.cli.packages import PackageNotFoundError, executables, package_names


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments.

    Args:
        parser: The parser of the command.
    """
    parser.add_argument(
        "--prefix", help="Command to put before the executable, in quotes if it has spaces."
    )
    parser.add_argument("package_name", help="Name of the ROS package")
    parser.add_argument("executable_name", help="Name of the executable")
    parser.add_argument(
        "argv", nargs=argparse.REMAINDER, help="Pass arbitrary arguments to the executable"
    )


def main(args: argparse.Namespace) -> str:
    """Replace this process by the executable, which so gets the signals and sets the exit code.

    Args:
        args: The parsed arguments.

    Returns:
        Why it could not be started; if it could, the function does not return.
    """
    try:
        offered = executables(args.package_name)
    except PackageNotFoundError:
        return _with_choices(f"Package '{args.package_name}' not found", package_names())
    matches = [executable for executable in offered if executable.name == args.executable_name]
    if not matches:
        return _with_choices("No executable found", sorted({entry.name for entry in offered}))
    if len(matches) > 1:
        return "\n- ".join(["Multiple executables found:", *(match.path for match in matches)])
    command = [*shlex.split(args.prefix or ""), *matches[0].command, *args.argv]
    sys.stdout.flush()
    try:
        os.execvp(command[0], command)
    except OSError as error:
        return f"Cannot run '{command[0]}': {error.strerror}"


def _with_choices(message: str, choices: list[str]) -> str:
    if not choices:
        return message
    return "\n".join([f"{message}; there is:", *(f"  {choice}" for choice in choices)])
