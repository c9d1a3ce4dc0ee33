# SPDX-License-Identifier: Apache-2.0
"""What every normaliser offers: the power of each range cell against the noise level around it.

A normaliser is bound to a number of range cells. It turns video into ratios and knows, exactly, with which probability
a ratio of noise alone exceeds a threshold; everything behind it works on ratios and is independent of the noise level.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]


class Normaliser(ABC):
    """Divides the power of range cells by a statistic of the noise around them.

    Attributes:
        noise_scale: factor that makes a ratio the cell's power over the mean noise power, shape (cells,).
    """

    noise_scale: FloatArray

    @abstractmethod
    def ratios(self, video: npt.NDArray, azimuth: FloatArray, out: npt.NDArray[np.float32]) -> int:
        """Normalise some pulses.

        Args:
            video: linear envelope, shape (pulses, cells), of any real type.
            azimuth: of each pulse, rad in [0, 2 pi), shape (pulses,).
            out: where the ratios go, float32, shape (pulses, cells); infinite or NaN where the noise level is zero.

        Returns:
            How many samples were not finite; they count as zero.
        """

    @abstractmethod
    def threshold(self, probability: float) -> FloatArray:
        """Threshold that the ratio of noise alone exceeds with a given probability.

        Args:
            probability: p_N in (0, 1).

        Returns:
            Threshold of each cell, shape (cells,).
        """

    @abstractmethod
    def exceedance(self, ratio: npt.ArrayLike, cell: npt.NDArray[np.integer]) -> FloatArray:
        """Probability that the ratio of noise alone exceeds a value; inverse of `threshold`.

        Args:
            ratio: values, shape (n,).
            cell: range cell of each, shape (n,).

        Returns:
            Probability, shape (n,).
        """

    @abstractmethod
    def noise_power(self, ratios: npt.NDArray[np.float32]) -> npt.NDArray[np.float32]:
        """Power over its mean that a known noise exceeds as rarely as this one's noise exceeds the ratio.

        It is -ln of `exceedance`: exponential with mean one in noise, whatever the normaliser and wherever the cell.

        Args:
            ratios: shape (pulses, cells).

        Returns:
            Power, same shape; zero where the ratio is NaN.
        """

    @abstractmethod
    def loss_db(self, probability: float) -> float:
        """Signal-to-noise ratio lost against a noise level that is known.

        Args:
            probability: p_N of the threshold.

        Returns:
            dB at a detection probability of one half of a single pulse of a steady target, for a cell in the middle.
        """


def square_finite(video: npt.NDArray, out: npt.NDArray[np.float32]) -> int:
    """Square the envelope; samples that are not finite, or whose square is not, become zero.

    Args:
        video: shape (pulses, cells), of any real type.
        out: float32, shape (pulses, cells).

    Returns:
        How many samples were not finite.
    """
    out[...] = video
    return square_in_place(out)


def square_in_place(envelope: npt.NDArray[np.float32]) -> int:
    """Square an envelope where it stands; samples that are not finite, or whose square is not, become zero.

    Args:
        envelope: of any shape; fastest where its memory is contiguous.

    Returns:
        How many samples were not finite.
    """
    np.multiply(envelope, envelope, out=envelope)
    # The maximum is NaN or infinite if any sample is: one cheap look instead of a mask.
    if math.isfinite(np.maximum.reduce(envelope, axis=None, initial=0.0)):
        return 0
    bad = ~np.isfinite(envelope)
    envelope[bad] = 0.0
    return int(np.count_nonzero(bad))
