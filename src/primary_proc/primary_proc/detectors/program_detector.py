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
        self._words = -(-rings // 64)
        ring = np.arange(rings)
        self._octet, self._bit = ring >> 3, np.uint8(128) >> (ring & 7).astype(np.uint8)[:, None]
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
        pulses, now = len(samples), self._history
        # The pulses before, these pulses, and where the pattern is met: in one array, so that rings are picked once.
        words = np.empty((now + 2 * pulses, self._words), np.uint64)
        met = words[now + pulses :]
        words[:now] = self._past
        words[now : now + pulses] = samples
        self._past = words[pulses : now + pulses].copy()
        self._meet(words, met)
        busy = np.unpackbits(np.bitwise_or.reduce(met, axis=0).view(np.uint8))
        before = self._open
        busy[before.ring] = 1
        rings = busy.nonzero()[0]
        if not len(rings):
            return bursts(rings, rings, rings, False)

        # What is not zero is a one; there is no need to move each ring's bit to the same place.
        bits = words.view(np.uint8).T[self._octet[rings]]
        bits &= self._bit[rings]
        detected = bits[:, now + pulses :]
        column = rings.searchsorted(before.ring)
        detected[column, 0] = 1
        return self._follow(rings, detected, self._next_ends(bits, pulses), column, first)

    def _follow(
        self,
        rings: npt.NDArray[np.int64],
        detected: npt.NDArray[np.uint8],
        end: npt.NDArray[np.int32],
        going: npt.NDArray[np.int64],
        first: int,
    ) -> npt.NDArray[np.void]:
        """Go on with the open bursts, whose rings are marked as detected at the first pulse, and begin others."""
        pulses = detected.shape[1]
        column, pulse = detected.nonzero()
        stop = end[column, pulse].astype(np.int64)
        # Detections of a ring that run into the same end are one burst, begun by the first of them.
        which = column * (pulses + 1) + stop
        begins = np.ones(len(which), bool)
        np.not_equal(which[1:], which[:-1], out=begins[1:])
        begun = begins.nonzero()[0]
        column, stop = column[begun], stop[begun]
        start, silent = pulse[begun] + first, np.zeros(len(begun), bool)
        place = column.searchsorted(going)
        start[place], silent[place] = self._open.start, self._open.silent
        closed, self._open = OpenBursts(rings[column], start, silent).close(
            stop + first, stop < pulses, self.longest
        )
        return closed

    def open_bursts(self) -> npt.NDArray[np.void]:
        """List the bursts that have not ended."""
        return self._open.heard()

    def _meet(self, words: npt.NDArray[np.uint64], met: npt.NDArray[np.uint64]) -> None:
        """Find where the pattern is met in the last pulses, of whose bits and those before them the words begin."""
        now, pulses = self._history, len(met)
        rows = [words[now - back : now - back + pulses] for back in range(self._program.window)]
        certain = rows.pop(self._program.window - 1 if self._program.late else 0)
        others = self._program.ones - 1
        # enough[n]: the other positions, as far as looked at, hold n ones or more.
        enough: dict[int, npt.NDArray[np.uint64]] = {}
        for looked, row in enumerate(rows, start=1):
            fewest = max(others - (len(rows) - looked), 1)
            for count in range(min(looked, others), fewest - 1, -1):
                more = enough[count - 1] & row if count > 1 else row
                enough[count] = enough[count] | more if count in enough else more
        np.bitwise_and(certain, enough[others] if others else certain, out=met)

    def _next_ends(self, bits: npt.NDArray[np.uint8], pulses: int) -> npt.NDArray[np.int32]:
        """For each ring and pulse the first pulse from there on that completes k zeros, or `pulses`."""
        now = self._history
        busy = bits[:, now : now + pulses]
        for back in range(1, self._program.zeros):
            busy = busy | bits[:, now - back : now - back + pulses]
        ends = np.where(busy, np.int32(pulses), np.arange(pulses, dtype=np.int32))
        return np.minimum.accumulate(ends[:, ::-1], axis=1)[:, ::-1]
