# SPDX-License-Identifier: Apache-2.0
"""Sliding-window detectors: one way to set them up, to predict what they do and to make their parts."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from functools import cached_property, lru_cache

import numpy as np
import numpy.typing as npt
from scipy.special import lambertw

from primary_proc.calculators.azimuth.accuracy_table import AccuracyTable
from primary_proc.calculators.pulse.target_models import TARGETS
from primary_proc.detectors.window_detector import WindowDetector
from primary_proc.methods.detection_method import DetectionMethod, FloatArray, SettledMethod
from primary_proc.methods.requirements import Requirements
from primary_proc.methods.window import Window
from primary_proc.methods.window_noise import noise_bursts
from primary_proc.methods.window_targets import (
    DetectionCurve,
    Parts,
    accuracy_tables,
)
from primary_proc.normalisers.normaliser import Normaliser
from primary_proc.quantisers.amplitude_quantiser import (
    ENVELOPE_STEPS,
    AmplitudeQuantiser,
)
from primary_proc.quantisers.level_quantiser import LevelQuantiser
from primary_proc.quantisers.quantiser import Quantiser

_FEWEST_PULSES = 4
_ITERATIONS = 2
# Where the search begins; most detectors end near it.
_USUAL_LAST = 0.9
_DENSEST = 0.2
# Of all single thresholds this one tells most about weak signals; the nearest that there is is counted.
_TELLING = 1.785

Fit = Callable[[float], Window]
"""Sets up a window that starts bursts in noise with a given probability per position, or seldomer where it must."""


class WindowMethod(DetectionMethod, ABC):
    """A sliding-window detector before the radar is known."""

    fewest_pulses = _FEWEST_PULSES
    first_peak = False

    @abstractmethod
    def fit(self, requirements: Requirements) -> Fit:
        """Choose levels and weights for a radar.

        Args:
            requirements: what is asked.

        Returns:
            What sets the thresholds for a false-start probability; it raises ValueError where that is out of reach.
        """

    def settle(self, requirements: Requirements) -> SettledWindow:
        """Set the thresholds; see `DetectionMethod.settle`.

        Args:
            requirements: what is asked.

        Returns:
            The method with its thresholds.
        """
        return _settled(self, requirements)


class SettledWindow(SettledMethod):
    """A sliding-window detector with the thresholds that give the wanted false plots.

    Attributes:
        window: levels, weights and threshold.
        noise: what bursts of noise are like.
    """

    def __init__(self, requirements: Requirements, fit: Fit, *, first_peak: bool = False) -> None:
        """Invert the false-plot rate.

        Bursts of noise crowd: a sum just under its threshold will cross it again. A plot is a crowd, and crowds come
        as a Poisson process, of which those near one another in adjacent rings merge.

        Args:
            requirements: what is asked.
            fit: sets the window up for a false-start probability.
            first_peak: whether the centre of a burst is the first peak of its sum.

        Raises:
            ValueError: the rate is out of reach.
        """
        self._asked, self._first_peak = requirements, first_peak
        self._curves: dict[str, DetectionCurve] = {}
        cells = requirements.rings * requirements.pulses_per_scan
        beside = (requirements.rings - 1) / requirements.rings
        share = requirements.false_plots / cells
        starts = share / _USUAL_LAST
        for _ in range(_ITERATIONS):
            self.window = fit(starts)
            self.noise = noise_bursts(self.window, requirements.gap)
            room = (2.0 * (self.noise.span + requirements.gap) + 1.0) * beside
            if share * room > _DENSEST:
                raise ValueError(
                    f"{requirements.false_plots:g} false plots per scan on {cells:g} cells lie so close that they "
                    f"merge; at most {_DENSEST / room * cells:.3g} can be had"
                )
            crowds = float(-lambertw(-share * room).real / room) if room else share
            starts = crowds / self.noise.last
        self.false_starts = self.window.false_starts
        crowds = self.false_starts * self.noise.last
        self.false_plots = float(cells * crowds * np.exp(-room * crowds))
        self._counted = int(np.abs(self.window.edges - _TELLING).argmin())
        self.noise_probability = float(self.window.level_chances[1 + self._counted])

    @cached_property
    def _tables(self) -> tuple[AccuracyTable, AccuracyTable]:
        asked = self._asked
        return accuracy_tables(self._parts, asked.pattern, asked.pulses, asked.target)

    @property
    def accuracy(self) -> AccuracyTable:
        """By trial on simulated targets; see `SettledMethod.accuracy`."""
        return self._tables[0]

    @property
    def peak_accuracy(self) -> AccuracyTable:
        """Bias and spread of the position of the largest sum, `centre` of a burst."""
        return self._tables[1]

    @property
    def _parts(self) -> Parts:
        return Parts(self.quantiser, self.detector, self.window.pulses)

    def detection_probability(self, snr_db: npt.ArrayLike, target: str) -> FloatArray:
        """By trial on simulated targets, to 0.005; see `SettledMethod.detection_probability`.

        Args:
            snr_db: any shape.
            target: name in `target_models.TARGETS`.

        Returns:
            Same shape.
        """
        model = TARGETS[target]
        # Slow fluctuation is a mean over steady strengths, whatever its law.
        kind = target if len(model.factor) == 1 else "steady"
        if kind not in self._curves:
            asked = self._asked
            self._curves[kind] = DetectionCurve(self._parts, asked.pattern, asked.pulses, kind)
        return model.average(self._curves[kind], snr_db)

    def quality(self, chance: FloatArray) -> FloatArray:
        """From the peaks of simulated bursts of noise; see `SettledMethod.quality`.

        Args:
            chance: shape (n,).

        Returns:
            Shape (n,).
        """
        return np.interp(chance, self.noise.peak, self.noise.weaker, left=1.0, right=0.0)

    def quantiser(self, normaliser: Normaliser) -> Quantiser:
        """Make the quantiser, of few levels or of an envelope's fine steps.

        Args:
            normaliser: that the ratios come from.

        Returns:
            The quantiser.
        """
        window = self.window
        if window.table.shape[1] == ENVELOPE_STEPS:
            return AmplitudeQuantiser(normaliser, window.table, self._counted)
        chances = window.level_chances[1:-1]
        thresholds = np.stack([normaliser.threshold(float(chance)) for chance in chances])
        return LevelQuantiser(thresholds, window.table[0], self._counted)

    def detector(self, rings: int, longest: int) -> WindowDetector:
        """Make a detector.

        Args:
            rings: range rings.
            longest: limit of a burst's length, in pulses.

        Returns:
            The detector.
        """
        window = self.window
        return WindowDetector(
            window.taps, window.threshold, rings, longest, first_peak=self._first_peak
        )


@lru_cache(maxsize=16)
def _settled(method: WindowMethod, requirements: Requirements) -> SettledWindow:
    """A stream that begins anew asks for the same again, and a design is worth half a second."""
    return SettledWindow(requirements, method.fit(requirements), first_peak=method.first_peak)
