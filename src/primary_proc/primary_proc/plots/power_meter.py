# SPDX-License-Identifier: Apache-2.0
"""Peak power of each burst over the noise level, also of bursts that reach over several messages."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from primary_proc.plots.ratio_history import RatioHistory

LARGEST_POWER = np.float32(1e9)
"""Power given to a cell over a noise level of zero, 90 dB."""


class PowerMeter:
    """Follows the highest ratio of each burst that is still open."""

    def __init__(self, noise_scale: npt.NDArray[np.float64], memory: int) -> None:
        """Start with nothing seen.

        Args:
            noise_scale: factor from a ratio to power over the mean noise power, shape (cells,).
            memory: pulses before a burst's start that belong to it.
        """
        self._scale = noise_scale.astype(np.float32)
        self._memory = memory
        self._running = np.zeros(len(noise_scale), np.float32)

    def measure(
        self,
        closed: npt.NDArray[np.void],
        going: npt.NDArray[np.void],
        first: int,
        history: RatioHistory,
    ) -> None:
        """Fill in the power of the bursts that have ended and follow those that have not.

        Args:
            closed: bursts that ended within the pulses at hand; `power` is written.
            going: bursts that have not ended.
            first: number of the first of the pulses at hand.
            history: ratios of these pulses and of those in the memory before them.
        """
        ring = np.concatenate([closed["ring"], going["ring"]])
        if not len(ring):
            return
        count = len(closed)
        start = np.concatenate([closed["start"], going["start"]])
        oldest, cells = history.first, history.ratios.shape[1]
        stop = np.full(len(ring), oldest + len(history.ratios) - 1)
        stop[:count] = closed["end"]
        carried = start < first
        begin = np.where(carried, first, np.maximum(start - self._memory, oldest))
        # A limit that has just become shorter ends a burst before these pulses.
        length = np.maximum(stop - begin + 1, 1)
        end = np.add.accumulate(length)
        offset = end - length
        place = np.repeat((begin - offset - oldest) * cells + ring, length)
        place += np.arange(0, len(place) * cells, cells)
        peak = np.fmax.reduceat(history.ratios.reshape(-1)[place], offset)
        peak = np.minimum(peak * self._scale[ring], LARGEST_POWER)
        peak = np.where(carried, np.fmax(peak, self._running[ring]), peak)
        closed["power"] = peak[:count]
        self._running[going["ring"]] = peak[count:]
