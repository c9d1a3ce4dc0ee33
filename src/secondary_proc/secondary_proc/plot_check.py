# SPDX-License-Identifier: Apache-2.0
"""What a plot must be to be used: finite, in range, near its message's time, with an error that can be believed."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from radar_common.frames import TWO_PI, wrap_two_pi
from radar_common.health import Health
from secondary_proc.plots import (
    AZIMUTH,
    AZIMUTH_STD,
    PLOT_ROWS,
    POLAR_ROWS,
    RANGE,
    RANGE_STD,
    STRENGTH,
    TIME,
    FloatArray,
    locate,
)

if TYPE_CHECKING:
    from secondary_proc.parameters import TrackerParameters

LONGEST_OFFSET = 60.0
LARGEST_RANGE_STD = 10e3
LARGEST_AZIMUTH_STD = 0.5

_TAKEN_OVER = (
    (TIME, "time_offset"),
    (RANGE, "range"),
    (AZIMUTH, "azimuth"),
    (RANGE_STD, "range_std"),
    (AZIMUTH_STD, "azimuth_std"),
    (STRENGTH, "snr_db"),
)
_CHECKED = STRENGTH


class PlotCheck:
    """The limits that a set of parameters draws."""

    def __init__(self, parameters: TrackerParameters) -> None:
        """Draw the limits.

        Args:
            parameters: limits and errors by default.
        """
        self._parameters = parameters
        self._lowest = np.zeros((_CHECKED, 1))
        self._lowest[TIME], self._lowest[RANGE] = -LONGEST_OFFSET, np.nextafter(0.0, 1.0)
        self._lowest[RANGE_STD] = parameters.minimum_range_std
        self._lowest[AZIMUTH_STD] = parameters.minimum_azimuth_std
        self._highest = np.zeros((_CHECKED, 1))
        self._highest[TIME], self._highest[RANGE] = LONGEST_OFFSET, parameters.maximum_range
        self._highest[AZIMUTH] = np.nextafter(TWO_PI, 0.0)
        self._highest[RANGE_STD] = LARGEST_RANGE_STD
        self._highest[AZIMUTH_STD] = LARGEST_AZIMUTH_STD

    def __call__(self, source: npt.NDArray[np.void], stamp: float, health: Health) -> FloatArray:
        """Take over the plots that can be used; the others are dropped and counted by reason.

        Errors of plots that tell none, or none above zero, are the parameters' defaults.

        Args:
            source: plots, dtype PLOT, shape (n,).
            stamp: of their message, seconds.
            health: where refused plots are counted.

        Returns:
            Plots as `Plots` keeps them, shape (PLOT_ROWS, m), m <= n.
        """
        values = np.empty((PLOT_ROWS, len(source)))
        for row, name in _TAKEN_OVER:
            values[row] = source[name]
        told = values[:_CHECKED]
        # Most messages hold nothing to object to; then two comparisons are enough.
        good = (told >= self._lowest) & (told <= self._highest)
        if np.count_nonzero(good) < good.size:
            values = self._usable(values, health)
        values[TIME] += stamp
        locate(values, self._parameters.bias)
        return values

    def _usable(self, values: FloatArray, health: Health) -> FloatArray:
        parameters = self._parameters
        values[RANGE_STD] = _error(
            values[RANGE_STD], parameters.default_range_std, parameters.minimum_range_std
        )
        values[AZIMUTH_STD] = _error(
            values[AZIMUTH_STD], parameters.default_azimuth_std, parameters.minimum_azimuth_std
        )
        good = (
            (values[RANGE] > 0.0)
            & (values[RANGE] <= parameters.maximum_range)
            & np.isfinite(values[AZIMUTH])
            & (np.abs(values[TIME]) <= LONGEST_OFFSET)
            & (values[RANGE_STD] <= LARGEST_RANGE_STD)
            & (values[AZIMUTH_STD] <= LARGEST_AZIMUTH_STD)
        )
        if not good.all():
            _count(values[:POLAR_ROWS, ~good], parameters, health)
            values = values[:, good]
        values[AZIMUTH] = wrap_two_pi(values[AZIMUTH])
        return values


def _error(told: npt.NDArray[np.floating], default: float, smallest: float) -> FloatArray:
    return np.maximum(np.where(told > 0.0, told, default), smallest)


def _count(polar: FloatArray, parameters: TrackerParameters, health: Health) -> None:
    finite = np.isfinite(polar[[TIME, RANGE, AZIMUTH]]).all(axis=0)
    counted = np.zeros(polar.shape[1], bool)
    for reason, bad in (
        ("plots that are not finite", ~finite),
        ("plots at no positive range", polar[RANGE] <= 0.0),
        ("plots beyond the maximum range", polar[RANGE] > parameters.maximum_range),
        ("plots far from their message's time", np.abs(polar[TIME]) > LONGEST_OFFSET),
        ("plots with huge errors", np.ones(polar.shape[1], bool)),
    ):
        health.drop(reason, int(np.count_nonzero(bad & ~counted)))
        counted |= bad
