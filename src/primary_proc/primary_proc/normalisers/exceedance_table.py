# SPDX-License-Identifier: Apache-2.0
"""-ln of the probability that noise exceeds a ratio, looked up: whole pulses need it, and its formulas are long."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import numpy.typing as npt

LARGEST_MULTIPLIER = 1e9

_NODES = 1 << 14


class ExceedanceTable:
    """Linear interpolation over the logarithm of the ratio, good to 2e-4 of the value."""

    def __init__(
        self, log_exceedance: Callable[[npt.ArrayLike], npt.NDArray], scale: float
    ) -> None:
        """Tabulate a law.

        Args:
            log_exceedance: of a multiplier of the noise level.
            scale: multiplier of a ratio of one.
        """
        self._scale = np.float32(scale)
        last = np.log1p(LARGEST_MULTIPLIER)
        self._density = np.float32((_NODES - 1) / last)
        value = -log_exceedance(np.expm1(np.linspace(0.0, last, _NODES)))
        # One node more, level with the last: the largest ratio is found there.
        self._value = np.append(value, value[-1]).astype(np.float32)
        self._slope = np.append(np.diff(self._value), np.float32(0.0))

    def power(self, ratios: npt.NDArray[np.float32]) -> npt.NDArray[np.float32]:
        """Look up.

        Args:
            ratios: any shape; NaN counts as zero, infinity as the largest that is tabulated.

        Returns:
            Same shape.
        """
        place = ratios * self._scale
        # Written so that NaN becomes zero.
        np.fmax(place, np.float32(0.0), out=place)
        np.minimum(place, np.float32(LARGEST_MULTIPLIER), out=place)
        np.log1p(place, out=place)
        place *= self._density
        node = place.astype(np.int32)
        place -= node
        place *= self._slope.take(node)
        place += self._value.take(node)
        return place
