# SPDX-License-Identifier: Apache-2.0
"""The grid of cells that quantisation in time makes of a radar's zone."""

from __future__ import annotations

import math
from dataclasses import dataclass

from radar_common.parameters import ParameterError

SPEED_OF_LIGHT = 299_792_458.0


@dataclass(frozen=True, slots=True)
class SurveillanceGrid:
    """Cells of a rotating radar.

    Attributes:
        clock: period t_k of the time quantisation, s.
        pulse_interval: T_p, s.
        scan_period: T_0, s.
        longest_range: D_max, m.
    """

    clock: float
    pulse_interval: float
    scan_period: float
    longest_range: float

    def __post_init__(self) -> None:
        """Check the values.

        Raises:
            ParameterError: one of them is not positive.
        """
        if not min(self.clock, self.pulse_interval, self.scan_period, self.longest_range) > 0.0:
            raise ParameterError("clock, pulse interval, scan period and range must be positive")

    @property
    def range_step(self) -> float:
        """Length of a cell in metres, (2.22)."""
        return SPEED_OF_LIGHT * self.clock / 2.0

    @property
    def range_cells(self) -> float:
        """Cells along range, (2.23); not always a whole number."""
        return self.longest_range / self.range_step

    @property
    def azimuth_step(self) -> float:
        """Angle between pulses in radians, (2.24)."""
        return math.tau * self.pulse_interval / self.scan_period

    @property
    def cells(self) -> float:
        """Cells of the whole zone, (2.25)."""
        return math.tau * self.longest_range / (self.range_step * self.azimuth_step)

    def pulses_in_burst(self, width: float) -> float:
        """Pulses within a width of the beam, N_0.

        Source: Kuzmin 1967, (1.27) by way of (2.24).

        Args:
            width: 2 phi, rad.

        Returns:
            Number, not always whole.
        """
        return width / self.azimuth_step
