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
    QUEUE_COLUMNS,
    RANGE,
    RANGE_STD,
    STRENGTH,
    TIME,
    FloatArray,
)

if TYPE_CHECKING:
    from secondary_proc.parameters import TrackerParameters

LONGEST_OFFSET = 60.0
LARGEST_RANGE_STD = 10e3
LARGEST_AZIMUTH_STD = 0.5

_TAKEN_OVER = (
    (RANGE, "range"),
    (AZIMUTH, "azimuth"),
    (RANGE_STD, "range_std"),
    (AZIMUTH_STD, "azimuth_std"),
    (STRENGTH, "snr_db"),
)
_LOWEST = np.zeros(QUEUE_COLUMNS)
_LOWEST[TIME], _LOWEST[RANGE] = -LONGEST_OFFSET, np.nextafter(0.0, 1.0)
_HIGHEST = np.zeros(QUEUE_COLUMNS)
_HIGHEST[TIME], _HIGHEST[AZIMUTH] = LONGEST_OFFSET, np.nextafter(TWO_PI, 0.0)
_HIGHEST[RANGE_STD], _HIGHEST[AZIMUTH_STD] = LARGEST_RANGE_STD, LARGEST_AZIMUTH_STD


def check(
    source: npt.NDArray[np.void], stamp: float, parameters: TrackerParameters, health: Health
) -> FloatArray:
    """Take over the plots that can be used; the others are dropped and counted by reason.

    Errors of plots that tell none, or none above zero, are the parameters' defaults.

    Args:
        source: plots, dtype PLOT, shape (n,).
        stamp: of their message, seconds.
        parameters: limits and errors by default.
        health: where refused plots are counted.

    Returns:
        Plots as the queue keeps them, shape (m, QUEUE_COLUMNS), m <= n.
    """
    rows = np.empty((len(source), QUEUE_COLUMNS))
    rows[:, TIME] = offset = source["time_offset"]
    for column, name in _TAKEN_OVER:
        rows[:, column] = source[name]
    lowest = _LOWEST.copy()
    lowest[RANGE_STD] = parameters.minimum_range_std
    lowest[AZIMUTH_STD] = parameters.minimum_azimuth_std
    highest = _HIGHEST.copy()
    highest[RANGE] = parameters.maximum_range
    # Most messages hold nothing to object to; then two comparisons are enough.
    if ((rows >= lowest) & (rows <= highest))[:, :STRENGTH].all():
        rows[:, TIME] += stamp
        return rows
    rows[:, TIME] += stamp
    rows[:, RANGE_STD] = _error(
        source["range_std"], parameters.default_range_std, parameters.minimum_range_std
    )
    rows[:, AZIMUTH_STD] = _error(
        source["azimuth_std"], parameters.default_azimuth_std, parameters.minimum_azimuth_std
    )
    good = (
        (rows[:, RANGE] > 0.0)
        & (rows[:, RANGE] <= parameters.maximum_range)
        & np.isfinite(rows[:, AZIMUTH])
        & (np.abs(offset) <= LONGEST_OFFSET)
        & (rows[:, RANGE_STD] <= LARGEST_RANGE_STD)
        & (rows[:, AZIMUTH_STD] <= LARGEST_AZIMUTH_STD)
    )
    if not good.all():
        _count(rows[~good], offset[~good], parameters, health)
        rows = rows[good]
    rows[:, AZIMUTH] = wrap_two_pi(rows[:, AZIMUTH])
    return rows


def _error(told: npt.NDArray[np.floating], default: float, smallest: float) -> FloatArray:
    return np.maximum(np.where(told > 0.0, told, default), smallest)


def _count(
    rows: FloatArray, offset: FloatArray, parameters: TrackerParameters, health: Health
) -> None:
    finite = np.isfinite(rows[:, [TIME, RANGE, AZIMUTH]]).all(axis=1)
    counted = np.zeros(len(rows), bool)
    for reason, bad in (
        ("plots that are not finite", ~finite),
        ("plots at no positive range", rows[:, RANGE] <= 0.0),
        ("plots beyond the maximum range", rows[:, RANGE] > parameters.maximum_range),
        ("plots far from their message's time", np.abs(offset) > LONGEST_OFFSET),
        ("plots with huge errors", np.ones(len(rows), bool)),
    ):
        health.drop(reason, int(np.count_nonzero(bad & ~counted)))
        counted |= bad
