# SPDX-License-Identifier: Apache-2.0
"""Antenna patterns by name: two-way amplitude against the angle off the beam's axis.

The argument is alpha, the angle over the half width phi that (1.27) counts pulses in. Each pattern places phi at a
level of its own (1/e of one-way power for the Gaussian, the first null for the sinc forms, the edge for the
rectangle), so a half-power width, which data sheets give, is what makes different patterns comparable.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Pattern:
    """One antenna pattern, of transmission and reception together.

    Attributes:
        amplitude: two-way amplitude g(alpha), which is the one-way power; g(0) = 1.
        half_power: alpha at which one-way power, hence g, has fallen to one half.
        extent: largest |alpha| at which a target is illuminated; side lobes are left out.
    """

    amplitude: Callable[[FloatArray], FloatArray]
    half_power: float
    extent: float

    def __call__(self, alpha: npt.ArrayLike) -> FloatArray:
        """Evaluate the pattern.

        Args:
            alpha: angle off the axis over the half width phi, any shape.

        Returns:
            Two-way amplitude, same shape; zero beyond `extent`.
        """
        angle = np.asarray(alpha, dtype=float)
        return np.where(np.abs(angle) <= self.extent, self.amplitude(angle), 0.0)


def _gaussian(alpha: FloatArray) -> FloatArray:
    return np.exp(-np.square(alpha))


def _sinc(alpha: FloatArray) -> FloatArray:
    return np.sinc(alpha)


def _sinc2(alpha: FloatArray) -> FloatArray:
    return np.square(np.sinc(alpha))


# At alpha = 3 a Gaussian burst is 78 dB below its peak in power, under the noise of any target within max_snr_db.
PATTERNS = {
    "gaussian": Pattern(_gaussian, math.sqrt(math.log(2.0)), 3.0),
    "sinc": Pattern(_sinc, 0.6033545644016142, 1.0),
    "sinc2": Pattern(_sinc2, 0.4429464706894524, 1.0),
    "rectangular": Pattern(np.ones_like, 1.0, 1.0),
}
"""Kuzmin 1967, § 1.4.3 and (3.28), and the alternatives of § 3.2, by the name that a scenario uses."""
