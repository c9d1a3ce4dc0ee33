# SPDX-License-Identifier: Apache-2.0
"""A rule that tells from the bits of a range ring where bursts begin and end."""

from __future__ import annotations

from abc import ABC, abstractmethod
from functools import lru_cache

from primary_proc.automata.automaton import Automaton
from primary_proc.automata.minimisation import minimised


class BurstRule(ABC):
    """What a binary detector looks for. Rules are values: frozen, hashable, equal by their numbers."""

    @property
    def automaton(self) -> Automaton:
        """Smallest automaton that follows the rule; equal rules share it."""
        return _smallest(self)

    @property
    @abstractmethod
    def table(self) -> Automaton:
        """An automaton that follows the rule, its states as one thinks of them."""

    @property
    @abstractmethod
    def memory(self) -> int:
        """Positions before the one that declares a burst that may belong to it."""

    @property
    @abstractmethod
    def nominal_bias(self) -> float:
        """Steps by which the middle between declaration and end lies late, if ones begin and stop at once."""


@lru_cache(maxsize=128)
def _smallest(rule: BurstRule) -> Automaton:
    return minimised(rule.table)
