# SPDX-License-Identifier: Apache-2.0
"""What is known of a track when its second plot opens it."""

from __future__ import annotations

from typing import Any

import numpy as np

from radar_common.tables import TrackStatus
from secondary_proc.motion import two_point_state
from secondary_proc.plots import AZIMUTH, RANGE, Plots
from secondary_proc.track_store import Columns


def opened_tracks(
    first: Plots, second: Plots, noise_density: float, memory: np.dtype[Any]
) -> Columns:
    """Make the columns of new tracks, as far as they follow from their two plots.

    Args:
        first: earlier plots, n of them.
        second: later plots, n of them.
        noise_density: power spectral density of the acceleration per axis, m^2/s^3.
        memory: dtype of what the smoother keeps of a track.

    Returns:
        Tentative tracks without id and score, not yet scheduled.
    """
    tracks = Columns.zeros(len(first), memory)
    tracks.state[:], tracks.covariance[:] = two_point_state(
        first.position,
        first.covariance,
        second.position,
        second.covariance,
        second.time - first.time,
        noise_density,
    )
    tracks.passed[:], tracks.born[:] = second.time, first.time
    tracks.schedule[:] = np.inf
    tracks.plot[:] = second.values[RANGE : AZIMUTH + 1]
    tracks.status[:], tracks.hits[:] = TrackStatus.TENTATIVE, 2
    return tracks
