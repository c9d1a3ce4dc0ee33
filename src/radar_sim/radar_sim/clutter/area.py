# SPDX-License-Identifier: Apache-2.0
"""A piece of the coverage between two ranges and two azimuths, as the beam sees it."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from radar_common.frames import TWO_PI, FloatArray, wrap_two_pi
from radar_common.parameters import ParameterError, parameter
from radar_sim.disturbance import DisturbanceSection
from radar_sim.radar import Radar

_STEPS = 2001


@dataclass(frozen=True, kw_only=True)
class AreaSection(DisturbanceSection):
    """Where clutter is; base of the sections that have such an extent."""

    range_from: float = parameter(1_000.0, "near edge", unit="m", low=0.0, high=1e6)
    range_to: float = parameter(20_000.0, "far edge", unit="m", low=1.0, high=1e6)
    azimuth_from_deg: float = parameter(
        0.0,
        "edge at which the beam comes in, clockwise from north",
        unit="deg",
        low=-360.0,
        high=360.0,
    )
    azimuth_to_deg: float = parameter(
        360.0,
        "edge at which it goes out; 360 more is the whole circle",
        unit="deg",
        low=-360.0,
        high=720.0,
    )

    def check(self) -> None:
        """Check that the edges are in order.

        Raises:
            ParameterError: they are not.
        """
        if self.range_to <= self.range_from:
            raise ParameterError(
                f"range_to {self.range_to:g} m is not beyond range_from {self.range_from:g} m"
            )
        if not 0.0 < self.azimuth_to_deg - self.azimuth_from_deg <= 360.0:
            raise ParameterError(
                f"azimuth_to_deg {self.azimuth_to_deg:g} must be after azimuth_from_deg "
                f"{self.azimuth_from_deg:g}, by 360 at most; add 360 to it across north"
            )

    def require_fit(self, radar: Radar) -> None:
        """Check that the radar sees some of it.

        Args:
            radar: the radar of the scenario.

        Raises:
            ParameterError: it lies outside the range cells.
        """
        if not len(_cells_inside(self, radar)):
            raise ParameterError(
                f"no range cell has its centre between range_from {self.range_from:g} m and range_to "
                f"{self.range_to:g} m; the cells reach from {radar.range_start:g} to {radar.range_end:g} m"
            )


class Area:
    """An area as the beam sees it: sharp in range, in azimuth as wide as the beam makes it.

    Attributes:
        first_cell: the nearest range cell inside.
        ranges: centres of the range cells inside, m, shape (cells,).
    """

    def __init__(self, section: AreaSection, radar: Radar) -> None:
        """Find its range cells and the beam's share of its edges.

        Args:
            section: the edges.
            radar: cells and pattern.
        """
        cells = _cells_inside(section, radar)
        self.first_cell = int(cells[0])
        self.ranges: FloatArray = np.add(radar.range_start, (cells + 0.5) * radar.range_step)
        self._radar = radar
        self._begin = math.radians(section.azimuth_from_deg)
        self._width = math.radians(section.azimuth_to_deg - section.azimuth_from_deg)
        extent = radar.beam.extent
        self._alpha = np.linspace(-extent, extent, _STEPS)
        power = np.square(radar.beam(self._alpha))
        self._share = np.concatenate([[0.0], np.cumsum(power[1:] + power[:-1])])
        self._share /= self._share[-1]

    def share(self, azimuth: npt.ArrayLike) -> FloatArray:
        """Share of the two-way pattern's power that falls on the area.

        Args:
            azimuth: of the beam's axis, rad, any shape.

        Returns:
            0 outside, 1 inside, between within a beam of the edges; same shape.
        """
        if self._width >= TWO_PI:
            return np.ones(np.shape(azimuth))
        inside = wrap_two_pi(np.asarray(azimuth, dtype=float) - self._begin)
        # The axis may stand before the edge where the beam comes in: that is a turn less a little.
        return self._lit(inside) + self._lit(inside - TWO_PI)

    def _lit(self, inside: FloatArray) -> FloatArray:
        before, after = -inside, self._width - inside
        low, high = (
            np.interp(edge / self._radar.half_width, self._alpha, self._share)
            for edge in (before, after)
        )
        return np.asarray(high - low)


def _cells_inside(section: AreaSection, radar: Radar) -> npt.NDArray[np.int64]:
    centre = radar.range_start + (np.arange(radar.cells) + 0.5) * radar.range_step
    return np.flatnonzero((centre >= section.range_from) & (centre < section.range_to))
