# SPDX-License-Identifier: Apache-2.0
"""Primary-radar positions of combined target reports, freed of their constant offset from the secondary radar.

A combined report gives the secondary position and, in item I048/130, how far the primary one lies from it. Their mean
over a recording is how the two radars are set up against each other, not an error of a measurement, so it is removed.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy import stats

from radar_common.frames import wrap_two_pi
from radar_eval.asterix_records import NAUTICAL_MILE

FloatArray = npt.NDArray[np.float64]

_TRIM = 0.05
_RANGE_UNIT = NAUTICAL_MILE / 256
_AZIMUTH_UNIT = 2.0 * np.pi / 2**14


@dataclass(frozen=True, slots=True)
class PrimaryOffset:
    """How primary positions differ from secondary ones.

    Attributes:
        range_bias: m, mean of primary minus secondary.
        azimuth_bias: rad.
        range_std: m, scatter from report to report of one aircraft, one standard deviation.
        azimuth_std: rad.
    """

    range_bias: float
    azimuth_bias: float
    range_std: float
    azimuth_std: float


def has_primary(reports: npt.NDArray[np.void]) -> npt.NDArray[np.bool_]:
    """Tell which reports hold a primary position and an address to label it with.

    Args:
        reports: of dtype REPORT, shape (n,).

    Returns:
        Boolean array, shape (n,).
    """
    both = np.isfinite(reports["range_difference"]) & np.isfinite(reports["azimuth_difference"])
    return both & (reports["address"] != 0)


def estimate_offset(reports: npt.NDArray[np.void]) -> PrimaryOffset:
    """Estimate offset and scatter in a way that outliers do not move.

    The scatter is taken from successive reports of one aircraft (mean square successive difference, von Neumann 1941),
    for the delay of each transponder shifts its secondary ranges by up to 75 m: an error of the truth, not of the plot.

    Args:
        reports: with primary positions, shape (n,), n >= 1; any order.

    Returns:
        Mean without the outermost 5 % on either side; deviation from the median absolute successive difference, never
        below what rounding to the item's unit causes.
    """
    by_aircraft = reports[np.lexsort((reports["time"], reports["address"]))]
    same = by_aircraft["address"][1:] == by_aircraft["address"][:-1]
    return PrimaryOffset(
        float(stats.trim_mean(reports["range_difference"], _TRIM)),
        float(stats.trim_mean(reports["azimuth_difference"], _TRIM)),
        _scatter(by_aircraft["range_difference"], same, _RANGE_UNIT),
        _scatter(by_aircraft["azimuth_difference"], same, _AZIMUTH_UNIT),
    )


def _scatter(differences: FloatArray, same: npt.NDArray[np.bool_], unit: float) -> float:
    successive = np.diff(differences)[same] / np.sqrt(2.0)
    spread = stats.median_abs_deviation(successive, scale="normal") if len(successive) else 0.0
    return float(max(spread, unit / np.sqrt(12.0)))


def primary_positions(
    reports: npt.NDArray[np.void], offset: PrimaryOffset
) -> tuple[FloatArray, FloatArray]:
    """Measured positions of the primary radar with the offset removed.

    Args:
        reports: with primary positions, shape (n,).
        offset: to remove.

    Returns:
        (range, azimuth): metres and radians clockwise from north in [0, 2 pi), each shape (n,).
    """
    return (
        reports["range"] + reports["range_difference"] - offset.range_bias,
        wrap_two_pi(reports["azimuth"] + reports["azimuth_difference"] - offset.azimuth_bias),
    )
