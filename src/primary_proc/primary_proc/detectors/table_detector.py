# SPDX-License-Identifier: Apache-2.0
"""Any program detector by its transition table, one pulse at a time: the reference, and the way for every automaton."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from primary_proc.automata.automaton import Output, Program, program_automaton
from primary_proc.detectors.burst_detector import BurstDetector, bursts, in_order
from primary_proc.quantisers.binary_quantiser import unpack_cells


class TableDetector(BurstDetector):
    """Steps `state = following[state, bit]` for all rings at once."""

    def __init__(self, program: Program, rings: int, longest: int) -> None:
        """Start in the initial state.

        Args:
            program: l/m-k.
            rings: range rings.
            longest: limit of a burst's length, in pulses.
        """
        self._automaton = program_automaton(program)
        self.memory = program.window - 1
        self.longest = longest
        self._rings = np.arange(rings)
        self.reset()

    def reset(self) -> None:
        """Forget all past pulses."""
        self._state = np.zeros(len(self._rings), np.uint8)
        self._start = np.zeros(len(self._rings), np.int64)
        self._silent = np.zeros(len(self._rings), bool)

    def detect(self, samples: npt.NDArray, first: int) -> npt.NDArray[np.void]:
        """Go on with the next pulses; see `BurstDetector.detect`.

        Args:
            samples: packed bits, shape (pulses, words).
            first: number of the first pulse.

        Returns:
            Bursts that ended.
        """
        closed = []
        following, output = self._automaton.following, self._automaton.output
        for pulse, bits in enumerate(unpack_cells(samples, self._rings), start=first):
            before = output[self._state]
            self._state = following[self._state, bits]
            now = output[self._state]
            self._start[(now == Output.BURST) & (before != Output.BURST)] = pulse
            ended = (now == Output.END) & ~self._silent
            overflowed = (
                (now == Output.BURST) & ~self._silent & (pulse - self._start >= self.longest)
            )
            self._silent = (self._silent | overflowed) & (now != Output.END)
            for which, overflow in ((ended, False), (overflowed, True)):
                ring = np.flatnonzero(which)
                closed.append(bursts(ring, self._start[ring], pulse, overflow))
        return in_order(np.concatenate(closed)) if closed else bursts([], [], [], [])

    def open_bursts(self) -> npt.NDArray[np.void]:
        """List the bursts that have not ended."""
        going = (self._automaton.output[self._state] == Output.BURST) & ~self._silent
        ring = np.flatnonzero(going)
        return bursts(ring, self._start[ring], -1, False)
