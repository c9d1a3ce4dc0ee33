# SPDX-License-Identifier: Apache-2.0
"""Gates from the predicted error, as a sparse graph of tracks and plots.

Source: Kuzmin 1967, (4.137)-(4.144), with the ellipse instead of the rectangle.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from secondary_proc.gating.sharp_turns import usual_first
from secondary_proc.gating.three_sizes import narrowed
from secondary_proc.motion import POSITION_TERMS
from secondary_proc.neighbours import neighbour_pairs
from secondary_proc.plots import TIME, XX, YY, Plots, X, Y
from secondary_proc.track_store import COVARIANCE, STATE, TIME_OF_STATE

FloatArray = npt.NDArray[np.float64]
IndexArray = npt.NDArray[np.intp]

_MOST_NEIGHBOURS = 4_000_000
_FEW_PAIRS = 1024
_ISOTROPIC = np.array([1.0, 0.0, 0.0, 1.0]) / 3.0


@dataclass(slots=True)
class Gated:
    """Plots in gates, one row a pair.

    Attributes:
        track: index of the track, shape (n,).
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
    tracks: FloatArray,
    plots: Plots,
    *,
    sigmas: float,
    noise_density: FloatArray,
    shortest: float,
) -> Gated:
    """Find the plots in each track's gate, every plot at its own time.

    Args:
        tracks: those that the beam may find: the first rows of `Columns.numbers`, up to the time, shape (rows, n).
        plots: of one slice of time, not empty, in order of time.
        sigmas: half axis of the gate in standard deviations.
        noise_density: power spectral density of the acceleration that each track's gate stays open for, m^2/s^3,
            shape (n,).
        shortest: seconds that must lie between two plots of a track.

    Returns:
        Pairs of track and plot; tracks are counted as they stand in `tracks`.
    """
    terms = POSITION_TERMS @ tracks[COVARIANCE]
    if tracks.shape[1] * len(plots) <= _FEW_PAIRS:
        # To look for neighbours would cost more than to try them all.
        distance_squared, determinant, inside = _try(
            tracks[:, :, None],
            terms[:, :, None],
            plots.values[:, None],
            sigmas,
            noise_density[:, None],
            shortest,
        )
        track, plot = inside.nonzero()
        return Gated(track, plot, distance_squared[inside], determinant[inside], 0)
    row, column, skipped = _near_pairs(tracks, terms, plots, sigmas, noise_density)
    distance_squared, determinant, inside = _try(
        tracks.take(row, axis=1),
        terms.take(row, axis=1),
        plots.values.take(column, axis=1),
        sigmas,
        noise_density.take(row),
        shortest,
    )
    kept = inside.nonzero()[0]
    return Gated(row[kept], column[kept], distance_squared[kept], determinant[kept], skipped)


def usual_gates(
    gated: Gated,
    tracks: FloatArray,
    opened_for: FloatArray,
    plots: Plots,
    sigmas: float,
    noise_density: float,
) -> Gated:
    """Let gates of sharp turns count only where no usual gate holds a plot.

    Args:
        gated: what the gates hold; changed.
        tracks: as `gate` took them, shape (rows, n).
        opened_for: noise density of each gate, larger than the usual one in those of sharp turns, m^2/s^3,
            shape (n,).
        plots: as `gate` took them.
        sigmas: half axis of the gates in standard deviations.
        noise_density: power spectral density of the acceleration in a usual manoeuvre, m^2/s^3.

    Returns:
        Pairs that are left, those in usual gates with the distance and the determinant of these.
    """
    wide = (opened_for[gated.track] > noise_density).nonzero()[0]
    if not len(wide):
        return gated
    pairs = tracks.take(gated.track[wide], axis=1)
    terms = POSITION_TERMS @ pairs[COVARIANCE]
    plot = plots.values.take(gated.plot[wide], axis=1)
    _, shift, error = _difference(pairs, terms, plot, noise_density)
    distance_squared, determinant = _normalised(shift, error)
    near = distance_squared <= sigmas**2
    gated.distance_squared[wide[near]] = distance_squared[near]
    gated.determinant[wide[near]] = determinant[near]
    if near.all():
        return gated
    usual = np.ones(len(gated.track), bool)
    usual[wide] = near
    return _kept(gated, usual_first(gated.track, gated.plot, usual))


def _kept(gated: Gated, which: npt.NDArray[np.bool_]) -> Gated:
    kept = which.nonzero()[0]
    return Gated(
        gated.track[kept],
        gated.plot[kept],
        gated.distance_squared[kept],
        gated.determinant[kept],
        gated.skipped,
    )


def narrow_gates(
    gated: Gated,
    tracks: FloatArray,
    straight: npt.NDArray[np.bool_],
    plots: Plots,
    sigmas: float,
    noise_density: float,
) -> Gated:
    """Let the smallest gate with a plot count.

    Args:
        gated: what the wide gates hold.
        tracks: as `gate` took them, shape (rows, n).
        straight: whether a track may have a narrow gate, shape (n,).
        plots: as `gate` took them.
        sigmas: half axis of the gates in standard deviations.
        noise_density: power spectral density of the acceleration in quiet flight, m^2/s^3.

    Returns:
        Pairs that are left, those in narrow gates with the distance and the determinant of quiet flight.
    """
    pairs = tracks.take(gated.track, axis=1)
    terms = POSITION_TERMS @ pairs[COVARIANCE]
    _, shift, error = _difference(
        pairs, terms, plots.values.take(gated.plot, axis=1), noise_density
    )
    tried = narrowed(gated.track, straight[gated.track], shift.T, error.T.reshape(-1, 2, 2), sigmas)
    gated.distance_squared[tried.narrow] = tried.distance_squared[tried.narrow]
    gated.determinant[tried.narrow] = tried.determinant[tried.narrow]
    return _kept(gated, tried.kept)


def _try(
    tracks: FloatArray,
    terms: FloatArray,
    plots: FloatArray,
    sigmas: float,
    noise_density: FloatArray,
    shortest: float,
) -> tuple[FloatArray, FloatArray, npt.NDArray[np.bool_]]:
    seconds, shift, error = _difference(tracks, terms, plots, noise_density)
    distance_squared, determinant = _normalised(shift, error)
    inside = distance_squared <= sigmas**2
    inside &= seconds >= shortest
    return distance_squared, determinant, inside


def _normalised(shift: FloatArray, error: FloatArray) -> tuple[FloatArray, FloatArray]:
    xx, xy, _, yy = error
    determinant = xx * yy - xy * xy
    # The adjugate times the shift, both components at once: (x yy - y xy, y xx - x xy).
    turned = shift * error[::-3] - shift[::-1] * xy
    turned *= shift
    return (turned[0] + turned[1]) / determinant, determinant


def _difference(
    tracks: FloatArray, terms: FloatArray, plots: FloatArray, noise_density: FloatArray | float
) -> tuple[FloatArray, FloatArray, FloatArray]:
    seconds: FloatArray = plots[TIME] - tracks[TIME_OF_STATE]
    shift: FloatArray = plots[X : Y + 1] - tracks[STATE][:2] - tracks[STATE][2:] * seconds
    error = _predicted(terms, seconds, noise_density)
    error += plots[XX : YY + 1]
    return seconds, shift, error


def _predicted(
    terms: FloatArray, seconds: FloatArray, noise_density: FloatArray | float
) -> FloatArray:
    # In Horner's form, the spread by white acceleration as the cubic term.
    isotropic = _ISOTROPIC.reshape(4, *(1,) * seconds.ndim)
    predicted: FloatArray = isotropic * (noise_density * seconds)
    predicted += terms[8:]
    predicted *= seconds
    predicted += terms[4:8]
    predicted *= seconds
    predicted += terms[:4]
    return predicted


def _near_pairs(
    tracks: FloatArray, terms: FloatArray, plots: Plots, sigmas: float, noise_density: FloatArray
) -> tuple[IndexArray, IndexArray, int]:
    begin, end = plots.time[0], plots.time[-1]
    velocity = tracks[STATE][2:]
    seconds = 0.5 * (begin + end) - tracks[TIME_OF_STATE]
    centre = tracks[STATE][:2] + velocity * seconds
    xx, _, _, yy = _predicted(terms, seconds, noise_density)
    spread = xx + yy + (plots.values[XX] + plots.values[YY]).max()
    travel = np.hypot(velocity[0], velocity[1]) * 0.5 * (end - begin)
    # The predicted error grows over half a slice; a tenth covers it, as slices are short against the period.
    radius = float((1.1 * sigmas * np.sqrt(spread) + travel).max(initial=0.0))
    return neighbour_pairs(centre.T, plots.position, radius, _MOST_NEIGHBOURS)
