# SPDX-License-Identifier: Apache-2.0
"""Generalised optimal sub-pattern assignment: one distance between sets of targets and of tracks, and its parts.

Source: Rahmathullah, García-Fernández, Svensson, "Generalized optimal sub-pattern assignment metric", Fusion 2017,
definition 1 with alpha = 2 and proposition 1.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.optimize import linear_sum_assignment
from scipy.spatial.distance import cdist


@dataclass(frozen=True, slots=True)
class Gospa:
    """A distance and its parts; the parts add up to `distance ** order`.

    Attributes:
        distance: in the unit of the positions.
        localisation: sum over the assigned pairs.
        missed: of targets without a track.
        false: of tracks without a target.
        assigned: number of pairs.
    """

    distance: float
    localisation: float
    missed: float
    false: float
    assigned: int


def gospa(
    targets: npt.ArrayLike, tracks: npt.ArrayLike, *, cutoff: float, order: float = 2.0
) -> Gospa:
    """Compute the distance between targets and tracks.

    Args:
        targets: positions, shape (n, d).
        tracks: positions, shape (m, d).
        cutoff: distance beyond which a pair is no pair; a missed target or a false track costs half of its power.
        order: exponent p >= 1; larger ones punish large errors more.

    Returns:
        The distance and its parts.

    Raises:
        ValueError: the cutoff is not positive or the order below one.
    """
    if not cutoff > 0.0 or not order >= 1.0:
        raise ValueError(f"cutoff {cutoff} must be positive, order {order} at least one")
    x, y = np.asarray(targets, dtype=float), np.asarray(tracks, dtype=float)
    alone = cutoff**order / 2.0
    if not len(x) or not len(y):
        missed, false = alone * len(x), alone * len(y)
        return Gospa((missed + false) ** (1.0 / order), 0.0, missed, false, 0)
    cost = np.minimum(cdist(x, y), cutoff) ** order
    i, j = linear_sum_assignment(cost)
    pairs = cost[i, j][cost[i, j] < cutoff**order]
    localisation = float(pairs.sum())
    missed, false = alone * (len(x) - len(pairs)), alone * (len(y) - len(pairs))
    return Gospa(
        (localisation + missed + false) ** (1.0 / order), localisation, missed, false, len(pairs)
    )
