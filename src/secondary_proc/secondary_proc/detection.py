# SPDX-License-Identifier: Apache-2.0
"""How probable a plot is per passage of the beam, learned in rings of range from the confirmed tracks.

A gap counts once a plot has closed it: misses of a target that has gone would be taken for those of one that is there.
"""

from __future__ import annotations

from math import exp
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

if TYPE_CHECKING:
    from secondary_proc.parameters import TrackerParameters

FloatArray = npt.NDArray[np.float64]

RING = 10e3
_MEMORY_SCANS = 300.0
_PRIOR_PASSAGES = 50.0
_LEAST, _MOST = 0.1, 0.98
_ENOUGH_PASSAGES = 50.0


class DetectionByRange:
    """Running share of passages with a plot, a ring each, drawn towards the user's value where there are few."""

    def __init__(self, parameters: TrackerParameters) -> None:
        """Start with the user's value everywhere.

        Args:
            parameters: the value, and whether it is learned.
        """
        self._rings = int(parameters.maximum_range / RING) + 1
        self._plots = np.zeros(self._rings)
        self._passages = np.zeros(self._rings)
        self.reconfigure(parameters)

    def reconfigure(self, parameters: TrackerParameters) -> None:
        """Go on with other parameters and what has been learned.

        Args:
            parameters: the value, and whether it is learned.
        """
        self._prior = parameters.detection_probability
        self._learns = parameters.learn_detection

    def observe(self, ranges: FloatArray, misses: npt.NDArray[np.integer]) -> None:
        """Count the plots of confirmed tracks and the gaps that they close.

        Args:
            ranges: of the plots, metres, shape (n,).
            misses: passages without a plot before each, shape (n,).
        """
        ring = self._ring(ranges)
        self._plots += np.bincount(ring, minlength=self._rings)
        self._passages += np.bincount(ring, misses + 1.0, minlength=self._rings)

    def forget(self, scans: float) -> None:
        """Let time pass.

        Args:
            scans: turns of the antenna since the last call.
        """
        keep = exp(-min(scans, 3.0) / _MEMORY_SCANS)
        self._plots *= keep
        self._passages *= keep

    def probability(self, ranges: FloatArray) -> FloatArray | float:
        """Probability of a plot.

        Args:
            ranges: metres, shape (n,).

        Returns:
            Shape (n,), or one value for all where it is not learned.
        """
        if not self._learns:
            return self._prior
        ring = self._ring(ranges)
        plots = self._plots.take(ring) + _PRIOR_PASSAGES * self._prior
        return np.minimum(
            np.maximum(plots / (self._passages.take(ring) + _PRIOR_PASSAGES), _LEAST), _MOST
        )

    def shares(self) -> dict[str, float]:
        """Shares as they have been counted, of bands that have enough of them.

        Returns:
            Share of passages with a plot by name of the band.
        """
        width = 4
        bands = {}
        for begin in range(0, self._rings, width):
            passages = float(self._passages[begin : begin + width].sum())
            if passages >= _ENOUGH_PASSAGES:
                name = f"{begin * RING / 1e3:.0f} to {(begin + width) * RING / 1e3:.0f} km"
                bands[name] = float(self._plots[begin : begin + width].sum()) / passages
        return bands

    def _ring(self, ranges: FloatArray) -> npt.NDArray[np.intp]:
        return np.minimum(ranges / RING, self._rings - 1).astype(np.intp)
