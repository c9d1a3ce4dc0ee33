# SPDX-License-Identifier: Apache-2.0
"""Binary quantisation: one bit a cell, packed along range."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from primary_proc.quantisers.quantiser import Quantiser

_WORD = 64
_TILE = 32


class BinaryQuantiser(Quantiser):
    """Compares ratios with a threshold and packs the result."""

    def __init__(self, threshold: npt.ArrayLike) -> None:
        """Set the threshold.

        Args:
            threshold: on the ratio of each cell, shape (cells,).
        """
        # The threshold of several pulses: numpy compares them at once, several times faster than pulse by pulse.
        self._thresholds = np.tile(np.asarray(threshold, np.float32), (_TILE, 1))
        self._bits = np.zeros((0, 0), bool)
        self.ones = 0

    def quantise(self, ratios: npt.NDArray[np.float32]) -> npt.NDArray[np.uint64]:
        """Quantise some pulses.

        Args:
            ratios: float32, shape (pulses, cells); NaN gives a zero.

        Returns:
            Bits as `numpy.packbits` orders them in memory, filled up with zeros, shape (pulses, words of 64 cells).
        """
        pulses, cells = ratios.shape
        if len(self._bits) != pulses:
            self._bits = np.zeros((pulses, -(-cells // _WORD) * _WORD), bool)
        bits = self._bits[:, :cells]
        with np.errstate(invalid="ignore"):
            for first in range(0, pulses, _TILE):
                part = slice(first, first + _TILE)
                np.greater(ratios[part], self._thresholds[: pulses - first], out=bits[part])
        self.ones = int(np.count_nonzero(self._bits))
        return np.packbits(self._bits.reshape(-1)).view(np.uint64).reshape(pulses, -1)


def unpack_cells(
    words: npt.NDArray[np.uint64], cells: npt.NDArray[np.integer]
) -> npt.NDArray[np.uint8]:
    """Take the bits of some range cells out of packed pulses.

    Args:
        words: as `BinaryQuantiser.quantise` packs them, shape (pulses, words).
        cells: range cells wanted, shape (n,).

    Returns:
        Zeros and ones, shape (pulses, n), the pulses of a cell lying together in memory.
    """
    octets = words.view(np.uint8).reshape(len(words), -1).T[cells >> 3]
    octets >>= (7 - (cells & 7)).astype(np.uint8)[:, None]
    octets &= np.uint8(1)
    return octets.T
