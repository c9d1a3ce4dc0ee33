# SPDX-License-Identifier: Apache-2.0
"""Moore automata of the program detectors "l/m-k": detect on l ones in m positions, end on k zeros in a row.

Source: Kuzmin 1967, § 3.2.4, Tables 3.9-3.10.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from enum import IntEnum
from typing import Self

import numpy as np
import numpy.typing as npt


class Output(IntEnum):
    """What an automaton says in the state that it has entered."""

    NOTHING = 0
    BURST = 1
    END = 2


@dataclass(frozen=True, slots=True)
class Program:
    """A detection program, printed as "3/4-2".

    Attributes:
        ones: l, ones that make a burst.
        window: m, adjacent positions in which they must lie.
        zeros: k, zeros in a row that end the burst.
    """

    ones: int
    window: int
    zeros: int

    def __post_init__(self) -> None:
        """Refuse what no automaton can do.

        Raises:
            ValueError: not 1 <= l <= m, or k < 1.
        """
        if not 1 <= self.ones <= self.window or self.zeros < 1:
            raise ValueError(f"no program {self}: needs 1 <= l <= m and k >= 1")

    def __str__(self) -> str:
        """Name as the literature writes it."""
        return f"{self.ones}/{self.window}-{self.zeros}"

    @classmethod
    def parse(cls, name: str) -> Self:
        """Read the name of a program.

        Args:
            name: such as "3/4-2".

        Returns:
            The program.

        Raises:
            ValueError: the name is no program's.
        """
        match = re.fullmatch(r"(\d+)/(\d+)-(\d+)", name)
        if match is None:
            raise ValueError(f"{name!r} is no program l/m-k")
        return cls(*(int(number) for number in match.groups()))


@dataclass(frozen=True, slots=True)
class Automaton:
    """A finite automaton with outputs on its states; state 0 is the initial one.

    Attributes:
        following: next state on a zero and on a one, shape (states, 2).
        output: `Output` of each state, shape (states,).
    """

    following: npt.NDArray[np.uint8]
    output: npt.NDArray[np.uint8]

    def __len__(self) -> int:
        """Count the states."""
        return len(self.output)

    @property
    def start_state(self) -> int:
        """State entered when a burst is detected, and whenever it goes on with a one."""
        return int(np.flatnonzero(self.output == Output.BURST)[0])


def program_automaton(program: Program) -> Automaton:
    """Build the automaton of a program.

    Before detection a state is the shortest string of past bits, beginning with a one, that can still grow into l ones
    within m positions; after it, the number of zeros in a row. The end state goes on as the initial one does.

    Args:
        program: l/m-k.

    Returns:
        The automaton: states without output first, then those of the burst, the end state last.
    """
    prefixes = [""]
    successors: list[tuple[str | None, str | None]] = []
    for prefix in prefixes:
        pair = (_grow(prefix, "0", program), _grow(prefix, "1", program))
        successors.append(pair)
        prefixes.extend(new for new in pair if new is not None and new not in prefixes)
    burst = len(prefixes)
    number = {prefix: state for state, prefix in enumerate(prefixes)}
    following = [[burst if new is None else number[new] for new in pair] for pair in successors]
    following += [[burst + zeros + 1, burst] for zeros in range(program.zeros)]
    following.append(following[0])
    output = [Output.NOTHING] * burst + [Output.BURST] * program.zeros + [Output.END]
    return Automaton(np.array(following, np.uint8), np.array(output, np.uint8))


def _grow(prefix: str, bit: str, program: Program) -> str | None:
    """Prefix after one more bit, None once it holds a detection."""
    grown = prefix + bit
    if grown.count("1") >= program.ones:
        return None
    while grown and not (
        grown[0] == "1" and grown.count("1") + program.window - len(grown) >= program.ones
    ):
        grown = grown[1:]
    return grown
