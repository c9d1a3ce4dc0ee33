# SPDX-License-Identifier: Apache-2.0
"""Rows of `radar/tracks` from the memory of the tracks."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from radar_common.frames import polar_from_enu
from radar_common.tables import TRACK
from secondary_proc.motion import FloatArray, predict_covariance, predict_state
from secondary_proc.plots import Plots
from secondary_proc.track_store import Columns

Rows = npt.NDArray[np.void]


_ROUNDING = 1e-6
_PACKED = np.dtype(
    [
        ("kinematic", "<f4", (21,)),  # x, y, z, vx, vy, covariance
        ("id", "<u4"),
        ("status", "u1"),
        ("end_reason", "u1"),
        ("time", "<f8"),
        ("velocity", "<f4", (2,)),  # speed, course
        ("plot", "<f8", (2,)),  # range, azimuth
        ("passages", "<u4", (2,)),  # hits, misses
        ("age", "<f4"),
        ("score", "<f4"),
    ]
)
"""The bytes of TRACK with neighbours of one kind joined, because every field written costs a call of its own."""
if _PACKED.itemsize != TRACK.itemsize:
    raise AssertionError("the packed row of a track must have the layout of TRACK")


def rows(tracks: Columns, *, at: FloatArray | None = None, noise_density: float = 0.0) -> Rows:
    """Write tracks as rows of the table.

    Args:
        tracks: n of them.
        at: seconds to predict them to, shape (n,), for tracks without a plot; None for those that have just got one.
        noise_density: power spectral density of the acceleration for that prediction, m^2/s^3.

    Returns:
        Rows of dtype TRACK, shape (n,), in the radar's frame; `time_offset` still holds the tracker's time.
    """
    out = np.zeros(len(tracks), _PACKED)
    state, covariance, time = tracks.state, tracks.covariance, tracks.time
    if at is None:
        out["plot"] = tracks.plot.T
    else:
        out["plot"] = np.nan
        covariance = predict_covariance(covariance, at - time, noise_density)
        state, time = predict_state(state, at - time), at
    kinematic, velocity = out["kinematic"], out["velocity"]
    kinematic[:, :2], kinematic[:, 3:5] = state[:, :2], state[:, 2:]
    kinematic[:, 5:] = covariance.reshape(-1, 16)
    velocity[:, 0], velocity[:, 1] = polar_from_enu(state[:, 2], state[:, 3])
    out["passages"] = tracks.passages.T
    out["time"] = time
    out["age"] = time - tracks.born
    out["id"], out["status"], out["score"] = tracks.id, tracks.status, tracks.score
    out["end_reason"] = tracks.reason
    return out.view(TRACK)


def first_rows(second: Rows, first: Plots) -> Rows:
    """Write the first plot of tracks that their second plot has just opened.

    Args:
        second: rows of the tracks at their second plot, shape (n,).
        first: their first plots, n of them.

    Returns:
        Rows of dtype TRACK, shape (n,), as `rows` writes them.
    """
    out = second.copy()
    out["x"], out["y"] = first.position[:, 0], first.position[:, 1]
    out["time_offset"], out["plot_range"], out["plot_azimuth"] = (
        first.time,
        first.range,
        first.azimuth,
    )
    seconds = (second["time_offset"] - first.time)[:, None, None]
    covariance = second["covariance"].reshape(-1, 4, 4).copy()
    covariance[:, :2, :2] = first.covariance
    covariance[:, :2, 2:] = covariance[:, 2:, :2] = -first.covariance / seconds
    out["covariance"] = covariance.reshape(-1, 16)
    out["hits"], out["misses"], out["age"], out["score"] = 1, 0, 0.0, 0.0
    return out


def columns(
    rows: Rows, *, origin: float, place: tuple[float, float], period: float, memory: np.dtype[Any]
) -> Columns:
    """Read tracks back from rows, each the last of its track.

    Args:
        rows: dtype TRACK, in the map, shape (n,).
        origin: tracker's time of the rows' stamp, seconds.
        place: of the radar in the map, metres east and north.
        period: of the antenna, seconds.
        memory: dtype of what the smoother keeps, which rows do not tell: it starts anew.

    Returns:
        The tracks, not yet scheduled.
    """
    tracks = Columns.zeros(len(rows), memory)
    tracks.state[:] = np.stack([rows[name] for name in ("x", "y", "vx", "vy")], axis=1)
    tracks.state[:, :2] -= place
    tracks.covariance[:] = rows["covariance"].reshape(-1, 4, 4)
    # Rounded to single precision it might have lost its definiteness.
    tracks.covariance[:, range(4), range(4)] *= 1.0 + _ROUNDING
    tracks.time[:] = origin + rows["time_offset"]
    predicted = np.isnan(rows["plot_range"])
    tracks.crossing[:] = tracks.time + np.where(predicted, 0.0, rows["misses"] * period)
    tracks.schedule[:] = np.inf
    tracks.born[:] = tracks.time - rows["age"]
    tracks.score[:] = tracks.best[:] = np.nan_to_num(rows["score"])
    tracks.plot[:] = polar_from_enu(*tracks.state[:, :2].T)
    tracks.plot[:, ~predicted] = rows["plot_range"][~predicted], rows["plot_azimuth"][~predicted]
    tracks.id[:], tracks.status[:] = rows["id"], rows["status"]
    tracks.passages[:] = rows["hits"], rows["misses"]
    return tracks
