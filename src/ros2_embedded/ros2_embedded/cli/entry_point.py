# SPDX-License-Identifier: Apache-2.0
"""Runs one console-script entry point under its own name, as the script that pip writes does."""

from __future__ import annotations

import sys
from importlib.metadata import EntryPoint


def main() -> object:
    """Load and call the entry point that the command line names.

    The arguments are the program's name, the entry point as `module:function`, then the
    program's own arguments.

    Returns:
        What the program returns, for `sys.exit`.
    """
    _, name, value, *arguments = sys.argv
    sys.argv = [name, *arguments]
    function = EntryPoint(name=name, value=value, group="console_scripts").load()
    result: object = function()
    return result


if __name__ == "__main__":
    sys.exit(main())  # type: ignore[arg-type]
