# SPDX-License-Identifier: Apache-2.0
"""Program detectors "l/m-k": a burst is l ones in m adjacent positions, and k zeros in a row end it.

Source: Kuzmin 1967, § 3.2.4-3.2.5, Tables 3.9-3.11, (3.46).
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Self

from primary_proc.automata.automaton import Automaton, Output, explore
from primary_proc.automata.burst_rule import BurstRule

_LATE_BY_NAME = (3, 5, 3)
_END = "end"


@dataclass(frozen=True)
class Program(BurstRule):
    """A detection program, printed as "3/4-2".

    A program declares the burst either as soon as l ones are there, which is always on a one, or late: always at the
    m-th position from the one that begins the burst. Early is the book's form of "3/3-2" to "3/4-2", late that of
    "3/5-3"; a name without "-early" or "-late" stands for the book's form, and early where the book has none.

    Attributes:
        ones: l, ones that make a burst.
        window: m, adjacent positions in which they must lie.
        zeros: k, zeros in a row that end the burst.
        late: whether it is declared at the m-th position only.
    """

    ones: int
    window: int
    zeros: int
    late: bool = False

    def __post_init__(self) -> None:
        """Refuse what no automaton can do.

        Raises:
            ValueError: not 1 <= l <= m, or k < 1.
        """
        if not 1 <= self.ones <= self.window or self.zeros < 1:
            raise ValueError(f"no program {self}: needs 1 <= l <= m and k >= 1")

    def __str__(self) -> str:
        """Name as the literature writes it."""
        numbers = self.ones, self.window, self.zeros
        usual = numbers == _LATE_BY_NAME
        said = "" if self.late == usual else "-late" if self.late else "-early"
        return "{}/{}-{}".format(*numbers) + said

    @classmethod
    def parse(cls, name: str) -> Self:
        """Read the name of a program.

        Args:
            name: such as "3/4-2", "3/5-3", "3/4-2-late" or "3/5-3-early".

        Returns:
            The program.

        Raises:
            ValueError: the name is no program's.
        """
        match = re.fullmatch(r"(\d{1,4})/(\d{1,4})-(\d{1,4})(-early|-late)?", name)
        if match is None:
            raise ValueError(f"{name!r} is no program l/m-k")
        ones, window, zeros = (int(number) for number in match.groups()[:3])
        usual = (ones, window, zeros) == _LATE_BY_NAME
        return cls(ones, window, zeros, usual if match[4] is None else match[4] == "-late")

    @property
    def table(self) -> Automaton:
        """Automaton of the program.

        Before the burst a state is the shortest string of past bits, beginning with a one, that can still grow into l
        ones within m positions; in it, the number of zeros in a row. The end state goes on as the initial one does.
        """
        return explore("", self._step, self._says)

    @property
    def memory(self) -> int:
        """Positions of the window before its last."""
        return self.window - 1

    @property
    def nominal_bias(self) -> float:
        """(m + k - 1) / 2, in the early form with l for m: a target gives its ones in a row."""
        return ((self.window if self.late else self.ones) + self.zeros - 1) / 2.0

    @staticmethod
    def _says(state: object) -> Output:
        if isinstance(state, int):
            return Output.BURST
        return Output.END if state == _END else Output.NOTHING

    def _step(self, state: object, bit: int) -> str | int:
        if isinstance(state, int):
            zeros = 0 if bit else state + 1
            return zeros if zeros < self.zeros else _END
        bits = ("" if state == _END else str(state)) + str(bit)
        while bits and not (
            bits[0] == "1" and bits.count("1") + self.window - len(bits) >= self.ones
        ):
            bits = bits[1:]
        declared = len(bits) == self.window if self.late else bits.count("1") >= self.ones
        # A window of many zeros may close on k of them; the burst then lasts until the next zero.
        return min(len(bits) - len(bits.rstrip("0")), self.zeros - 1) if declared else bits
