# SPDX-License-Identifier: Apache-2.0
"""What a sliding-window detector makes of targets, by running it on simulated ones.

The sums of neighbouring positions share their pulses, so that the probability of at least one crossing has no short
form. The generator has a fixed seed: the same design gives the same prediction, and one smooth over the signal.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.special import gammaincinv, ndtr, ndtri

from primary_proc.calculators.azimuth.accuracy_table import AccuracyTable
from primary_proc.calculators.pulse.burst_shape import burst_shape
from primary_proc.calculators.pulse.target_models import TARGETS
from primary_proc.detectors.burst_detector import BurstDetector
from primary_proc.normalisers.fixed_level import FixedLevel
from primary_proc.normalisers.normaliser import Normaliser
from primary_proc.quantisers.quantiser import Quantiser

FloatArray = npt.NDArray[np.float64]

DETECTION_TRIALS = 10_000
"""Targets behind a detection probability: its standard error is at most 0.005."""

_ACCURACY_TRIALS = 2_500
_FEWEST_FOUND = 100
_AMPLITUDES = np.geomspace(1.0, 32.0, 16)
_PULSE_SHAPE = {"fast": 1.0, "fast-dominant": 2.0}
_WEAKEST_DB, _STRONGEST_DB, _GRID_DB = -15.0, 40.0, 2.0
_SEED = 1967


@dataclass(frozen=True, slots=True)
class Parts:
    """A detector to be tried out.

    Attributes:
        quantiser: makes the quantiser for a normaliser.
        detector: makes the detector for a number of rings and a longest burst.
        pulses: length of its register.
    """

    quantiser: Callable[[Normaliser], Quantiser]
    detector: Callable[[int, int], BurstDetector]
    pulses: int


class TargetTrials:
    """Targets anywhere between two pulses, each in a ring of its own, with noise before and after them."""

    def __init__(self, parts: Parts, pattern: str, pulses: float, target: str, trials: int) -> None:
        """Draw everything but the signal's strength.

        Args:
            parts: the detector.
            pattern: antenna pattern's name.
            pulses: N_0.
            target: name in `TARGETS`.
            trials: targets.
        """
        generator = np.random.default_rng(_SEED)
        self._parts = parts
        offset = generator.permutation((np.arange(trials) + 0.5) / trials - 0.5)
        shape = burst_shape(pattern, pulses, offset, book=False).T
        lead = np.zeros((parts.pulses, trials))
        self.position = len(lead) + (len(shape) - 1) / 2.0 + offset
        shape = np.concatenate([lead, shape, lead])
        model = TARGETS[target]
        rank = generator.permutation((np.arange(trials) + 0.5) / trials)
        shape *= model.factor[np.searchsorted(np.cumsum(model.weight)[:-1], rank)]
        if target in _PULSE_SHAPE:
            degrees = _PULSE_SHAPE[target]
            shape *= np.sqrt(gammaincinv(degrees, generator.random(shape.shape)) / degrees)
        self._shape = shape.astype(np.float32)
        self._noise = generator.standard_normal((2, *shape.shape), np.float32)
        self._quantiser = parts.quantiser(FixedLevel(trials, 1.0))

    def run(self, amplitude: float) -> tuple[npt.NDArray[np.void], npt.NDArray[np.float32]]:
        """Detect the targets at one strength.

        Args:
            amplitude: rms amplitude at the beam's axis over the noise's sigma.

        Returns:
            (bursts, peak): the bursts that ended, and the strongest pulse on each target's positions as power over
            the mean noise power, shape (trials,).
        """
        signal = np.float32(amplitude) * self._shape + self._noise[0]
        ratios = (np.square(signal) + np.square(self._noise[1])) / np.float32(2.0)
        detector = self._parts.detector(ratios.shape[1], 4 * len(ratios))
        silence = np.zeros((self._parts.pulses, ratios.shape[1]), np.float32)
        samples = self._quantiser.quantise(np.concatenate([ratios, silence]))
        lit = ratios[self._parts.pulses : -self._parts.pulses]
        return detector.detect(samples, 0), lit.max(axis=0)

    def found_share(self, snr_db: float) -> float:
        """Share of targets that give at least one burst.

        Args:
            snr_db: power over the mean noise power at the beam's axis.

        Returns:
            Share.
        """
        bursts, _ = self.run(math.sqrt(2.0) * 10.0 ** (snr_db / 20.0))
        return len(np.unique(bursts["ring"])) / len(self.position)


class DetectionCurve:
    """Detection probability against the signal, tried at every other decibel when it is first asked for."""

    def __init__(self, parts: Parts, pattern: str, pulses: float, target: str) -> None:
        """Begin with nothing tried.

        Args:
            parts: the detector.
            pattern: antenna pattern's name.
            pulses: N_0.
            target: name in `TARGETS`; of what is common to a burst's pulses, its mean.
        """
        self._of = parts, pattern, pulses, target
        self._known: dict[int, float] = {}

    def __call__(self, snr_db: FloatArray) -> FloatArray:
        """Interpolate; every value depends on its own surroundings only, whatever else was asked.

        Args:
            snr_db: power over the mean noise power at the beam's axis, shape (n,).

        Returns:
            Probability, shape (n,).
        """
        asked = np.clip(snr_db, _WEAKEST_DB, _STRONGEST_DB) / _GRID_DB
        nodes = np.floor(asked)[:, None].astype(int) + np.arange(-1, 3)
        missing = sorted(set(np.unique(nodes).tolist()) - set(self._known))
        trials = TargetTrials(*self._of, DETECTION_TRIALS) if missing else None
        for node in missing:
            sure = any(share == 1.0 for below, share in self._known.items() if below < node)
            self._known[node] = 1.0 if sure or not trials else trials.found_share(_GRID_DB * node)
        # Over the signal in dB the quantile of the normal distribution bends least: a cubic through four values.
        least = 0.5 / DETECTION_TRIALS
        known = np.array([self._known[node] for node in nodes.ravel().tolist()])
        before, here, there, after = ndtri(np.clip(known, least, 1.0 - least)).reshape(-1, 4).T
        part = asked - nodes[:, 1]
        slope, far_slope = (there - before) / 2.0, (after - here) / 2.0
        rise = there - here
        bend = (1.0 - part) * (slope - rise) - part * (far_slope - rise)
        found = ndtr(here + part * rise + part * (1.0 - part) * bend)
        return np.where((found > 1.01 * least) & (found < 1.0 - 1.01 * least), found, found.round())


def accuracy_tables(
    parts: Parts, pattern: str, pulses: float, target: str
) -> tuple[AccuracyTable, AccuracyTable]:
    """Bias and spread of the middle between start and end, and of the sum's peak, against the burst's peak.

    What is common to a burst's pulses shows in its peak, so that slow models have the table of steady targets.

    Args:
        parts: the detector.
        pattern: antenna pattern's name.
        pulses: N_0.
        target: name in `TARGETS`.

    Returns:
        (middle, centre).
    """
    alike = target if target in _PULSE_SHAPE else "steady"
    trials = TargetTrials(parts, pattern, pulses, alike, _ACCURACY_TRIALS)
    rows = []
    for amplitude in _AMPLITUDES:
        bursts, peak = trials.run(float(amplitude))
        # Of several bursts of one target the longest is its own.
        bursts = bursts[np.lexsort((bursts["start"] - bursts["end"], bursts["ring"]))]
        bursts = bursts[np.unique(bursts["ring"], return_index=True)[1]]
        if len(bursts) < _FEWEST_FOUND:
            continue
        truth = trials.position[bursts["ring"]]
        middle = (bursts["start"] + bursts["end"]) / 2.0 - truth
        centre = bursts["centre"] - truth
        power = np.median(peak[bursts["ring"]])
        rows.append(
            (amplitude**2 / 2.0, power, middle.mean(), middle.std(), centre.mean(), centre.std())
        )
    strength, power, *errors = np.array(rows).T
    peaks = strength, np.maximum.accumulate(power)
    return AccuracyTable(*peaks, *errors[:2]), AccuracyTable(*peaks, *errors[2:])
