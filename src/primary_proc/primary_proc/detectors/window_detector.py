# SPDX-License-Identifier: Apache-2.0
"""Sliding weighted sum over the last pulses of every range ring; a burst is a run of sums at or over a threshold.

Scores and weights are whole numbers held as float32 and their sums stay under 2^24, so that the matrix product that
forms the sums is exact: nothing drifts, and how pulses are grouped into messages cannot change a result.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from primary_proc.detectors.burst_detector import BurstDetector, bursts, in_order

LARGEST_SUM = 1 << 24
"""Float32 holds every whole number up to here."""

_ROWS = 32
# Products of one matrix product. A BLAS spreads larger ones over threads, which costs more than it brings here.
_PRODUCTS = 1 << 18
_NARROWEST = 32
_NEVER = np.iinfo(np.int64).max
_RUN = np.dtype(
    [
        ("ring", np.int64),  # range cell
        ("start", np.int64),  # first pulse at or over the threshold
        ("stop", np.int64),  # first pulse after those seen so far
        ("best", np.float32),  # largest sum that counts
        ("first_best", np.int64),  # first pulse with that sum
        ("last_best", np.int64),  # last pulse with that sum
        ("settled", np.bool_),  # the peak is found, later sums do not count
        ("silent", np.bool_),  # ended by the limit, waits for the sums to fall
    ]
)


class WindowDetector(BurstDetector):
    """Bursts of a sliding sum.

    A burst starts at the first pulse whose sum reaches the threshold and ends at the first whose sum does not, which
    also arms the ring for the next. Its centre is the middle between the first and the last pulse with the largest
    sum, less the delay of half the register. Where the first peak counts, it is the largest sum before the first that
    falls (Kuzmin 1967, § 3.1.6, which does not say how to go on); the rest of the run is waited out.
    """

    def __init__(
        self,
        taps: npt.ArrayLike,
        threshold: float,
        rings: int,
        longest: int,
        *,
        first_peak: bool = False,
    ) -> None:
        """Start with an empty register.

        Args:
            taps: whole weights of the pulses on each channel, the oldest pulse first, shape (channels, pulses).
            threshold: that a sum must reach.
            rings: range rings.
            longest: limit of a burst's length, in pulses.
            first_peak: whether the centre is the first peak of the sum rather than the highest.
        """
        weights = np.asarray(taps, np.float32)
        self._channels, length = weights.shape
        self.rule = weights.shape, weights.tobytes(), threshold, first_peak
        self.memory = length - 1
        self.longest = longest
        self._threshold = np.float32(threshold)
        self._rings, self._narrow = rings, np.min_scalar_type(rings)
        self._first_peak = first_peak
        self._filter = np.zeros((_ROWS, _ROWS + self.memory, self._channels), np.float32)
        for row in range(_ROWS):
            self._filter[row, row : row + length] = weights.T
        self.reset()

    def reset(self) -> None:
        """Forget all past pulses."""
        self._past = np.zeros((self.memory, self._channels, self._rings), np.float32)
        self._open = np.zeros(0, _RUN)

    def detect(self, samples: npt.NDArray, first: int) -> npt.NDArray[np.void]:
        """Go on with the next pulses; see `BurstDetector.detect`.

        Args:
            samples: whole scores as float32, shape (pulses, channels, rings).
            first: number of the first pulse.

        Returns:
            Bursts that ended.
        """
        pulses = len(samples)
        register = np.concatenate([self._past, samples])
        self._past = register[pulses:].copy()
        sums = self._sums(register, pulses)
        over = sums >= self._threshold
        runs = self._follow(sums, over, first) if over.any() else self._open
        return self._close(runs, first + pulses)

    def open_bursts(self) -> npt.NDArray[np.void]:
        """List the bursts that have not ended."""
        heard = self._open[~self._open["silent"]]
        return bursts(heard["ring"], heard["start"], -1, False)

    def _sums(self, register: npt.NDArray[np.float32], pulses: int) -> npt.NDArray[np.float32]:
        """Sums with each pulse as the newest of the register, shape (pulses, rings)."""
        sums = np.empty((pulses, self._rings), np.float32)
        flat = register.reshape(-1, self._rings)
        for row in range(0, pulses, _ROWS):
            count = min(_ROWS, pulses - row)
            span = count + self.memory
            weights = self._filter[:count, :span].reshape(count, span * self._channels)
            block = flat[row * self._channels : (row + span) * self._channels]
            width = max(_PRODUCTS // weights.size, _NARROWEST)
            for ring in range(0, self._rings, width):
                part = slice(ring, ring + width)
                np.matmul(weights, block[:, part], out=sums[row : row + count, part])
        return sums

    def _follow(
        self, sums: npt.NDArray[np.float32], over: npt.NDArray[np.bool_], first: int
    ) -> npt.NDArray[np.void]:
        """The runs of these pulses, of which there are some; those open before are gone on with."""
        before = self._open
        row, ring = np.divmod(np.flatnonzero(over), self._rings)
        order = np.argsort(ring.astype(self._narrow), kind="stable")
        row, ring = row[order], ring[order]
        value, pulse = sums[row, ring], first + row
        opens = np.ones(len(ring), bool)
        opens[1:] = (ring[1:] != ring[:-1]) | (row[1:] != row[:-1] + 1)
        begin, run = np.flatnonzero(opens), np.cumsum(opens) - 1
        last = np.append(begin[1:], len(ring)) - 1

        runs = np.zeros(len(begin), _RUN)
        runs["ring"], runs["start"], runs["stop"] = ring[begin], pulse[begin], pulse[last] + 1
        runs["best"] = -np.inf
        source = np.full(self._rings, -1)
        source[before["ring"]] = np.arange(len(before))
        carried = np.where(row[begin] == 0, source[ring[begin]], -1)
        old = np.flatnonzero(carried >= 0)
        past = before[carried[old]]
        for name in ("start", "best", "settled", "silent"):
            runs[name][old] = past[name]

        counts = pulse - runs["start"][run] < self.longest
        if self._first_peak:
            falls = np.zeros(len(ring), bool)
            falls[1:] = value[1:] < value[:-1]
            falls[begin] = runs["settled"] | (value[begin] < runs["best"])
            fallen = np.cumsum(falls)
            fallen -= (fallen[begin] - falls[begin])[run]
            counts &= fallen == 0
            runs["settled"] = fallen[last] > 0
        value = np.where(counts, value, -np.inf)
        runs["best"] = np.maximum(np.maximum.reduceat(value, begin), runs["best"])
        at_best = counts & (value == runs["best"][run])
        runs["first_best"] = np.minimum.reduceat(np.where(at_best, pulse, _NEVER), begin)
        runs["last_best"] = np.maximum.reduceat(np.where(at_best, pulse, -_NEVER), begin)
        same = past["best"] == runs["best"][old]
        past, old = past[same], old[same]
        runs["first_best"][old] = past["first_best"]
        runs["last_best"][old] = np.maximum(runs["last_best"][old], past["last_best"])

        ended = np.ones(len(before), bool)
        ended[carried[carried >= 0]] = False
        return np.concatenate([before[ended], runs])

    def _close(self, runs: npt.NDArray[np.void], after: int) -> npt.NDArray[np.void]:
        """Split runs into bursts that ended, which are returned, and those kept open."""
        limit = runs["start"] + self.longest
        ended = runs["stop"] < after
        overflow = ~runs["silent"] & (runs["stop"] > limit)
        closed = overflow | (ended & ~runs["silent"])
        table = bursts(
            runs["ring"][closed],
            runs["start"][closed],
            np.minimum(runs["stop"], limit)[closed],
            overflow[closed],
            (runs["first_best"] + runs["last_best"])[closed] / 2.0 - self.memory / 2.0,
        )
        kept = runs[~ended]
        kept["silent"] |= overflow[~ended]
        self._open = kept[np.argsort(kept["ring"], kind="stable")]
        return in_order(table)
