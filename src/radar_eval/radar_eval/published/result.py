# SPDX-License-Identifier: Apache-2.0
"""A published number, what follows from its source, and what this project computes."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True, slots=True)
class Row:
    """One number.

    Attributes:
        label: what it is.
        published: as printed; None where the source gives only a curve or a formula.
        expected: what follows from the source's own definitions, misprints corrected.
        ours: as the packages compute it.
        tolerance: largest difference of ours from expected that is agreement.
        finding: why published and expected differ, where they do.
        standard_error: of ours, where it is a mean over simulated runs.
    """

    label: str
    published: float | None
    expected: float
    ours: float
    tolerance: float
    finding: str = ""
    standard_error: float | None = None

    @property
    def holds(self) -> bool:
        """Whether ours agrees with what is expected."""
        return abs(self.ours - self.expected) <= self.tolerance

    def as_dict(self) -> dict[str, Any]:
        """Write the row for machines.

        Returns:
            Its fields and the verdict; finding and standard error only where there is one.
        """
        row: dict[str, Any] = {
            "label": self.label,
            "published": self.published,
            "expected": self.expected,
            "ours": float(self.ours),
            "tolerance": self.tolerance,
            "holds": self.holds,
        }
        if self.standard_error is not None:
            row["standard_error"] = self.standard_error
        return row | ({"finding": self.finding} if self.finding else {})


@dataclass(frozen=True, slots=True)
class PublishedResult:
    """A table or figure of a publication.

    Attributes:
        name: as the command takes it.
        source: author, year, place.
        compute: makes the rows.
    """

    name: str
    source: str
    compute: Callable[[], Iterable[Row]]


def to_digits(value: float) -> float:
    """Half a unit of the last digit of a number as it is written here, the finest that it can be held to.

    Args:
        value: number, such as 8.9909e-4 or 0.8103.

    Returns:
        Half a unit of its last decimal digit, and a little for rounding.
    """
    mantissa, _, exponent = f"{value!r}".partition("e")
    decimals = len(mantissa.partition(".")[2])
    return 0.501 * 10.0 ** (int(exponent or 0) - decimals)
