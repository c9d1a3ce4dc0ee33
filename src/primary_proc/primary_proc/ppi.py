# SPDX-License-Identifier: Apache-2.0
"""Plan position indicator: the video of one turn as a picture for people, north up."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from radar_common.frames import TWO_PI, wrap_two_pi
from radar_common.tables import Table

_CONTRAST_DB = 30.0


class PlanPosition:
    """Paints sectors into a square picture.

    A pixel shows the strongest of the range cells that it covers, in decibels over the median of the sector, so that
    the picture is alike for every receiver gain.

    Attributes:
        image: brightness, shape (pixels, pixels), row 0 in the north, the last column in the east.
    """

    def __init__(self, pixels: int) -> None:
        """Start with a black picture.

        Args:
            pixels: width and height.
        """
        self.image = np.zeros((pixels, pixels), np.uint8)
        self._rings = pixels // 2
        middle = (pixels - 1) / 2.0
        north, east = np.meshgrid(
            middle - np.arange(pixels), np.arange(pixels) - middle, indexing="ij"
        )
        ring = np.hypot(north, east).astype(np.int64).reshape(-1)
        azimuth = wrap_two_pi(np.arctan2(east, north)).reshape(-1)
        inside = np.flatnonzero(ring < self._rings)
        # In order of azimuth a sector is a slice.
        self._pixel = inside[np.argsort(azimuth[inside], kind="stable")]
        self._azimuth, self._ring = azimuth[self._pixel], ring[self._pixel]
        self._swept = self._step = 0.0

    def paint(self, sweeps: Table) -> bool:
        """Paint a sector.

        Args:
            sweeps: one message of `radar/sweeps`.

        Returns:
            Whether it completes a turn since this was last so.
        """
        rows = sweeps.rows[np.isfinite(sweeps.rows["azimuth"])]
        if not len(rows):
            return False
        bright = self._brightness(rows["video"])
        turned = np.unwrap(rows["azimuth"]) - rows["azimuth"][0]
        if len(rows) > 1:
            self._step = max(float(turned[-1]), 0.0) / (len(rows) - 1)
        begin = float(wrap_two_pi(rows["azimuth"][0]))
        span = min(self._step * len(rows), TWO_PI)
        for first, last in ((begin, begin + span), (begin - TWO_PI, begin + span - TWO_PI)):
            some = slice(*np.searchsorted(self._azimuth, (first, last)))
            pulse = np.searchsorted(turned, self._azimuth[some] - first, side="right") - 1
            self.image.reshape(-1)[self._pixel[some]] = bright[pulse, self._ring[some]]
        self._swept += span
        if self._swept < TWO_PI - self._step / 2.0:
            return False
        self._swept = 0.0
        return True

    def _brightness(self, video: npt.NDArray) -> npt.NDArray[np.uint8]:
        """Brightness of each pulse and ring of pixels, shape (pulses, rings)."""
        cells = video.shape[1]
        edges = np.arange(self._rings) * cells // self._rings
        strongest = np.maximum.reduceat(video.astype(np.float32), edges, axis=1)
        np.nan_to_num(strongest, copy=False, posinf=0.0, neginf=0.0)
        level = float(np.median(strongest)) or 1.0
        decibels = 20.0 * np.log10(np.maximum(strongest / level, 1.0))
        return (np.minimum(decibels / _CONTRAST_DB, 1.0) * 255.0).astype(np.uint8)
