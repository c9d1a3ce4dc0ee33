# SPDX-License-Identifier: Apache-2.0
"""Which true source an angle belongs to: by its identity over its whole life, or by what lies nearest."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from radar_common.frames import wrap_pi
from radar_eval.bag_tables import TimedRows
from radar_eval.labelling import FALSE
from radar_eval.truth_paths import TruthPaths

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int64]

GATE = float(np.radians(10.0))
"""Farthest that an angle of a source may lie from it: three times the error of a radar under jamming."""


def errors_from(paths: TruthPaths, target: int, measured: TimedRows) -> FloatArray:
    """Compare azimuths with those of one source.

    Args:
        paths: of the sources.
        target: index of the source.
        measured: rows with an azimuth, shape (n,).

    Returns:
        Measured minus true, radians; NaN while the source is not there, shape (n,).
    """
    present, _, azimuth = paths.polar_at(np.full(len(measured), target), measured.time)
    return np.where(present, wrap_pi(measured.rows["azimuth"] - azimuth), np.nan)


def label_nearest(measured: TimedRows, paths: TruthPaths) -> tuple[IntArray, FloatArray]:
    """Give each row the source that lies nearest in azimuth.

    Args:
        measured: rows with an azimuth, shape (n,).
        paths: of the sources.

    Returns:
        (target, error): index of the source, FALSE without one in the gate; radians, NaN without one; shape (n,) each.
    """
    target, error = np.full(len(measured), FALSE), np.full(len(measured), np.nan)
    smallest = np.full(len(measured), GATE)
    for candidate in range(len(paths)):
        apart = errors_from(paths, candidate, measured)
        nearer = np.abs(apart) < smallest
        target[nearer], error[nearer] = candidate, apart[nearer]
        smallest[nearer] = np.abs(apart[nearer])
    return target, error


def label_identities(measured: TimedRows, paths: TruthPaths) -> tuple[IntArray, FloatArray]:
    """Give each identity the source to which it has been nearest, by the median over its rows.

    Args:
        measured: rows with an id and an azimuth, shape (n,).
        paths: of the sources.

    Returns:
        (target, error): index of the source of the row's identity, FALSE for one that has kept to none; radians, NaN
        where the source is not there; shape (n,) each.
    """
    ids, own = np.unique(measured.rows["id"], return_inverse=True)
    count = np.bincount(own, minlength=len(ids))
    middle = np.cumsum(count) - count + count // 2
    label, smallest = np.full(len(ids), FALSE), np.full(len(ids), GATE)
    for candidate in range(len(paths)):
        # Where the source is absent, the identity cannot be its.
        apart = np.nan_to_num(np.abs(errors_from(paths, candidate, measured)), nan=np.inf)
        median = apart[np.lexsort((apart, own))][middle] if len(ids) else smallest
        label = np.where(median < smallest, candidate, label)
        smallest = np.minimum(median, smallest)
    target, error = label[own], np.full(len(measured), np.nan)
    for candidate in np.unique(label[label != FALSE]):
        mine = target == candidate
        error[mine] = errors_from(paths, int(candidate), measured)[mine]
    return target, error
