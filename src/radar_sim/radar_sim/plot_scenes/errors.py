# SPDX-License-Identifier: Apache-2.0
"""Errors of measured positions (Kuzmin 1967, § 4.2.2)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]


@dataclass(frozen=True, kw_only=True, slots=True)
class PlotErrors:
    """Law of the errors: normal and independent from scan to scan (4.9), some plots with larger ones, and a bias.

    Attributes:
        range_std: m.
        azimuth_std: rad.
        outliers: share of the plots whose errors are `outlier_factor` times as large.
        outlier_factor: of these.
        range_bias: m, added to every plot.
        azimuth_bias: rad, added to every plot.
    """

    range_std: float = 20.0
    azimuth_std: float = 0.002
    outliers: float = 0.0
    outlier_factor: float = 4.0
    range_bias: float = 0.0
    azimuth_bias: float = 0.0

    def __post_init__(self) -> None:
        """Refuse what is no law.

        Raises:
            ValueError: a standard deviation or the factor is negative, or the share is none.
        """
        least = min(self.range_std, self.azimuth_std, self.outlier_factor, self.outliers)
        if not (least >= 0.0 and self.outliers <= 1.0):
            raise ValueError(f"not a law of errors: {self}")

    def draw(self, number: int, rng: np.random.Generator) -> tuple[FloatArray, FloatArray]:
        """Draw errors.

        Args:
            number: of plots.
            rng: source of randomness.

        Returns:
            (range, azimuth): m and rad, each shape (number,).
        """
        factor = np.where(rng.random(number) < self.outliers, self.outlier_factor, 1.0)
        errors = factor * rng.standard_normal((2, number))
        return (
            self.range_bias + self.range_std * errors[0],
            self.azimuth_bias + self.azimuth_std * errors[1],
        )
