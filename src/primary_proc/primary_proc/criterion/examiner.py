# SPDX-License-Identifier: Apache-2.0
"""Counts the bursts that the radar's own detector would find in a zone at other criteria than the present one."""

from __future__ import annotations

from functools import cached_property

import numpy as np
import numpy.typing as npt

from primary_proc.criterion.clutter_tail import LEVELS_DB
from primary_proc.design import Design
from primary_proc.detectors.burst_detector import joined
from primary_proc.normalisers.fixed_level import FixedLevel
from primary_proc.normalisers.normaliser import Normaliser

_NOISE_CELLS = 1024
_SEED = 1


class Examiner:
    """Runs a fresh detector over a sector's ratios, once for each level, all levels side by side as range rings."""

    def __init__(self, design: Design, normaliser: Normaliser, pulses: float) -> None:
        """Take over the design.

        Args:
            design: with the method that detects.
            normaliser: that the ratios come from.
            pulses: of a sector.
        """
        self._design, self._pulses = design, pulses
        probability = design.method.noise_probability
        self._criterion = normaliser.threshold(probability).astype(np.float32)
        # Ratios over the threshold of their cell become powers over a known noise with the same threshold.
        self._unit = np.float32(-1.0 / np.log(probability))
        level = -np.log(probability) * 10.0 ** (-LEVELS_DB / 10.0)
        self._scale = level.astype(np.float32)[:, None]

    @cached_property
    def noise(self) -> npt.NDArray[np.float64]:
        """Bursts that noise makes in one range cell while the beam passes a sector, shape (levels,).

        Counted in simulated noise, as every detector can be run and not every one has a calculator at all levels. Made
        when first asked, which in noise alone is never.
        """
        shape = round(self._pulses), _NOISE_CELLS
        power = np.random.default_rng(_SEED).standard_exponential(shape, np.float32)
        place = np.zeros(_NOISE_CELLS, np.int64)
        found = self._count(power * self._unit, place)
        return found[0] / _NOISE_CELLS

    def counts(
        self,
        ratios: npt.NDArray[np.float32],
        cells: npt.NDArray[np.integer],
        place: npt.NDArray[np.integer],
    ) -> npt.NDArray[np.float64]:
        """Count bursts.

        Args:
            ratios: of consecutive pulses, shape (pulses, n).
            cells: range cell of each column, shape (n,).
            place: zone that each column belongs to, counted from 0, shape (n,).

        Returns:
            Bursts in each zone at each of LEVELS_DB, shape (zones, levels).
        """
        return self._count(ratios / self._criterion[cells], place)

    def _count(
        self, over: npt.NDArray[np.float32], place: npt.NDArray[np.integer]
    ) -> npt.NDArray[np.float64]:
        """Count bursts among ratios over the threshold of their cell."""
        pulses, columns = over.shape
        levels = len(LEVELS_DB)
        power = over[:, None, :] * self._scale
        known = FixedLevel(levels * columns, 1.0)
        method = self._design.method
        samples = method.quantiser(known).quantise(power.reshape(pulses, -1))
        detector = method.detector(levels * columns, self._design.longest)
        found = joined(detector.detect(samples, 0), detector.open_bursts())
        level, column = np.divmod(found["ring"].astype(np.int64), columns)
        zones = int(place[-1]) + 1
        number = np.bincount(place[column] * levels + level, minlength=zones * levels)
        return number.reshape(zones, levels).astype(float)
