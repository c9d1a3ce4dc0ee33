# SPDX-License-Identifier: Apache-2.0
"""Accumulators: count positions since a beginning, gaps bridged, and declare a burst when the count is long enough.

Source: Kuzmin 1967, § 3.2.3, Tables 3.6-3.8, figures 3.13-3.14.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import cast

from primary_proc.automata.automaton import Automaton, Output, explore
from primary_proc.automata.burst_rule import BurstRule

_IDLE, _END = "idle", "end"
_Count = tuple[int, int]


@dataclass(frozen=True)
class Accumulator(BurstRule):
    """Counts positions, ones and bridged zeros alike, until k zeros in a row.

    Between series of k zeros the count begins with the position after a series, whatever its bit. From the first one
    it begins with the first one after a series.

    Attributes:
        threshold: L, positions that make a burst.
        zeros: k, zeros in a row that end the count.
        from_first_one: whether the count begins with a one.
        capacity: M, positions after which the burst ends in any case, its next bit lost; None for no limit.
    """

    threshold: int
    zeros: int
    from_first_one: bool
    capacity: int | None = None

    def __post_init__(self) -> None:
        """Refuse what no automaton can do.

        Raises:
            ValueError: k < 1, a threshold that silence would reach, or one over the capacity.
        """
        silence = 0 if self.from_first_one else self.zeros
        if self.zeros < 1 or self.threshold <= silence:
            raise ValueError(
                f"no {self}: a series of zeros has at least one, and the threshold must be over {silence}"
            )
        if self.capacity is not None and self.capacity < self.threshold:
            raise ValueError(f"no {self}: its capacity of {self.capacity} is below the threshold")

    def __str__(self) -> str:
        """Name it in words."""
        place = "from the first one to" if self.from_first_one else "between series of"
        return f"accumulator {place} {self.zeros} zeros, threshold {self.threshold}"

    @property
    def table(self) -> Automaton:
        """Automaton as printed, Table 3.6: one state for each count and number of zeros in a row."""
        return explore(_IDLE, self._step, self._says)

    @property
    def memory(self) -> int:
        """Positions counted before the last."""
        return self.threshold - 1

    @property
    def nominal_bias(self) -> float:
        """(L - 1 + k) / 2: k / 2 of the end, the rest being from the first position counted to the declaration."""
        return (self.threshold - 1 + self.zeros) / 2.0

    def _says(self, state: object) -> Output:
        if isinstance(state, tuple):
            return Output.BURST if state[0] >= self.threshold else Output.NOTHING
        return Output.END if state == _END else Output.NOTHING

    def _step(self, state: object, bit: int) -> str | _Count:
        if not isinstance(state, tuple):
            if self.from_first_one and not bit:
                return _IDLE
            return self._reached(1, 0 if bit else 1)
        count, zeros = cast(_Count, state)
        if count == self.capacity:
            return _END
        zeros = 0 if bit else zeros + 1
        if zeros == self.zeros:
            return _END if count >= self.threshold else _IDLE
        return self._reached(count + 1, zeros)

    def _reached(self, count: int, zeros: int) -> str | _Count:
        if zeros == self.zeros:
            return _IDLE
        # Without a limit there is nothing to count once the burst is declared.
        return (count if self.capacity else min(count, self.threshold)), zeros
