# SPDX-License-Identifier: Apache-2.0
"""`ros2 pkg executables`."""

from __future__ import annotations

import argparse

from ros2_embedded.cli.packages import PackageNotFoundError, executables, package_names


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments.

    Args:
        parser: The parser of the verb.
    """
    parser.add_argument("package_name", nargs="?", help="The package name")
    parser.add_argument(
        "--full-path", action="store_true", help="Show full path of each executable"
    )


def main(args: argparse.Namespace) -> str | None:
    """Print the executables of one package, or of all.

    Args:
        args: The parsed arguments.

    Returns:
        The error, None if there is none.
    """
    names = package_names() if args.package_name is None else [args.package_name]
    for name in names:
        try:
            offered = executables(name)
        except PackageNotFoundError:
            return f"Package '{name}' not found"
        for executable in offered:
            print(executable.path if args.full_path else f"{name} {executable.name}")
    return None
