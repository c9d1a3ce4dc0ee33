# SPDX-License-Identifier: Apache-2.0
"""Peak power of each burst over the noise level, also of bursts that reach over several messages."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from primary_proc.plots.ratio_history import RatioHistory

LARGEST_POWER = np.float32(1e9)
"""Power given to a cell over a noise level of zero, 90 dB."""


class PowerMeter:
    """Looks up the ratios of a burst when it has ended; the history still has them."""

    def __init__(self, noise_scale: npt.NDArray[np.float64], memory: int) -> None:
        """Set up for a normaliser and a detector.

        Args:
            noise_scale: factor from a ratio to power over the mean noise power, shape (cells,).
            memory: pulses before a burst's start that belong to it.
        """
        self._scale = noise_scale.astype(np.float32)
        self._memory = memory

    def measure(self, closed: npt.NDArray[np.void], history: RatioHistory) -> None:
        """Fill in the power of bursts.

        Args:
            closed: bursts that have ended; `power` is written.
            history: ratios from before the first of them began.
        """
        if not len(closed):
            return
        ring, cells = closed["ring"], history.ratios.shape[1]
        begin = np.maximum(closed["start"] - (self._memory + history.first), 0)
        length = closed["end"] - (history.first - 1) - begin
        stop = np.add.accumulate(length)
        offset = stop - length
        place = ((begin - offset) * cells + ring).repeat(length)
        place += np.arange(0, len(place) * cells, cells)
        peak = np.fmax.reduceat(history.ratios.reshape(-1)[place], offset)
        closed["power"] = np.minimum(peak * self._scale[ring], LARGEST_POWER)
