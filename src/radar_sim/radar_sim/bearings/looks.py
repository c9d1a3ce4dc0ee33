# SPDX-License-Identifier: Apache-2.0
"""What one look of a sensor gives: its own rows, and the truth behind them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from radar_common.tables import BEARING, TRUTH, BearingChannel
from radar_sim.bearings.sources import Sight, Sources
from radar_sim.bearings.violations import one_hot

FloatArray = npt.NDArray[np.float64]
BoolArray = npt.NDArray[np.bool_]
Rows = npt.NDArray[np.void]


@dataclass(frozen=True, slots=True)
class Look:
    """One look; `time_offset` of all rows counts from its beginning.

    Attributes:
        begin: s after the start.
        due: s after the start at which its messages leave.
        measured: rows of BEARING or of PLOT, in order of time.
        channels: BEARING rows: what a perfect sensor would have told of the sources that this one can perceive.
        truth: rows of TRUTH.
    """

    begin: float
    due: float
    measured: Rows
    channels: Rows
    truth: Rows


def split(rows: Rows, chosen: BoolArray) -> list[Rows]:
    """Cut the rows of many looks into those of each, in order of time.

    Args:
        rows: with `time_offset`, shape (looks, sources).
        chosen: which of them there are, same shape.

    Returns:
        Rows of each look.
    """
    parts = []
    for row, kept in zip(rows, chosen, strict=True):
        part = row[kept]
        parts.append(part[np.argsort(part["time_offset"], kind="stable")])
    return parts


def channel_rows(
    sight: Sight,
    ids: npt.NDArray[np.intp],
    offset: FloatArray,
    std: FloatArray,
    channel: BearingChannel,
    jammed: BoolArray,
    silent: BoolArray,
) -> Rows:
    """Write what a perfect sensor would have told.

    Args:
        sight: of the sources that it can perceive, shape (looks, sources).
        ids: of the sources.
        offset: time of each bearing from its look's beginning, s, same shape.
        std: standard deviation that the error really has, rad, same shape.
        channel: the sensor.
        jammed: state of the active channel, shape (looks,).
        silent: state of the passive one, shape (looks,).

    Returns:
        Rows of BEARING, shape (looks, sources).
    """
    rows = np.zeros(sight.azimuth.shape, BEARING)
    rows["azimuth"], rows["rate"], rows["elevation"] = sight.azimuth, sight.rate, sight.elevation
    rows["azimuth_std"] = std
    rows["elevation_std"] = rows["rate_std"] = np.nan
    rows["time_offset"] = offset
    rows["id"] = ids
    rows["channel"] = channel
    rows["active_health"] = one_hot(jammed)[:, None]
    rows["passive_health"] = one_hot(silent)[:, None]
    return rows


def truth_rows(sight: Sight, sources: Sources, offset: FloatArray) -> list[Rows]:
    """Write where the sources are that have a place.

    Args:
        sight: of all sources, shape (looks, sources).
        sources: all.
        offset: time of each from its look's beginning, s, same shape.

    Returns:
        Rows of TRUTH of each look; range and azimuth are from the observer.
    """
    rows = np.zeros(sight.azimuth.shape, TRUTH)
    for name in ("x", "y", "z", "vx", "vy", "azimuth"):
        rows[name] = getattr(sight, name)
    rows["range"] = sight.distance
    rows["id"] = sources.ids
    rows["time_offset"] = offset
    rows["snr_db"] = np.nan
    return split(rows, sight.present & np.isfinite(sight.x))
