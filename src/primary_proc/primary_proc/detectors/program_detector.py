# SPDX-License-Identifier: Apache-2.0
"""Program detectors l/m-k on packed bits: 64 range rings an operation, ring by ring only where something happens.

While l + k > m, no m positions with l ones hold k zeros in a row: a detection never reaches back across the end of the
burst before. So the automaton (Kuzmin 1967, Table 3.10) does exactly this: a burst starts at the first position after
the last end where l of m positions are ones, the newest among them (the oldest, if the program declares late: 3.46),
and ends with the first k zeros after that. Both are patterns of shifted rows, and all detections before the same end
are one burst.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from primary_proc.automata.program import Program
from primary_proc.detectors.burst_detector import BurstDetector, bursts
from primary_proc.detectors.open_bursts import OpenBursts
from primary_proc.quantisers.binary_quantiser import unpack_cells


class ProgramDetector(BurstDetector):
    """The bit-parallel form of `TableDetector`, equal to it bit for bit."""

    def __init__(self, program: Program, rings: int, longest: int) -> None:
        """Start in the initial state.

        Args:
            program: l/m-k with l + k > m.
            rings: range rings.
            longest: limit of a burst's length, in pulses.

        Raises:
            ValueError: the program has no bit-parallel form.
        """
        if program.ones + program.zeros <= program.window:
            raise ValueError(f"{program} looks across the end of a burst; step its table instead")
        self.rule = self._program = program
        self.memory = program.window - 1
        self.longest = longest
        self._history = max(program.window, program.zeros) - 1
        self._column = np.zeros(rings, np.int64)
        self._busy = np.zeros(rings, bool)
        self._words = -(-rings // 64)
        self.reset()

    def reset(self) -> None:
        """Forget all past pulses."""
        self._past = np.zeros((self._history, self._words), np.uint64)
        self._open = OpenBursts.none()

    def detect(self, samples: npt.NDArray, first: int) -> npt.NDArray[np.void]:
        """Go on with the next pulses; see `BurstDetector.detect`.

        Args:
            samples: packed bits, shape (pulses, words).
            first: number of the first pulse.

        Returns:
            Bursts that ended.
        """
        pulses = len(samples)
        words = np.concatenate([self._past, samples])
        self._past = words[pulses:]
        pulse, ring = self._detections(words, pulses)
        before = self._open
        self._busy[ring] = self._busy[before.ring] = True
        rings = np.flatnonzero(self._busy)
        if not len(rings):
            return bursts(rings, rings, rings, False)
        self._busy[rings] = False
        self._column[rings] = np.arange(len(rings))
        end = self._next_ends(words, rings, pulses)

        # Detections of a ring that run into the same end are one burst, begun by the first of them.
        column, open_column = self._column[ring], self._column[before.ring]
        stop, open_stop = end[pulse, column], end[0, open_column]
        going_on = np.full(len(rings), -1)
        going_on[open_column] = open_stop
        begins = going_on[column] != stop
        begins[1:] &= (column[1:] != column[:-1]) | (stop[1:] != stop[:-1])
        stops = np.concatenate([open_stop, stop[begins]])
        after = before.joined(ring[begins], first + pulse[begins])
        closed, self._open = after.close(
            first + stops.astype(np.int64), stops < pulses, self.longest
        )
        return closed

    def open_bursts(self) -> npt.NDArray[np.void]:
        """List the bursts that have not ended."""
        return self._open.heard()

    def _detections(
        self, words: npt.NDArray[np.uint64], pulses: int
    ) -> tuple[npt.NDArray[np.int64], npt.NDArray[np.int64]]:
        """Pulse and ring of every position where the pattern is met, in order of ring and pulse."""
        now = self._history
        window, late = self._program.window, self._program.late
        rows = [words[now - back : now - back + pulses] for back in range(window)]
        met = rows.pop(window - 1 if late else 0)
        # enough[n]: the other positions, as far as looked at, hold n ones or more.
        enough: dict[int, npt.NDArray[np.uint64]] = {}
        for looked, row in enumerate(rows, start=1):
            for count in range(min(looked, self._program.ones - 1), 0, -1):
                more = enough[count - 1] & row if count > 1 else row
                enough[count] = enough[count] | more if count in enough else more
        if self._program.ones > 1:
            met = met & enough[self._program.ones - 1]
        words_met = met.reshape(-1)
        place = np.flatnonzero(words_met)
        bit = np.flatnonzero(np.unpackbits(words_met[place].view(np.uint8)))
        pulse, word = np.divmod(place[bit >> 6], self._words)
        ring = word * 64 + (bit & 63)
        order = np.argsort(ring, kind="stable")
        return pulse[order], ring[order]

    def _next_ends(
        self, words: npt.NDArray[np.uint64], rings: npt.NDArray[np.int64], pulses: int
    ) -> npt.NDArray[np.int32]:
        """For each pulse and ring the first pulse from there on that completes k zeros, or `pulses`."""
        bits = unpack_cells(words, rings)
        busy = bits[self._history :]
        for back in range(1, self._program.zeros):
            busy = busy | bits[self._history - back : self._history - back + pulses]
        numbers = np.arange(pulses, dtype=np.int32)[:, None]
        ends = np.where(busy == 0, numbers, np.int32(pulses))
        return np.minimum.accumulate(ends[::-1], axis=0)[::-1]
