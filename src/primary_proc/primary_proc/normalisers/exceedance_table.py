# SPDX-License-Identifier: Apache-2.0
"""-ln of the probability that noise exceeds a ratio, looked up: whole pulses need it, and its formulas are long."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from primary_proc.calculators.cfar.cfar_laws import LevelLaw

LARGEST_RATIO = 1e9
"""Larger ratios, in units of the mean noise power for each reference cell, are taken for this one."""

_NODES = 1 << 12


class ExceedanceTable:
    """Linear interpolation over the logarithm of the ratio, good to 2e-5 of the value.

    A gamma law would give a straight line over ln(1 + a T), T being the multiplier of the level and a the level's
    variance over its mean; the others are nearly straight, and exactly so for small T.
    """

    def __init__(self, law: LevelLaw, multiplier: float) -> None:
        """Tabulate a law.

        Args:
            law: of the noise level.
            multiplier: of the level, for a ratio of one.
        """
        level, weight = law.quadrature()
        bend = float(np.square(level - law.mean) @ weight / law.mean)
        self._scale = np.float32(multiplier * bend)
        last = np.log1p(LARGEST_RATIO)
        self._density = np.float32((_NODES - 1) / last)
        value = -law.log_exceedance(np.expm1(np.linspace(0.0, last, _NODES)) / bend)
        value[0] = 0.0
        # Two nodes more, level with the last: rounding may put the largest ratio a little past it.
        self._value = np.pad(value, (0, 2), "edge").astype(np.float32)
        self._slope = np.append(np.diff(self._value), np.float32(0.0))

    def power(self, ratios: npt.NDArray[np.float32]) -> npt.NDArray[np.float32]:
        """Look up.

        Args:
            ratios: any shape; NaN counts as zero, infinity as the largest that is tabulated.

        Returns:
            Same shape.
        """
        with np.errstate(invalid="ignore", over="ignore"):
            place = ratios * self._scale
            # Of a number and NaN it takes the number.
            np.fmax(place, np.float32(0.0), out=place)
        np.minimum(place, np.float32(LARGEST_RATIO), out=place)
        np.log1p(place, out=place)
        place *= self._density
        node = place.astype(np.int32)
        place -= node
        place *= self._slope.take(node)
        place += self._value.take(node)
        return place
