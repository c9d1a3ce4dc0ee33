# SPDX-License-Identifier: Apache-2.0
"""Random phases, and with them complex noise, for every range cell: numpy's ways to draw them are the bottleneck.

A phase is one of 4096 directions. The mean of any trigonometric polynomial up to degree 4095 over them is that over
all directions, so no moment that a test of finite length sees is changed. Four phases come out of one 64 bit number.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

_BITS = 12
_DIRECTIONS = np.exp(2j * np.pi * (np.arange(2**_BITS) + 0.5) / 2**_BITS).astype(np.complex64)
_COSINES = _DIRECTIONS.real.copy()
_PHASES_IN_A_NUMBER = 4


def random_cosines(pulses: int, cells: int, rng: np.random.Generator) -> npt.NDArray[np.float32]:
    """Draw cosines of uniform phases.

    Args:
        pulses: rows; the same generator gives the same rows however many are asked for at a time.
        cells: columns.
        rng: source of randomness.

    Returns:
        Shape (pulses, cells).
    """
    return np.take(_COSINES, _phases(pulses, cells, rng), mode="clip")


class ComplexNoise:
    """Complex numbers with two independent normal quadratures of variance one."""

    def __init__(self, rng: np.random.Generator) -> None:
        """Split the source: a stream for radii and one for phases, so that rows may be drawn in any number.

        Args:
            rng: source of randomness.
        """
        self._radius_rng, self._phase_rng = rng.spawn(2)

    def draw(self, pulses: int, cells: int) -> npt.NDArray[np.complex64]:
        """Draw the next rows.

        Args:
            pulses: rows; the same rows come however many are asked for at a time.
            cells: columns.

        Returns:
            Shape (pulses, cells).
        """
        radius = self._radius_rng.standard_exponential((pulses, cells), dtype=np.float32)
        radius *= np.float32(2.0)
        np.sqrt(radius, out=radius)
        noise = np.take(_DIRECTIONS, _phases(pulses, cells, self._phase_rng), mode="clip")
        noise *= radius
        return noise


def _phases(pulses: int, cells: int, rng: np.random.Generator) -> npt.NDArray[np.intp]:
    numbers = -(-cells // _PHASES_IN_A_NUMBER)
    # Whole numbers for each pulse: none of their bits is left over where a call ends.
    raw = rng.bit_generator.random_raw(pulses * numbers)
    parts = np.asarray(raw, dtype="<u8").view("<u2").reshape(pulses, -1)[:, :cells]
    return (parts >> np.uint16(16 - _BITS)).astype(np.intp)
