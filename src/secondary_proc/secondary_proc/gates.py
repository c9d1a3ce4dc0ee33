# SPDX-License-Identifier: Apache-2.0
"""Gates from the predicted error, as a sparse graph of tracks and plots.

Source: Kuzmin 1967, (4.137)-(4.144), with the ellipse instead of the rectangle.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from radar_common.tables import TrackStatus
from secondary_proc.gating.three_sizes import narrowed
from secondary_proc.motion import (
    normalised_square,
    predict_position_covariance,
    trace,
)
from secondary_proc.neighbours import neighbour_pairs
from secondary_proc.plots import Plots
from secondary_proc.track_store import TrackStore

FloatArray = npt.NDArray[np.float64]
IndexArray = npt.NDArray[np.intp]

_MOST_NEIGHBOURS = 4_000_000
_FEW_PAIRS = 256
CONFIRMED = int(TrackStatus.CONFIRMED)


@dataclass(frozen=True, slots=True)
class Gated:
    """Plots in gates, one row a pair.

    Attributes:
        track: index into the store, shape (n,).
        plot: index into the plots, shape (n,).
        distance_squared: normalised by the covariance of the predicted difference, shape (n,).
        determinant: of that covariance, m^4, shape (n,).
        skipped: tracks that were not looked at because there were too many neighbours.
    """

    track: IndexArray
    plot: IndexArray
    distance_squared: FloatArray
    determinant: FloatArray
    skipped: int


def gate(
    store: TrackStore,
    tracks: IndexArray,
    plots: Plots,
    *,
    sigmas: float,
    noise_density: float,
    shortest: float,
    narrow: float | None = None,
) -> Gated:
    """Find the plots in each track's gate, every plot at its own time.

    Args:
        store: all tracks.
        tracks: indices of those that the beam may find, shape (n,).
        plots: of one slice of time, not empty, in order of time.
        sigmas: half axis of the gate in standard deviations.
        noise_density: power spectral density of the acceleration that the gate stays open for, m^2/s^3.
        shortest: seconds that must lie between two plots of a track.
        narrow: noise density of quiet flight, for gates of which the smallest with a plot counts; None for one size.

    Returns:
        Pairs of track and plot.
    """
    if not len(tracks):
        return Gated(tracks, tracks, np.zeros(0), np.zeros(0), 0)
    row, plot, skipped = _near_pairs(store, tracks, plots, sigmas, noise_density)
    track = tracks[row]
    seconds = plots.time[plot] - store["time"][track]
    apart = seconds >= shortest
    if not apart.all():
        track, plot, seconds = track[apart], plot[apart], seconds[apart]
    state = store["state"][track]
    difference = plots.position[plot] - state[:, :2] - state[:, 2:] * seconds[:, None]
    expected = predict_position_covariance(store["covariance"][track], seconds, noise_density)
    expected += plots.covariance[plot]
    distance_squared, determinant = normalised_square(difference, expected)
    inside = (distance_squared <= sigmas**2).nonzero()[0]
    if narrow is not None:
        track, plot, difference = track[inside], plot[inside], difference[inside]
        distance_squared, determinant = distance_squared[inside], determinant[inside]
        quiet = predict_position_covariance(store["covariance"][track], seconds[inside], narrow)
        quiet += plots.covariance[plot]
        straight = (store["status"][track] == CONFIRMED) & (store["misses"][track] == 0)
        tried = narrowed(track, straight, difference, quiet, sigmas)
        distance_squared[tried.narrow] = tried.distance_squared[tried.narrow]
        determinant[tried.narrow] = tried.determinant[tried.narrow]
        inside = tried.kept.nonzero()[0]
    return Gated(
        track[inside], plot[inside], distance_squared[inside], determinant[inside], skipped
    )


def _near_pairs(
    store: TrackStore, tracks: IndexArray, plots: Plots, sigmas: float, noise_density: float
) -> tuple[IndexArray, IndexArray, int]:
    total = len(tracks) * len(plots)
    if total <= _FEW_PAIRS:
        # To look for neighbours would cost more than to try them all.
        row, plot = np.divmod(np.arange(total), len(plots))
        return row, plot, 0
    begin, end = plots.time[0], plots.time[-1]
    state, covariance = store["state"][tracks], store["covariance"][tracks]
    seconds = 0.5 * (begin + end) - store["time"][tracks]
    centre = state[:, :2] + state[:, 2:] * seconds[:, None]
    spread = trace(predict_position_covariance(covariance, seconds, noise_density))
    spread += trace(plots.covariance).max()
    travel = np.hypot(state[:, 2], state[:, 3]) * 0.5 * (end - begin)
    # The predicted error grows over half a slice; a tenth covers it, as slices are short against the period.
    radius = float((1.1 * sigmas * np.sqrt(spread) + travel).max(initial=0.0))
    return neighbour_pairs(centre, plots.position, radius, _MOST_NEIGHBOURS)
