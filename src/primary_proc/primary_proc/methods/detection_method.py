# SPDX-License-Identifier: Apache-2.0
"""A way to detect bursts, and the same way set up for one radar."""

from __future__ import annotations

from abc import ABC, abstractmethod

import numpy as np
import numpy.typing as npt

from primary_proc.calculators.azimuth.accuracy_table import AccuracyTable
from primary_proc.detectors.burst_detector import BurstDetector
from primary_proc.methods.requirements import Requirements
from primary_proc.normalisers.normaliser import Normaliser
from primary_proc.quantisers.quantiser import Quantiser

FloatArray = npt.NDArray[np.float64]


class SettledMethod(ABC):
    """Thresholds, the parts that use them, and what they will do. Built once for a radar; holds no stream's state.

    Attributes:
        noise_probability: probability that noise makes a one; where there are no ones, of the level that the quantiser
            counts for the diagnostics.
        false_starts: probability per azimuth position and ring that noise starts a burst, P_fa.
        false_plots: false plots that this makes in one turn, less those that merge.
    """

    noise_probability: float
    false_starts: float
    false_plots: float

    @property
    @abstractmethod
    def accuracy(self) -> AccuracyTable:
        """Bias and spread of the middle between start and end, against the burst's peak; computed when first asked."""

    @abstractmethod
    def detection_probability(self, snr_db: npt.ArrayLike, target: str) -> FloatArray:
        """Probability that a target is detected, mean over its place between two pulses.

        Args:
            snr_db: power over the mean noise power at the beam's axis, any shape.
            target: name in `target_models.TARGETS`.

        Returns:
            Probability, same shape.
        """

    @abstractmethod
    def quality(self, chance: FloatArray) -> FloatArray:
        """Share of noise bursts whose peak is weaker: uniform for false plots, near one for targets.

        Args:
            chance: probability that a cell of noise exceeds the burst's peak, shape (n,).

        Returns:
            Shape (n,).
        """

    @abstractmethod
    def quantiser(self, normaliser: Normaliser) -> Quantiser:
        """Make what turns ratios into the detector's samples.

        Args:
            normaliser: that the ratios come from.

        Returns:
            The quantiser.
        """

    @abstractmethod
    def detector(self, rings: int, longest: int) -> BurstDetector:
        """Make a detector.

        Args:
            rings: range rings.
            longest: limit of a burst's length, in pulses.

        Returns:
            The detector in its initial state.
        """


class DetectionMethod(ABC):
    """A way to detect bursts, before the radar is known.

    Attributes:
        fewest_pulses: pulses that a burst needs to be detected at all.
    """

    fewest_pulses: int

    @abstractmethod
    def settle(self, requirements: Requirements) -> SettledMethod:
        """Set up for a radar.

        Args:
            requirements: what is asked.

        Returns:
            The method with its thresholds.

        Raises:
            ValueError: the requirements are out of reach; the text says why.
        """
