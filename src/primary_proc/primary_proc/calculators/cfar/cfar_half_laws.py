# SPDX-License-Identifier: Apache-2.0
"""How the noise level varies that is the greater, or the smaller, of the means of two halves of a window."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.special import gammainc, gammaincc, gammaln

from primary_proc.calculators.cfar.cfar_laws import AverageLevel, EstimatedLevel

FloatArray = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class GreatestLevel(EstimatedLevel):
    """The greater of the means of two halves of n cells (V. G. Hansen, J. H. Sawyers, IEEE Trans. AES 16, 1980).

    P. P. Gandhi and S. A. Kassam, IEEE Trans. AES 24, 1988, give P_fa as 2 (1 + s)^-n less a sum of n terms, s = T / n,
    where nearly all digits cancel for small probabilities. The same without a difference: a half of which exp(-T Z) has
    made the cells smaller, of mean 1 / (1 + s), is still the greater one with the probability that at least n of
    2 n - 1 trials of probability 1 / (2 + s) succeed.

    Attributes:
        half: n.
    """

    half: int

    @property
    def mean(self) -> float:
        """1 + C(2n, n) / 4^n."""
        return 1.0 + _spread(self.half)

    def log_exceedance(self, multiplier: npt.ArrayLike) -> FloatArray:
        """A sum of positive terms; see `LevelLaw.log_exceedance`.

        Args:
            multiplier: T >= 0, any shape.

        Returns:
            Same shape.
        """
        share = np.asarray(multiplier, dtype=float) / self.half
        return np.log(2.0) - self.half * np.log1p(share) + _log_still_greater(share, self.half)

    def density(self, level: npt.ArrayLike) -> FloatArray:
        """That of one half, the other being smaller; see `EstimatedLevel.density`.

        Args:
            level: positive, any shape.

        Returns:
            Same shape.
        """
        total = self.half * np.asarray(level, dtype=float)
        return 2.0 * AverageLevel(self.half).density(level) * gammainc(self.half, total)


@dataclass(frozen=True, slots=True)
class SmallestLevel(EstimatedLevel):
    """The smaller of the means of two halves of n cells (G. V. Trunk, IEEE Trans. AES 14, 1978).

    Computed as the counterpart of `GreatestLevel`.

    Attributes:
        half: n.
    """

    half: int

    @property
    def mean(self) -> float:
        """1 - C(2n, n) / 4^n."""
        return 1.0 - _spread(self.half)

    def log_exceedance(self, multiplier: npt.ArrayLike) -> FloatArray:
        """What the greater half leaves; see `LevelLaw.log_exceedance`.

        Args:
            multiplier: T >= 0, any shape.

        Returns:
            Same shape.
        """
        share = np.asarray(multiplier, dtype=float) / self.half
        still_smaller = np.log1p(-np.exp(_log_still_greater(share, self.half)))
        return np.log(2.0) - self.half * np.log1p(share) + still_smaller

    def density(self, level: npt.ArrayLike) -> FloatArray:
        """That of one half, the other being greater; see `EstimatedLevel.density`.

        Args:
            level: positive, any shape.

        Returns:
            Same shape.
        """
        total = self.half * np.asarray(level, dtype=float)
        return 2.0 * AverageLevel(self.half).density(level) * gammaincc(self.half, total)


def _spread(half: int) -> float:
    """C(2n, n) / 4^n, what the greater of two means is above one."""
    return float(np.exp(gammaln(2 * half + 1) - 2.0 * gammaln(half + 1) - half * np.log(4.0)))


def _log_still_greater(share: FloatArray, half: int) -> FloatArray:
    """Logarithm of the chance of n or more successes in 2 n - 1 trials of probability 1 / (2 + s)."""
    success = np.arange(half, 2 * half)
    failure = 2 * half - 1 - success
    choices = gammaln(2 * half) - gammaln(success + 1) - gammaln(failure + 1)
    # ln p = -ln(2 + s), ln(1 - p) = ln(1 + s) - ln(2 + s)
    kept = np.log1p(share)[..., None]
    term = choices + failure * kept - (2 * half - 1) * np.log(2.0 + share)[..., None]
    greatest = term.max(axis=-1, keepdims=True)
    return np.log(np.exp(term - greatest).sum(axis=-1)) + greatest[..., 0]
