# SPDX-License-Identifier: Apache-2.0
"""Peak power of each burst over the noise level, also of bursts that reach over several messages."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

LARGEST_POWER = np.float32(1e9)
"""Power given to a cell over a noise level of zero, 90 dB."""


class PowerMeter:
    """Holds the ratios of the pulses at hand and the highest one so far of each burst that is still open."""

    def __init__(self, noise_scale: npt.NDArray[np.float64], memory: int) -> None:
        """Start with nothing seen.

        Args:
            noise_scale: factor from a ratio to power over the mean noise power, shape (cells,).
            memory: pulses before a burst's start that belong to it.
        """
        self._scale = noise_scale.astype(np.float32)
        self._memory = memory
        self._ratios = np.zeros((memory, len(noise_scale)), np.float32)
        self._used = memory
        self._running = np.zeros(len(noise_scale), np.float32)

    def reset(self) -> None:
        """Forget all past pulses."""
        self._ratios[: self._used] = 0.0

    def room(self, pulses: int) -> npt.NDArray[np.float32]:
        """Make room for the ratios of the next pulses; the last few of those before are kept.

        Args:
            pulses: how many.

        Returns:
            Array to write the ratios to, shape (pulses, cells).
        """
        memory = self._memory
        kept = self._ratios[self._used - memory : self._used].copy()
        if len(self._ratios) < memory + pulses:
            self._ratios = np.zeros((memory + pulses, self._ratios.shape[1]), np.float32)
        self._ratios[:memory] = kept
        self._used = memory + pulses
        return self._ratios[memory : self._used]

    def measure(
        self, closed: npt.NDArray[np.void], going: npt.NDArray[np.void], first: int
    ) -> None:
        """Fill in the power of the bursts that have ended and follow those that have not.

        Args:
            closed: bursts that ended within the pulses at hand; `power` is written.
            going: bursts that have not ended.
            first: number of the first of the pulses at hand.
        """
        ring = np.concatenate([closed["ring"], going["ring"]])
        if not len(ring):
            return
        count = len(closed)
        start = np.concatenate([closed["start"], going["start"]])
        last = first + self._used - self._memory - 1
        stop = np.full(len(ring), last)
        stop[:count] = closed["end"]
        carried = start < first
        begin = np.where(carried, first, start - self._memory)
        # A limit that has just become shorter ends a burst before these pulses.
        length = np.maximum(stop - begin + 1, 1)
        end = np.add.accumulate(length)
        offset = end - length
        cells = self._ratios.shape[1]
        place = np.repeat((begin - offset - first + self._memory) * cells + ring, length)
        place += np.arange(0, len(place) * cells, cells)
        peak = np.fmax.reduceat(self._ratios.reshape(-1)[place], offset)
        peak = np.minimum(peak * self._scale[ring], LARGEST_POWER)
        peak = np.where(carried, np.fmax(peak, self._running[ring]), peak)
        closed["power"] = peak[:count]
        self._running[going["ring"]] = peak[count:]
