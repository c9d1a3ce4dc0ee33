# SPDX-License-Identifier: Apache-2.0
"""Division of the coverage into zones of range and azimuth, fixed to the ground."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from radar_common.frames import TWO_PI

_BEAMS = 8.0
_CELLS = 64
_FEWEST_SECTORS, _MOST_SECTORS = 4, 256


class Zones:
    """Sectors of about eight beamwidths, each cut into zones of about 64 range cells.

    A zone so large holds some 500 resolution cells, beamwidth by range cell: enough to tell clutter from a few targets
    within one turn. Smaller ones would follow the edge of clutter better and take longer to be sure.

    Attributes:
        sectors: number of sectors in a turn.
        bounds: range cell where each zone begins, and the end of the last, shape (zones + 1,).
        widths: range cells of each zone, shape (zones,).
        resolution_cells: resolution cells of each zone of a sector, shape (zones,).
    """

    def __init__(self, cells: int, beamwidth: float) -> None:
        """Lay out the zones.

        Args:
            cells: range cells of a pulse.
            beamwidth: one-way half-power width, rad.
        """
        sectors = round(TWO_PI / (_BEAMS * beamwidth))
        self.sectors = min(max(sectors, _FEWEST_SECTORS), _MOST_SECTORS)
        count = max(1, round(cells / _CELLS))
        self.bounds = np.linspace(0, cells, count + 1).round().astype(np.int64)
        self.widths = np.diff(self.bounds)
        self._zone_of = np.repeat(np.arange(count), self.widths)
        self.resolution_cells = self.widths * (TWO_PI / self.sectors / beamwidth)

    def __len__(self) -> int:
        """Count the zones of one sector."""
        return len(self.bounds) - 1

    def sector(self, azimuth: npt.ArrayLike) -> npt.NDArray[np.int64]:
        """Tell the sector of an azimuth.

        Args:
            azimuth: rad in [0, 2 pi), any shape.

        Returns:
            Number of the sector, same shape.
        """
        index = np.asarray(azimuth) * (self.sectors / TWO_PI)
        return np.minimum(index.astype(np.int64), self.sectors - 1)

    def zone(self, cell: npt.ArrayLike) -> npt.NDArray[np.int64]:
        """Tell the zone of a range cell.

        Args:
            cell: number of the cell, with or without a fraction, any shape.

        Returns:
            Number of the zone within its sector, same shape.
        """
        return self._zone_of.take(np.asarray(cell).astype(np.int64), mode="clip")

    def cells(self, zone: npt.NDArray[np.integer]) -> tuple[npt.NDArray[np.int64], npt.NDArray]:
        """List the range cells of some zones.

        Args:
            zone: numbers of zones, shape (n,).

        Returns:
            The cells, zone after zone, and for each the place of its zone in the list; both shape (cells,).
        """
        width = self.widths[zone]
        place = np.repeat(np.arange(len(zone)), width)
        before = np.concatenate([[0], np.cumsum(width)[:-1]])
        return self.bounds[zone][place] + np.arange(width.sum()) - before[place], place

    def neighbours(
        self, sector: int, zone: npt.NDArray[np.integer]
    ) -> tuple[npt.NDArray[np.int64], npt.NDArray[np.int64]]:
        """List the zones that touch some zones of a sector, those zones among them.

        Args:
            sector: number of the sector.
            zone: numbers of zones in it, shape (n,).

        Returns:
            Sector and zone of each, shape (9 n,); at the ends of the range some stand twice.
        """
        along, across = np.meshgrid([-1, 0, 1], [-1, 0, 1])
        sectors = np.broadcast_to((sector + along.ravel()) % self.sectors, (len(zone), 9))
        zones = np.clip(np.asarray(zone)[:, None] + across.ravel(), 0, len(self) - 1)
        return sectors.ravel(), zones.ravel()
