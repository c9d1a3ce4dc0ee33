# SPDX-License-Identifier: Apache-2.0
"""What a second pass over the stored signal may ask for."""

from __future__ import annotations

from typing import Protocol

import numpy as np
import numpy.typing as npt


class Envelopes(Protocol):
    """The stored pulses of all range rings, normalised."""

    def around(
        self, ring: npt.NDArray[np.integer], pulse: npt.NDArray[np.integer], reach: int
    ) -> npt.NDArray[np.float64]:
        """Give the pulses around a place.

        Args:
            ring: range cells, shape (n,).
            pulse: number of the pulse in the middle, shape (n,).
            reach: pulses to either side.

        Returns:
            Envelope in units of the noise's sigma, such that noise is Rayleigh, shape (n, 2 reach + 1); zero where the
            pulse is not stored.
        """
