# SPDX-License-Identifier: Apache-2.0
"""Rows of `radar/tracks` from the memory of the tracks."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from radar_common.frames import polar_from_enu
from radar_common.tables import TRACK
from secondary_proc.motion import FloatArray, predict_covariance, predict_state
from secondary_proc.plots import Plots
from secondary_proc.track_store import TrackStore


def rows(
    store: TrackStore,
    tracks: npt.NDArray[np.intp],
    *,
    at: FloatArray | None = None,
    noise_density: float = 0.0,
) -> npt.NDArray[np.void]:
    """Write tracks as rows of the table.

    Args:
        store: all tracks.
        tracks: indices, shape (n,).
        at: seconds to predict them to, shape (n,), for tracks without a plot; None for those that have just got one.
        noise_density: power spectral density of the acceleration for that prediction, m^2/s^3.

    Returns:
        Rows of dtype TRACK, shape (n,), in the radar's frame; `time_offset` still holds the tracker's time.
    """
    out = np.zeros(len(tracks), TRACK)
    state, covariance, time = (store[name][tracks] for name in ("state", "covariance", "time"))
    out["plot_range"] = out["plot_azimuth"] = np.nan
    if at is None:
        out["plot_range"] = store["plot_range"][tracks]
        out["plot_azimuth"] = store["plot_azimuth"][tracks]
    else:
        covariance = predict_covariance(covariance, at - time, noise_density)
        state, time = predict_state(state, at - time), at
    for column, name in enumerate(("x", "y", "vx", "vy")):
        out[name] = state[:, column]
    out["speed"], out["course"] = polar_from_enu(state[:, 2], state[:, 3])
    out["covariance"] = covariance.reshape(-1, 16)
    out["time_offset"] = time
    out["age"] = time - store["born"][tracks]
    for name in ("id", "status", "hits", "misses", "score"):
        out[name] = store[name][tracks]
    return out


def first_rows(second: npt.NDArray[np.void], first: Plots) -> npt.NDArray[np.void]:
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
