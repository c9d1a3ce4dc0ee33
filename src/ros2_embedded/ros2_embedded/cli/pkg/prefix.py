# SPDX-License-Identifier: Apache-2.0
"""`ros2 pkg prefix`."""

from __future__ import annotations

import argparse

from ros2_embedded.cli.packages import package_prefix


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments.

    Args:
        parser: The parser of the verb.
    """
    parser.add_argument("package_name", help="The package name")
    parser.add_argument("--share", action="store_true", help="Show share directory for the package")


def main(args: argparse.Namespace) -> str | None:
    """Print the prefix that a package is installed in.

    Args:
        args: The parsed arguments.

    Returns:
        The error, None if there is none.
    """
    prefix = package_prefix(args.package_name)
    if prefix is None:
        return "Package not found"
    print(prefix / "share" / args.package_name if args.share else prefix)
    return None
