# SPDX-License-Identifier: Apache-2.0
"""Wald's sequential test on bits, begun again after each decision: a counter that goes up on ones and down on zeros.

Source: A. Wald, Sequential Analysis, 1947; Kuzmin 1967, § 1.3. The end: E. S. Page, Biometrika 41, 1954.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import cast

from primary_proc.automata.automaton import Automaton, Output, explore
from primary_proc.automata.burst_rule import BurstRule

_END = "end"
_Burst = tuple[str, int]


@dataclass(frozen=True)
class SequentialTest(BurstRule):
    """A log-likelihood ratio on a lattice between two bounds.

    The test begins at zero. At the lower bound it decides for noise and begins again; at the upper bound it declares a
    burst. From there on the same ratio is tested for the burst's end: it starts at zero, is never let above zero, so
    that what the target said long ago does not put off the end, and ends the burst at the lower bound.

    Attributes:
        up: step on a one.
        down: step on a zero, counted positive.
        upper: bound that declares a burst.
        lower: bound that decides for noise, counted positive.
        longest_test: positions before the declaration that may belong to the burst.
    """

    up: int
    down: int
    upper: int
    lower: int
    longest_test: int

    def __post_init__(self) -> None:
        """Refuse what is no test.

        Raises:
            ValueError: a step or a bound is not positive.
        """
        if min(self.up, self.down, self.upper, self.lower) < 1:
            raise ValueError(f"no {self}: steps and bounds must be positive")

    def __str__(self) -> str:
        """Name it in words."""
        return f"sequential test +{self.up} -{self.down} between -{self.lower} and {self.upper}"

    @property
    def table(self) -> Automaton:
        """Automaton whose states are the values of the sum."""
        return explore(0, self._step, self._says)

    @property
    def memory(self) -> int:
        """Positions that the last test may have lasted."""
        return self.longest_test

    @property
    def nominal_bias(self) -> float:
        """Half the ones in a row that declare a burst, but for the first, and the zeros that end it."""
        return (-(-self.upper // self.up) - 1 - (-self.lower // self.down)) / 2.0

    @staticmethod
    def _says(state: object) -> Output:
        if isinstance(state, tuple):
            return Output.BURST
        return Output.END if state == _END else Output.NOTHING

    def _step(self, state: object, bit: int) -> int | str | _Burst:
        change = self.up if bit else -self.down
        if isinstance(state, tuple):
            left = min(cast(_Burst, state)[1] + change, 0)
            return _END if left <= -self.lower else ("burst", left)
        ratio = (state if isinstance(state, int) else 0) + change
        if ratio >= self.upper:
            return "burst", 0
        return 0 if ratio <= -self.lower else ratio
