# SPDX-License-Identifier: Apache-2.0
"""`ros2 pkg list`."""

from __future__ import annotations

import argparse

from ros2_embedded.cli.packages import package_names


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments: there are none.

    Args:
        parser: The parser of the verb.
    """


def main(args: argparse.Namespace) -> None:
    """Print the names of the packages, one a line.

    Args:
        args: The parsed arguments.
    """
    for name in package_names():
        print(name)
