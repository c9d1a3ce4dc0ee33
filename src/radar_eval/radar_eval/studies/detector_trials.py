# SPDX-License-Identifier: Apache-2.0
"""Trials of the plot extractor on noise and on known targets, to be held against what its design predicts.

The noise level is known and every third range ring is used, the others silent, so that rings cannot merge and nothing
but the detector and the estimator is on trial. The extractor is the one that the node runs.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from primary_proc.calculators.pulse.burst_shape import burst_shape
from primary_proc.design import Design, design
from primary_proc.parameters import ExtractorParameters
from primary_proc.plot_extractor import PlotExtractor
from radar_common.antenna_pattern import PATTERNS
from radar_common.frames import TWO_PI, wrap_pi
from radar_common.tables import NANOSECONDS, Table, sweep_dtype

FloatArray = npt.NDArray[np.float64]

_SECTOR = 128
_PULSE_INTERVAL = 1e-3
_RING_SPACING = 3
_STEP_SIZE = 100.0
_NOISE_LEVEL = math.sqrt(2.0)
_BURSTS_APART = 5.0


@dataclass(frozen=True, slots=True)
class TrialRadar:
    """A radar on trial.

    Attributes:
        pulses: azimuth positions in one turn.
        rings: range rings in use.
        pattern: antenna pattern's name.
        pulses_in_burst: N_0.
    """

    pulses: int = 2048
    rings: int = 128
    pattern: str = "gaussian"
    pulses_in_burst: float = 16.0

    @property
    def step(self) -> float:
        """Azimuth between pulses, rad."""
        return TWO_PI / self.pulses

    @property
    def cells(self) -> int:
        """Range cells, the silent ones among them."""
        return _RING_SPACING * self.rings

    def parameters(
        self, detector: str, false_starts: float, **others: object
    ) -> ExtractorParameters:
        """Set up the extractor for this radar.

        Args:
            detector: its name.
            false_starts: wanted per position and ring in noise.
            others: further parameters of the extractor.

        Returns:
            Parameters for a noise level that is known, without merging.
        """
        half_power = PATTERNS[self.pattern].half_power
        values: dict[str, object] = {
            "detector": detector,
            "false_plots_per_scan": false_starts * self.pulses * self.cells,
            "beamwidth_deg": math.degrees(self.pulses_in_burst * self.step * half_power),
            "pattern": self.pattern,
            "normaliser": "fixed-level",
            "noise_level": _NOISE_LEVEL,
            "merge_gap": 0.0,
            # Targets as dense as these would be taken for clutter.
            "largest_raise_db": 0.0,
        }
        return ExtractorParameters().changed(values | others)

    def design(self, parameters: ExtractorParameters) -> Design:
        """Design as the extractor will.

        Args:
            parameters: of the extractor.

        Returns:
            Its settings and predictions.
        """
        return design(parameters, self.cells, self.step)


@dataclass(frozen=True, slots=True)
class Targets:
    """Targets on trial, all of one strength.

    Attributes:
        ring: number of the ring in use, shape (n,).
        position: pulse over which the target lies, with a fraction, shape (n,).
        found: whether some plot lies on its burst, shape (n,).
        error: azimuth of its nearest plot less its own, in steps; NaN where there is none, shape (n,).
        stated: standard deviation that the plot states, in steps, shape (n,).
    """

    ring: npt.NDArray[np.int64]
    position: FloatArray
    found: npt.NDArray[np.bool_]
    error: FloatArray
    stated: FloatArray


def count_false_plots(
    radar: TrialRadar, parameters: ExtractorParameters, turns: int, rng: np.random.Generator
) -> tuple[int, int]:
    """Count the plots of noise.

    Args:
        radar: on trial.
        parameters: of the extractor.
        turns: to run.
        rng: source of the noise.

    Returns:
        (plots, positions of all rings that were looked at).
    """
    extractor = PlotExtractor(parameters)
    plots = 0
    for turn in range(turns):
        signal = np.zeros((radar.pulses, radar.rings), complex)
        plots += len(_extract(extractor, radar, signal, turn, rng))
    plots += len(extractor.flush().rows)
    return plots, turns * radar.pulses * radar.rings


def try_targets(
    radar: TrialRadar,
    parameters: ExtractorParameters,
    snr_db: float,
    fluctuation: str,
    rng: np.random.Generator,
) -> Targets:
    """Look for targets, well apart from each other, that lie anywhere between two pulses.

    Args:
        radar: on trial.
        parameters: of the extractor.
        snr_db: mean power over the mean noise power at the beam's axis.
        fluctuation: steady, slow or fast.
        rng: source of noise, places and fluctuation.

    Returns:
        The targets and what was found of them.
    """
    apart = math.ceil(_BURSTS_APART * radar.pulses_in_burst)
    count = radar.pulses // apart
    middle = apart // 2 + apart * np.arange(count)
    offset = rng.uniform(-0.5, 0.5, (count, radar.rings))
    shape = burst_shape(radar.pattern, radar.pulses_in_burst, offset, book=False)
    reach = shape.shape[-1] // 2
    peak = math.sqrt(2.0) * 10.0 ** (snr_db / 20.0)
    echo = peak * shape * _fluctuate(fluctuation, shape.shape, rng)
    signal = np.zeros((radar.pulses, radar.rings), complex)
    rows = middle[:, None] + np.arange(-reach, reach + 1)
    signal[rows] = np.moveaxis(echo, -1, 1)
    extractor = PlotExtractor(parameters)
    plots = np.concatenate([_extract(extractor, radar, signal, 0, rng), extractor.flush().rows])
    ring = np.broadcast_to(np.arange(radar.rings), offset.shape).reshape(-1)
    position = (middle[:, None] + offset).reshape(-1)
    return _matched(radar, plots, ring, position, float(reach))


def _fluctuate(
    fluctuation: str, shape: tuple[int, ...], rng: np.random.Generator
) -> npt.NDArray[np.complex128]:
    drawn = {
        "steady": (*shape[:-1], 1),
        "slow": (*shape[:-1], 1),
        "fast": shape,
    }[fluctuation]
    if fluctuation == "steady":
        return np.asarray(np.exp(2j * np.pi * rng.random(drawn)))
    return np.asarray(
        (rng.standard_normal(drawn) + 1j * rng.standard_normal(drawn)) / math.sqrt(2.0)
    )


def _extract(
    extractor: PlotExtractor,
    radar: TrialRadar,
    signal: npt.NDArray[np.complex128],
    turn: int,
    rng: np.random.Generator,
) -> npt.NDArray[np.void]:
    noise = rng.standard_normal(signal.shape) + 1j * rng.standard_normal(signal.shape)
    rows = np.zeros(radar.pulses, sweep_dtype(radar.cells))
    rows["video"][:, ::_RING_SPACING] = np.abs(signal + noise)
    rows["azimuth"] = np.arange(radar.pulses) * radar.step
    rows["range_step"] = _STEP_SIZE
    found = []
    for first in range(0, radar.pulses, _SECTOR):
        part = rows[first : first + _SECTOR].copy()
        part["time_offset"] = np.arange(len(part)) * _PULSE_INTERVAL
        stamp = round((turn * radar.pulses + first) * _PULSE_INTERVAL * NANOSECONDS)
        found.append(extractor.process(Table(stamp, part)).rows)
    return np.concatenate(found)


def _matched(
    radar: TrialRadar,
    plots: npt.NDArray[np.void],
    ring: npt.NDArray[np.int64],
    position: FloatArray,
    reach: float,
) -> Targets:
    """Give each target the plot of its ring that lies nearest, if it lies on its burst."""
    plot_ring = np.rint((plots["range"] / _STEP_SIZE - 0.5) / _RING_SPACING).astype(np.int64)
    error = np.full(len(ring), np.nan)
    stated = np.full(len(ring), np.nan)
    targets = np.lexsort((position, ring))
    key = ring[targets] * radar.pulses + position[targets]
    place = plot_ring * radar.pulses + plots["azimuth"] / radar.step
    after = np.clip(np.searchsorted(key, place), 1, len(key) - 1)
    nearer = np.where(place - key[after - 1] < key[after] - place, after - 1, after)
    distance = wrap_pi((place - key[nearer]) * radar.step) / radar.step
    near = np.flatnonzero(np.abs(distance) <= reach)
    # Of several plots on one target the nearest is written last.
    near = near[np.argsort(-np.abs(distance[near]), kind="stable")]
    error[targets[nearer[near]]] = distance[near]
    stated[targets[nearer[near]]] = plots["azimuth_std"][near] / radar.step
    return Targets(ring, position, np.isfinite(error), error, stated)
