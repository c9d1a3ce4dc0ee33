# SPDX-License-Identifier: Apache-2.0
"""How many false plots to expect where, learned from the plots that no confirmed track took.

Rings of equal width, because primary processing makes false plots at equal rate in every range ring, so that their
number per area falls as one over the range (Kuzmin 1967, 4.10).
"""

from __future__ import annotations

from math import exp, pi

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]

RING = 5e3
_MEMORY_SCANS = 10.0
_PRIOR_SCANS = 2.0
_PRIOR_PER_RING = 5.0
_LEAST_PER_RING = 0.1


class FalsePlotDensity:
    """Running mean of unclaimed plots per ring and scan."""

    def __init__(self, maximum_range: float) -> None:
        """Start from a pessimistic guess that the first scans replace.

        Args:
            maximum_range: farthest plot possible, metres.
        """
        self._rings = int(maximum_range / RING) + 1
        self._counts = np.full(self._rings, _PRIOR_PER_RING * _PRIOR_SCANS)
        self._scans = _PRIOR_SCANS

    def observe(self, ranges: FloatArray) -> None:
        """Count plots that no confirmed track took.

        Args:
            ranges: metres, shape (n,).
        """
        if len(ranges):
            self._counts += np.bincount(self._ring(ranges), minlength=self._rings)

    def forget(self, scans: float) -> None:
        """Let time pass.

        Args:
            scans: turns of the antenna since the last call.
        """
        keep = exp(-min(scans, 3.0) / _MEMORY_SCANS)
        self._counts *= keep
        self._scans = keep * self._scans + _MEMORY_SCANS * (1.0 - keep)

    @property
    def per_scan(self) -> float:
        """Unclaimed plots of one scan over the whole coverage."""
        return float(np.add.reduce(self._counts)) / self._scans

    def per_area(self, ranges: FloatArray) -> FloatArray:
        """Density to expect at a place.

        Args:
            ranges: metres, shape (n,).

        Returns:
            False plots per square metre and scan, positive, shape (n,).
        """
        counts = np.maximum(self._counts.take(self._ring(ranges)), _LEAST_PER_RING * self._scans)
        counts /= ranges * (2.0 * pi * RING * self._scans)
        return counts

    def _ring(self, ranges: FloatArray) -> npt.NDArray[np.intp]:
        return np.minimum(ranges / RING, self._rings - 1).astype(np.intp)
