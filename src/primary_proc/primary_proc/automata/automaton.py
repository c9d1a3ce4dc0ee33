# SPDX-License-Identifier: Apache-2.0
"""Moore automata on bits: the transition table that every binary detector of bursts comes down to.

Source: Kuzmin 1967, § 3.2.2, (3.38)-(3.41).
"""

from __future__ import annotations

from collections.abc import Callable, Hashable
from dataclasses import dataclass
from enum import IntEnum
from functools import cached_property

import numpy as np
import numpy.typing as npt

MOST_STATES = 4096
"""An automaton of more states is refused: its Markov chain would take minutes to solve."""


class Output(IntEnum):
    """What an automaton says in the state that it has entered."""

    NOTHING = 0
    BURST = 1
    END = 2


@dataclass(frozen=True)
class Automaton:
    """A finite automaton with outputs on its states; state 0 is the initial one.

    It says BURST from the position where a burst is declared, and END once after it.

    Attributes:
        following: next state on a zero and on a one, shape (states, 2).
        output: `Output` of each state, in rising order, shape (states,).
    """

    following: npt.NDArray[np.integer]
    output: npt.NDArray[np.integer]

    def __post_init__(self) -> None:
        """Refuse what is no detector.

        Raises:
            ValueError: the table is not one, or bursts and ends do not take turns.
        """
        states = len(self.output)
        if self.following.shape != (states, 2) or not np.isin(self.following, range(states)).all():
            raise ValueError("the table does not give a state for each state and bit")
        if self.output[0] != Output.NOTHING or (np.diff(self.output.astype(int)) < 0).any():
            raise ValueError("states must stand in the order of their outputs, the initial first")
        burst = (self.output == Output.BURST)[:, None]
        says = self.output[self.following]
        if (burst & (says == Output.NOTHING)).any() or (~burst & (says == Output.END)).any():
            raise ValueError("an end must follow each burst, and nothing else")

    def __len__(self) -> int:
        """Count the states."""
        return len(self.output)

    @property
    def memory_cells(self) -> int:
        """Binary cells that hold the number of a state."""
        return (len(self) - 1).bit_length()

    @cached_property
    def declaring(self) -> npt.NDArray[np.bool_]:
        """Whether a state declares a burst on a zero and on a one, shape (states, 2)."""
        says = self.output[self.following]
        return (self.output != Output.BURST)[:, None] & (says == Output.BURST)

    @cached_property
    def soonest(self) -> int:
        """Fewest positions from the initial state to a declared burst."""
        return self._cheapest((1, 1))

    @cached_property
    def fewest_ones(self) -> int:
        """Fewest ones that make a burst."""
        return self._cheapest((0, 1))

    def _cheapest(self, price: tuple[int, int]) -> int:
        """Least sum of the prices of bits on a way to a burst, each state priced anew until nothing changes."""
        cost = np.full(len(self), np.inf)
        cost[0] = 0.0
        while True:
            better = cost.copy()
            for bit in (0, 1):
                np.minimum.at(better, self.following[:, bit], cost + price[bit])
            if (better == cost).all():
                return int(cost[self.output == Output.BURST].min())
            cost = better


def explore(
    initial: Hashable,
    step: Callable[[Hashable, int], Hashable],
    says: Callable[[Hashable], Output],
) -> Automaton:
    """Make the table of an automaton that is given by what it does.

    Args:
        initial: its first state, anything hashable.
        step: next state from a state and a bit.
        says: output of a state.

    Returns:
        The automaton of all states that can be reached, in the order of their outputs, else as found; not minimised.

    Raises:
        ValueError: it has more than `MOST_STATES` states.
    """
    number = {initial: 0}
    reached = [initial]
    following = []
    for state in reached:
        pair = step(state, 0), step(state, 1)
        for new in pair:
            if new not in number:
                number[new] = len(reached)
                reached.append(new)
        if len(reached) > MOST_STATES:
            raise ValueError(f"the automaton of the detector has more than {MOST_STATES} states")
        following.append([number[new] for new in pair])
    output = np.array([says(state) for state in reached], np.int8)
    order = np.argsort(output, kind="stable")
    place = np.empty_like(order)
    place[order] = np.arange(len(order))
    return Automaton(place[np.array(following)[order]], output[order])
