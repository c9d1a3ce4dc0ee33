# SPDX-License-Identifier: Apache-2.0
"""The line of sight from the observer to an emitter: the paper's setting action h and its gradient.

The printed formula beta = arctan(Z/X) + pi/2 [2 - sgn x - sgn x sgn z] has two misprints: its signs are of the absolute
coordinates, and the first one is of the wrong axis. With relative coordinates and sgn Z first it is right off the axes;
the arctangent of two arguments is right everywhere.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from radar_common.frames import polar_from_enu

FloatArray = npt.NDArray[np.float64]

NEAREST = 1.0
"""No emitter is taken to be nearer than this, metres; a direction needs a distance."""


class Sight(NamedTuple):
    """Line of sight.

    Attributes:
        range: metres, at least `NEAREST`, shape (...).
        along: unit vector towards the emitter, shape (..., 2).
    """

    range: FloatArray
    along: FloatArray

    @property
    def azimuth(self) -> FloatArray:
        """Radians clockwise from north in [0, 2 pi), shape (...)."""
        return polar_from_enu(self.along[..., 0], self.along[..., 1])[1]

    @property
    def across(self) -> FloatArray:
        """Unit vector of growing azimuth, shape (..., 2)."""
        return self.along[..., ::-1] * (1.0, -1.0)

    @property
    def gradient(self) -> FloatArray:
        """Of the azimuth by x and y of the emitter, rad/m, shape (..., 2)."""
        return self.across / self.range[..., np.newaxis]


def sight(relative: FloatArray) -> Sight:
    """See an emitter from the observer.

    Args:
        relative: position less that of the observer, metres east and north, shape (..., 2).

    Returns:
        Its line of sight.
    """
    distance = np.maximum(np.hypot(relative[..., 0], relative[..., 1]), NEAREST)
    return Sight(distance, relative / distance[..., np.newaxis])
