# SPDX-License-Identifier: Apache-2.0
"""Which parameters a listing shows."""

from __future__ import annotations

from collections.abc import Iterable

from rcl_interfaces.msg import ListParametersResult

#: Depth that shows everything.
RECURSIVE = 0


def list_names(names: Iterable[str], prefixes: list[str], depth: int) -> ListParametersResult:
    """List parameters.

    Args:
        names: All names.
        prefixes: Show those with or below these names only; empty for all.
        depth: How many generations below; 0 for all.

    Returns:
        The names and the names above them.

    Raises:
        TypeError: An argument has another type.
        ValueError: The depth is negative.
    """
    if not isinstance(prefixes, list):
        raise TypeError("The prefixes argument must be a list")
    if not all(isinstance(prefix, str) for prefix in prefixes):
        raise TypeError("All prefixes must be instances of type str")
    if not isinstance(depth, int):
        raise TypeError("The depth must be instance of type int")
    if depth < 0:
        raise ValueError("The depth must be greater than or equal to zero")

    def is_shown(name: str) -> bool:
        if not prefixes:
            return depth == RECURSIVE or name.count(".") < depth
        return any(
            name == prefix
            or (
                name.startswith(f"{prefix}.")
                and (depth == RECURSIVE or name[len(prefix) + 1 :].count(".") < depth)
            )
            for prefix in prefixes
        )

    shown = [name for name in names if is_shown(name)]
    above = dict.fromkeys(name.rpartition(".")[0] for name in shown if "." in name)
    return ListParametersResult(names=shown, prefixes=list(above))
