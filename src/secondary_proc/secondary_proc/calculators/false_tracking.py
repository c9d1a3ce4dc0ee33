# SPDX-License-Identifier: Apache-2.0
"""False tracks under tracking, which live until k gates in a row stay empty.

Source: Kuzmin 1967, § 4.3.4, (4.26)-(4.28), figure 4.3.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from secondary_proc.calculators.rule_chain import FloatArray


def false_tracks_kept(empty: npt.ArrayLike, drop_misses: int) -> FloatArray:
    """Steady number of false tracks, which is also a false track's mean life in scans.

    Source: (4.28).

    Args:
        empty: q_c, that a tracking gate holds no false plot, in (0, 1], any shape.
        drop_misses: misses in a row that end a track, k.

    Returns:
        Tracks per false track handed over in a scan, sum of q_c^-i for i = 1 to k, same shape.
    """
    q = np.asarray(empty, dtype=float)
    return np.asarray(np.sum([q**-i for i in range(1, drop_misses + 1)], axis=0))


def tracks_by_misses(empty: float, drop_misses: int) -> FloatArray:
    """Steady number of false tracks that have just missed i times in a row.

    Source: (4.26), (4.27); for i = 0 the tracks found in their last scan, without those just handed over.

    Args:
        empty: q_c, in (0, 1].
        drop_misses: k.

    Returns:
        Tracks per false track handed over in a scan, for i = 0 to k, shape (k + 1,); the last are those dropped.
    """
    seen = empty**-drop_misses
    tracks = seen * empty ** np.arange(drop_misses + 1)
    tracks[0] = seen - 1.0
    return np.asarray(tracks)


def survival(empty: float, drop_misses: int, scans: int) -> FloatArray:
    """Probability that a false track still lives.

    Args:
        empty: q_c, in [0, 1].
        drop_misses: k.
        scans: number of scans looked at.

    Returns:
        Probability 0, 1, ... scans - 1 scans after it was handed over, shape (scans,).
    """
    run = np.zeros(drop_misses)
    run[0] = 1.0
    alive = np.empty(scans)
    for scan in range(scans):
        alive[scan] = run.sum()
        run = np.append((1.0 - empty) * alive[scan], empty * run[:-1])
    return alive


def tracking_build_up(handed_over: FloatArray, empty: float, drop_misses: int) -> FloatArray:
    """Number of false tracks from the first scan on.

    Args:
        handed_over: false tracks handed over in each scan, shape (scans,).
        empty: q_c, in [0, 1].
        drop_misses: k.

    Returns:
        False tracks under tracking after each scan, those just handed over included, shape (scans,).
    """
    scans = len(handed_over)
    return np.convolve(handed_over, survival(empty, drop_misses, scans))[:scans]
