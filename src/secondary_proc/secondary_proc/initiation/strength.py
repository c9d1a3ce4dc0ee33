# SPDX-License-Identifier: Apache-2.0
"""How much a plot's strength tells a target's from a false one, learned from the plots themselves.

Two running histograms of the signal-to-noise ratio, of plots that confirmed tracks took and of plots that none took.
Their quotient multiplies the density of false plots at a plot's place, so that it enters gates, scores and association
at once. Source of the term: Lerro and Bar-Shalom 1993, who assume a target's mean strength where it is learned here.
"""

from __future__ import annotations

from math import exp

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]

_LOWEST, _HIGHEST = -20.0, 80.0
_BINS = 100
_MEMORY_SCANS = 100.0
_DOUBT = 100.0
"""Plots that both histograms have in common before any is seen, and keep in common: the quotient starts at one."""
_LIMIT = 30.0
"""No strength counts for more than this many times more or fewer false plots."""
_KERNEL = np.array([1.0, 2.0, 3.0, 2.0, 1.0]) / 9.0


class StrengthRatio:
    """Likelihood of a strength among false plots over that among targets' plots."""

    def __init__(self) -> None:
        """Start without knowledge: every strength tells nothing."""
        self._counts = np.zeros((2, _BINS))

    def observe(self, strength: FloatArray, of_targets: npt.NDArray[np.bool_]) -> None:
        """Count plots.

        Args:
            strength: signal-to-noise ratio, dB, NaN where it is not known, shape (n,).
            of_targets: whether a confirmed track took the plot, shape (n,).
        """
        known = np.isfinite(strength)
        place = _bin(strength[known]) + _BINS * of_targets[known]
        self._counts += np.bincount(place, minlength=2 * _BINS).reshape(2, _BINS)

    def forget(self, scans: float) -> None:
        """Let time pass.

        Args:
            scans: turns of the antenna since the last call.
        """
        self._counts *= exp(-min(scans, 3.0) / _MEMORY_SCANS)

    def ratio(self, strength: FloatArray) -> FloatArray:
        """By how much false plots of this strength are more frequent than targets'.

        Args:
            strength: signal-to-noise ratio, dB, NaN where it is not known, shape (n,).

        Returns:
            Quotient, one where the strength is not known, shape (n,).
        """
        total = self._counts.sum()
        if not total:
            return np.ones(len(strength))
        smooth = np.stack([np.convolve(counts, _KERNEL, "same") for counts in self._counts])
        common = smooth.sum(axis=0) / total
        share = (smooth + _DOUBT * common) / (self._counts.sum(axis=1, keepdims=True) + _DOUBT)
        quotient = np.ones(_BINS)
        np.divide(share[0], share[1], out=quotient, where=share[1] > 0.0)
        known = np.isfinite(strength)
        found = np.ones(len(strength))
        found[known] = np.clip(quotient, 1.0 / _LIMIT, _LIMIT)[_bin(strength[known])]
        return found


def _bin(strength: FloatArray) -> npt.NDArray[np.intp]:
    place = (strength - _LOWEST) * (_BINS / (_HIGHEST - _LOWEST))
    return np.clip(place, 0, _BINS - 1).astype(np.intp)
