# SPDX-License-Identifier: Apache-2.0
"""How many false plots to expect where, learned from the plots that no confirmed track took.

Rings of equal width, because primary processing makes false plots at equal rate in every range ring, so that their
number per area falls as one over the range (Kuzmin 1967, 4.10). In patches, as over towns or rain, there are more: a
map of cells of each ring multiplies its mean, drawn towards it where a cell has seen too few plots to tell.
"""

from __future__ import annotations

from math import exp, pi

import numpy as np
import numpy.typing as npt

from radar_common.frames import TWO_PI

FloatArray = npt.NDArray[np.float64]

RING = 5e3
SECTORS = 32
_MEMORY_SCANS = 10.0
_MAP_MEMORY_SCANS = 40.0
_MAP_DOUBT = 10.0
"""Plots by which a cell's count is drawn towards its ring's mean."""
_PRIOR_SCANS = 2.0
_PRIOR_PER_RING = 5.0
_LEAST_PER_RING = 0.1


class FalsePlotDensity:
    """Running mean of unclaimed plots per ring and scan, and their share by sectors."""

    def __init__(self, maximum_range: float, *, mapped: bool = False) -> None:
        """Start from a pessimistic guess that the first scans replace.

        Args:
            maximum_range: farthest plot possible, metres.
            mapped: whether the density may differ within a ring.
        """
        self._rings = int(maximum_range / RING) + 1
        self._counts = np.full(self._rings, _PRIOR_PER_RING * _PRIOR_SCANS)
        self._scans = _PRIOR_SCANS
        self._cells = np.zeros(self._rings * SECTORS)
        self.mapped = mapped

    def observe(self, ranges: FloatArray, azimuths: FloatArray) -> None:
        """Count plots that no confirmed track took.

        Args:
            ranges: metres, shape (n,).
            azimuths: radians, shape (n,).
        """
        if len(ranges):
            ring = self._ring(ranges)
            self._counts += np.bincount(ring, minlength=self._rings)
            cell = ring * SECTORS + _sector(azimuths)
            self._cells += np.bincount(cell, minlength=len(self._cells))

    def forget(self, scans: float) -> None:
        """Let time pass.

        Args:
            scans: turns of the antenna since the last call.
        """
        keep = exp(-min(scans, 3.0) / _MEMORY_SCANS)
        self._counts *= keep
        self._scans = keep * self._scans + _MEMORY_SCANS * (1.0 - keep)
        self._cells *= exp(-min(scans, 3.0) / _MAP_MEMORY_SCANS)

    @property
    def per_scan(self) -> float:
        """Unclaimed plots of one scan over the whole coverage."""
        return float(np.add.reduce(self._counts)) / self._scans

    @property
    def unevenness(self) -> float:
        """Greatest density of a cell over the mean of its ring, 1 where all is even."""
        cells = self._cells.reshape(-1, SECTORS)
        mean = cells.mean(axis=1, keepdims=True)
        return float(((cells + _MAP_DOUBT) / (mean + _MAP_DOUBT)).max())

    def per_area(self, ranges: FloatArray, azimuths: FloatArray) -> FloatArray:
        """Density to expect at a place.

        Args:
            ranges: metres, shape (n,).
            azimuths: radians, shape (n,).

        Returns:
            False plots per square metre and scan, positive, shape (n,).
        """
        ring = self._ring(ranges)
        counts = np.maximum(self._counts.take(ring), _LEAST_PER_RING * self._scans)
        counts /= ranges * (2.0 * pi * RING * self._scans)
        if self.mapped:
            cells = self._cells.reshape(-1, SECTORS)
            here = self._cells.take(ring * SECTORS + _sector(azimuths))
            counts *= (here + _MAP_DOUBT) / (cells[ring].mean(axis=1) + _MAP_DOUBT)
        return counts

    def _ring(self, ranges: FloatArray) -> npt.NDArray[np.intp]:
        return np.minimum(ranges / RING, self._rings - 1).astype(np.intp)


def _sector(azimuths: FloatArray) -> npt.NDArray[np.intp]:
    return (azimuths * (SECTORS / TWO_PI)).astype(np.intp) % SECTORS
