# SPDX-License-Identifier: Apache-2.0
"""The smallest gate that holds a plot: narrow for straight flight, medium for a manoeuvre, wide after misses.

Source: Kuzmin 1967, § 4.7.2. The book chooses the size by what the last scan showed, because its gates open the
receiver; gates that are only calculated can be tried from the smallest on in the same scan. All are ellipses of the
same number of standard deviations: the narrow one of the prediction in quiet flight, the others of one in which the
target may have manoeuvred since its last plot, which after misses is long ago.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from secondary_proc.association.interface import FloatArray, IndexArray
from secondary_proc.motion import normalised_square


@dataclass(frozen=True, slots=True)
class Narrowed:
    """Pairs of track and plot after the narrow gates were tried, shapes (n,).

    Attributes:
        kept: pairs that are left.
        narrow: pairs in a narrow gate, all of them kept.
        distance_squared: normalised by the covariance of quiet flight.
        determinant: of that covariance, m^4.
    """

    kept: npt.NDArray[np.bool_]
    narrow: npt.NDArray[np.bool_]
    distance_squared: FloatArray
    determinant: FloatArray


def narrowed(
    track: IndexArray,
    straight: npt.NDArray[np.bool_],
    difference: FloatArray,
    quiet: FloatArray,
    sigmas: float,
) -> Narrowed:
    """Leave out plots outside the narrow gate of a track that has one inside.

    Args:
        track: of each pair in a medium or wide gate, shape (n,).
        straight: whether the track may have a narrow gate, being confirmed and seen in the last scan, shape (n,).
        difference: of the plot from the prediction, metres, shape (n, 2).
        quiet: covariance of the difference in quiet flight, m^2, shape (n, 2, 2).
        sigmas: half axis of all gates in standard deviations.

    Returns:
        What is left.
    """
    distance_squared, determinant = normalised_square(difference, quiet)
    narrow = straight & (distance_squared <= sigmas**2)
    served = np.zeros(int(track.max(initial=-1)) + 1, bool)
    served[track[narrow]] = True
    return Narrowed(narrow | ~served[track], narrow, distance_squared, determinant)
