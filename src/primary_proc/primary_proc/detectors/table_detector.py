# SPDX-License-Identifier: Apache-2.0
"""Any binary detector by the transition table of its automaton: one step a pulse for all range rings at once."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from primary_proc.automata.automaton import Output
from primary_proc.automata.burst_rule import BurstRule
from primary_proc.detectors.burst_detector import BurstDetector, bursts
from primary_proc.detectors.open_bursts import OpenBursts


class TableDetector(BurstDetector):
    """Steps `state = following[state, bit]`; looks at single rings only where a burst is under way."""

    def __init__(self, rule: BurstRule, rings: int, longest: int) -> None:
        """Start in the initial state.

        Args:
            rule: what to look for.
            rings: range rings.
            longest: limit of a burst's length, in pulses.
        """
        automaton = rule.automaton
        # States are kept doubled, so that adding the bit makes them places in the flat table.
        self._following = 2 * automaton.following.reshape(-1).astype(np.intp)
        bounds = np.searchsorted(automaton.output, [Output.BURST, Output.END])
        self._first_burst, self._first_end = (int(2 * bound) for bound in bounds)
        self.rule = rule
        self.memory = rule.memory
        self.longest = longest
        self._rings = rings
        self.reset()

    def reset(self) -> None:
        """Forget all past pulses."""
        self._state = np.zeros(self._rings, np.intp)
        self._open = OpenBursts.none()

    def detect(self, samples: npt.NDArray, first: int) -> npt.NDArray[np.void]:
        """Go on with the next pulses; see `BurstDetector.detect`.

        Args:
            samples: packed bits, shape (pulses, words).
            first: number of the first pulse.

        Returns:
            Bursts that ended.
        """
        states = self._walk(samples)
        rings = np.flatnonzero((states >= self._first_burst).any(axis=0))
        if not len(rings):
            return bursts(rings, rings, rings, False)
        seen = states[:, rings]
        ending = (seen >= self._first_end).T
        burst = (seen >= self._first_burst).T & ~ending
        column, pulse = np.nonzero(burst[:, 1:] & ~burst[:, :-1])
        before = self._open
        after = before.joined(rings[column], first + pulse)

        # The end of a burst is the next one of its ring; one more behind each ring's pulses stands for none.
        span = len(seen)
        ends = np.flatnonzero(np.pad(ending[:, 1:], ((0, 0), (0, 1)), constant_values=True))
        begun = np.concatenate([np.searchsorted(rings, before.ring) * span, column * span + pulse])
        end = ends[np.searchsorted(ends, begun)] % span
        closed, self._open = after.close(first + end, end < span - 1, self.longest)
        return closed

    def open_bursts(self) -> npt.NDArray[np.void]:
        """List the bursts that have not ended."""
        return self._open.heard()

    def _walk(self, samples: npt.NDArray) -> npt.NDArray[np.intp]:
        """State after each pulse, that before them first, shape (pulses + 1, rings)."""
        octets = samples.view(np.uint8).reshape(len(samples), -1)
        bits = np.unpackbits(octets, axis=1, count=self._rings)
        states = np.empty((len(samples) + 1, self._rings), np.intp)
        states[0] = self._state
        place = np.empty(self._rings, np.intp)
        for now, row in enumerate(bits):
            np.add(states[now], row, out=place)
            np.take(self._following, place, out=states[now + 1], mode="clip")
        self._state = states[-1].copy()
        return states
