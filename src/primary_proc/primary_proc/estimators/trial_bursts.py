# SPDX-License-Identifier: Apache-2.0
"""Targets of known place through the detector itself, from which an estimator learns its errors at design time."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from primary_proc.detectors.burst_detector import BurstDetector
from primary_proc.estimators.envelopes import Envelopes
from primary_proc.methods.detection_method import SettledMethod
from primary_proc.methods.requirements import Requirements
from primary_proc.normalisers.fixed_level import FixedLevel
from primary_proc.plots.power_meter import PowerMeter
from primary_proc.plots.ratio_history import RatioHistory
from radar_common.antenna_pattern import PATTERNS

FloatArray = npt.NDArray[np.float64]

_SEED = 1967
_CELLS = 900_000
_FEWEST = 64
_MARGIN = 16
_FARTHEST = 2.8
_BESIDE = 1.0
_LONGEST = 6.0
_BARELY_SEEN = 0.2
_WEAKEST_DB = np.arange(-20.0, 31.0, 3.0)
_ABOVE_DB = np.array([0, 1, 2, 3, 4, 5.5, 7, 9, 11, 13, 16, 19, 23, 28, 34, 42.0])
# Swerling's cases that change from pulse to pulse: half the degrees of freedom of a pulse's power.
_FREEDOM = {"fast": 1.0, "fast-dominant": 2.0}


@dataclass(frozen=True, slots=True)
class TrialBursts:
    """One burst each of many targets, the one over the target's middle where there are several.

    Attributes:
        bursts: dtype BURST, powers filled in, shape (n,).
        envelopes: the signal they were found in.
        truth: position of the target in pulses, shape (n,).
        strength: index of the target's strength, rising, shape (n,).
        amplitudes: a_0 of each strength, rising, shape (strengths,).
        powers: median peak power of each strength's bursts, rising, shape (strengths,).
        lag: median of the bursts' middles less the truth, in pulses.
    """

    bursts: npt.NDArray[np.void]
    envelopes: Envelopes
    truth: FloatArray
    strength: npt.NDArray[np.int64]
    amplitudes: FloatArray
    powers: FloatArray
    lag: float


def trial_bursts(
    method: SettledMethod, requirements: Requirements, reference_cells: float
) -> TrialBursts:
    """Simulate, with the same random numbers every time.

    The noise level of a pulse is the mean over reference cells of its own, so that amplitudes have the spread and the
    compression that cell averaging leaves in them.

    Args:
        method: the detector, set up.
        requirements: beam, and what targets do; one that changes only from turn to turn is steady here.
        reference_cells: of the noise level; infinite for one that is known.

    Returns:
        The bursts.
    """
    generator = np.random.default_rng(_SEED)
    seen = method.detection_probability(_WEAKEST_DB, requirements.target)
    weakest = float(np.interp(_BARELY_SEEN, np.maximum.accumulate(seen), _WEAKEST_DB))
    amplitudes = np.sqrt(2.0) * 10.0 ** ((weakest + _ABOVE_DB) / 20.0)
    beam = PATTERNS[requirements.pattern]
    reach = min(beam.extent, _FARTHEST) + _BESIDE
    half = int(np.ceil(reach * requirements.pulses / 2.0)) + _MARGIN
    each = max(_CELLS // (len(amplitudes) * (2 * half + 1)), _FEWEST)
    rings = each * len(amplitudes)
    truth = half + generator.uniform(-0.5, 0.5, rings)
    alpha = (np.arange(2.0 * half + 1.0)[:, None] - truth) / (requirements.pulses / 2.0)
    voltage = np.repeat(amplitudes, each) * beam(alpha)
    voltage = voltage.astype(np.float32)
    if requirements.target in _FREEDOM:
        freedom = _FREEDOM[requirements.target]
        voltage *= np.sqrt(
            generator.standard_gamma(freedom, voltage.shape, dtype=np.float32) / freedom
        )
    noise = generator.standard_normal((2, *voltage.shape), dtype=np.float32)
    power = ((noise[0] + voltage) ** 2 + noise[1] ** 2) / np.float32(2.0)
    as_known = power
    if np.isfinite(reference_cells):
        cells = np.float32(reference_cells)
        power /= generator.standard_gamma(reference_cells, power.shape, dtype=np.float32) / cells
        as_known = cells * np.log1p(power / cells)
    detector = method.detector(rings, math.ceil(_LONGEST * requirements.pulses))
    return _detected(method, detector, power, as_known, truth, amplitudes)


def _detected(
    method: SettledMethod,
    detector: BurstDetector,
    power: npt.NDArray[np.float32],
    as_known: npt.NDArray[np.float32],
    truth: FloatArray,
    amplitudes: FloatArray,
) -> TrialBursts:
    """Run the detector on power over the mean of noise, as a known noise level would give it."""
    pulses, rings = power.shape
    normaliser = FixedLevel(rings, 1.0)
    bursts = detector.detect(method.quantiser(normaliser).quantise(as_known), 0)
    history = RatioHistory(normaliser)
    signal = history.room(pulses, 0)
    signal[...] = power
    meter = PowerMeter(normaliser.noise_scale, detector.memory)
    meter.measure(bursts, history)
    signal[...] = as_known

    target = truth[bursts["ring"]]
    over = (bursts["start"] - detector.memory < target) & (bursts["end"] >= target)
    over &= ~bursts["overflow"]
    bursts, target = bursts[over], target[over]
    strength = bursts["ring"] // (rings // len(amplitudes))
    powers = [
        np.median(bursts["power"][strength == index]) if np.any(strength == index) else 0.0
        for index in range(len(amplitudes))
    ]
    lag = float(np.median((bursts["start"] + bursts["end"]) / 2.0 - target))
    return TrialBursts(
        bursts, history, target, strength, amplitudes, np.maximum.accumulate(powers), lag
    )
