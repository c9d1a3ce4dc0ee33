# SPDX-License-Identifier: Apache-2.0
"""Numbers and patterns on the command line, checked where they are parsed."""

from __future__ import annotations

import re
from argparse import ArgumentTypeError


def positive_int(text: str) -> int:
    """Parse an integer greater than zero.

    Args:
        text: The argument.

    Raises:
        ArgumentTypeError: It is not one.
    """
    value = _integer(text)
    if value <= 0:
        raise ArgumentTypeError("value must be a positive integer")
    return value


def non_negative_int(text: str) -> int:
    """Parse an integer that is not negative.

    Args:
        text: The argument.

    Raises:
        ArgumentTypeError: It is not one.
    """
    value = _integer(text)
    if value < 0:
        raise ArgumentTypeError("value must be non-negative integer")
    return value


def positive_float(text: str) -> float:
    """Parse a finite number greater than zero.

    Args:
        text: The argument.

    Raises:
        ArgumentTypeError: It is not one.
    """
    value = _number(text)
    if not 0.0 < value < float("inf"):
        raise ArgumentTypeError("value must be positive")
    return value


def non_negative_float(text: str) -> float:
    """Parse a finite number that is not negative.

    Args:
        text: The argument.

    Raises:
        ArgumentTypeError: It is not one.
    """
    value = _number(text)
    if not 0.0 <= value < float("inf"):
        raise ArgumentTypeError("value must not be negative")
    return value


def pattern(text: str) -> re.Pattern[str]:
    """Parse a regular expression.

    Args:
        text: The argument.

    Raises:
        ArgumentTypeError: It is not one.
    """
    try:
        return re.compile(text)
    except re.error as error:
        raise ArgumentTypeError(f"'{text}' is no regular expression: {error}") from None


def _integer(text: str) -> int:
    try:
        return int(text)
    except ValueError:
        raise ArgumentTypeError(f"'{text}' is not an integer") from None


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise ArgumentTypeError(f"'{text}' is not a number") from None
