# SPDX-License-Identifier: Apache-2.0
"""Normalisation to a noise level that is known beforehand."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from primary_proc.normalisers.normaliser import FloatArray, Normaliser, square_finite


class FixedLevel(Normaliser):
    """Power of a cell over a constant noise power; p_N = exp(-T)."""

    def __init__(self, cells: int, level: float) -> None:
        """Bind to a number of cells.

        Args:
            cells: range cells of a pulse.
            level: rms of the noise envelope in units of the video.
        """
        self._factor = np.float32(1.0 / level**2)
        self.noise_scale = np.ones(cells)

    def ratios(self, video: npt.NDArray, azimuth: FloatArray, out: npt.NDArray[np.float32]) -> int:
        """Normalise some pulses; see `Normaliser.ratios`.

        Args:
            video: shape (pulses, cells).
            azimuth: not used.
            out: float32, shape (pulses, cells).

        Returns:
            How many samples were not finite.
        """
        with np.errstate(over="ignore", invalid="ignore"):
            bad = square_finite(video, out)
        np.multiply(out, self._factor, out=out)
        return bad

    def threshold(self, probability: float) -> FloatArray:
        """Threshold on the ratio; see `Normaliser.threshold`.

        Args:
            probability: p_N.

        Returns:
            Shape (cells,).
        """
        return np.full(self.noise_scale.shape, -np.log(probability))

    def exceedance(self, ratio: npt.ArrayLike, cell: npt.NDArray[np.integer]) -> FloatArray:
        """Inverse of `threshold`; see `Normaliser.exceedance`.

        Args:
            ratio: shape (n,).
            cell: shape (n,).

        Returns:
            Shape (n,).
        """
        return np.exp(-np.asarray(ratio, dtype=float))

    def noise_power(self, ratios: npt.NDArray[np.float32]) -> npt.NDArray[np.float32]:
        """The ratios themselves; see `Normaliser.noise_power`.

        Args:
            ratios: shape (pulses, cells).

        Returns:
            Same shape.
        """
        return np.nan_to_num(ratios)

    def loss_db(self, probability: float) -> float:
        """Nothing is lost; see `Normaliser.loss_db`.

        Args:
            probability: p_N.

        Returns:
            Zero.
        """
        return 0.0
