# SPDX-License-Identifier: Apache-2.0
"""What normalisers with a window of reference cells have in common: all follows from the law of their noise level."""

from __future__ import annotations

from functools import cached_property

import numpy as np
import numpy.typing as npt

from primary_proc.calculators.cfar.cfar_detection import (
    false_alarm_probability,
    loss_db,
    multiplier_for,
)
from primary_proc.calculators.cfar.cfar_laws import LevelLaw
from primary_proc.normalisers.exceedance_table import ExceedanceTable
from primary_proc.normalisers.normaliser import FloatArray, Normaliser


class WindowNormaliser(Normaliser):
    """Power of a cell over a statistic of its reference cells, the same law in every cell."""

    def __init__(self, cells: int, law: LevelLaw, summed: int) -> None:
        """Bind to a law.

        Args:
            cells: range cells of a pulse.
            law: of the noise level.
            summed: the statistic is the level times this: the cells of a sum whose mean is the level.
        """
        self._cells, self._law, self._summed = cells, law, summed
        self.noise_scale = np.full(cells, summed * law.mean)

    def threshold(self, probability: float) -> FloatArray:
        """Threshold on the ratio; see `Normaliser.threshold`.

        Args:
            probability: p_N.

        Returns:
            Shape (cells,).
        """
        return np.full(self._cells, multiplier_for(self._law, probability) / self._summed)

    def exceedance(self, ratio: npt.ArrayLike, cell: npt.NDArray[np.integer]) -> FloatArray:
        """Inverse of `threshold`; see `Normaliser.exceedance`.

        Args:
            ratio: shape (n,).
            cell: shape (n,).

        Returns:
            Shape (n,).
        """
        return false_alarm_probability(self._law, self._summed * np.asarray(ratio, dtype=float))

    def noise_power(self, ratios: npt.NDArray[np.float32]) -> npt.NDArray[np.float32]:
        """From a table of the law; see `Normaliser.noise_power`.

        Args:
            ratios: shape (pulses, cells).

        Returns:
            Same shape.
        """
        return self._table.power(ratios)

    def loss_db(self, probability: float) -> float:
        """By quadrature over the law; see `Normaliser.loss_db`.

        Args:
            probability: p_N.

        Returns:
            dB.
        """
        return loss_db(self._law, probability)

    @cached_property
    def _table(self) -> ExceedanceTable:
        return ExceedanceTable(self._law, self._summed)
