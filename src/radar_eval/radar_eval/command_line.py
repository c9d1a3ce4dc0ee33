# SPDX-License-Identifier: Apache-2.0
"""What all commands share: an error is one line on stderr and an exit code, progress shows on terminals only."""

from __future__ import annotations

import argparse
import json
import os
import sys
from collections.abc import Callable, Iterable
from typing import Any

from tqdm import tqdm

from radar_common.bag import BagError
from radar_common.health import Health
from radar_common.parameters import ParameterError
from radar_eval.errors import EvaluationError

_INTERRUPTED = 130


def run(command: Callable[[argparse.Namespace], int], arguments: argparse.Namespace) -> int:
    """Run a command and turn what a user can cause into an exit code.

    Args:
        command: does the work and returns the exit code.
        arguments: as parsed.

    Returns:
        Exit code: the command's own, 1 after an error, 130 after an interruption.
    """
    try:
        return command(arguments)
    except (EvaluationError, BagError, ParameterError) as error:
        print(f"error: {' '.join(str(error).split())}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return _INTERRUPTED
    except BrokenPipeError:
        # The reader of our output has left; nothing must be flushed to it at exit either.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0


def not_negative(text: str) -> float:
    """Read an argument that is a length or a number of things.

    Args:
        text: as typed.

    Returns:
        The number.

    Raises:
        ArgumentTypeError: it is negative or not finite.
    """
    value = float(text)
    if not 0.0 <= value < float("inf"):
        raise argparse.ArgumentTypeError(f"{text} is not a number of zero or more")
    return value


def progress(items: Iterable[Any], text: str, *, total: int | None = None, unit: str) -> Any:
    """Show how far an iteration is, where somebody is looking.

    Args:
        items: to iterate over.
        text: what is being done.
        total: number of items, if known.
        unit: name of one item.

    Returns:
        An iterable of the same items.
    """
    return tqdm(items, desc=text, total=total, unit=unit, disable=None, leave=False)


def print_json(value: Any) -> None:
    """Print a value for machines.

    Args:
        value: of dictionaries, lists, numbers and strings; numbers that are not finite become null.
    """
    print(json.dumps(finite(value), indent=2, allow_nan=False))


def finite(value: Any) -> Any:
    """Replace numbers that JSON cannot hold.

    Args:
        value: of dictionaries, lists, numbers and strings.

    Returns:
        The same with None for NaN and infinities.
    """
    if isinstance(value, dict):
        return {key: finite(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [finite(item) for item in value]
    if isinstance(value, float) and value - value != 0.0:
        return None
    return value


def dropped_lines(health: Health) -> list[str]:
    """Describe what was dropped.

    Args:
        health: counts.

    Returns:
        One line a reason, the most frequent first.
    """
    return [f"dropped: {number:>8}  {reason}" for reason, number in health.dropped.most_common()]
