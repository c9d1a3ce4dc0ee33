# SPDX-License-Identifier: Apache-2.0
"""One plot from each group of bursts."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from primary_proc.estimators.azimuth_estimator import AzimuthEstimator
from primary_proc.estimators.envelopes import Envelopes
from primary_proc.plots.close_targets import TargetSeparator
from primary_proc.plots.ring_merge import Groups
from primary_proc.stream.pulse_log import PulseLog
from radar_common.frames import enu_from_polar
from radar_common.tables import PLOT

FloatArray = npt.NDArray[np.float64]

_UNIFORM = 1.0 / np.sqrt(12.0)
_BEST_RANGE = 0.1
_MOST_PULSES = np.iinfo(np.uint16).max


@dataclass(frozen=True, slots=True)
class Grid:
    """Where the cells lie and what it takes to be seen in one.

    Attributes:
        range_start: near edge of range cell 0, m.
        range_step: length of a range cell, m.
        azimuth_step: azimuth from pulse to pulse, rad.
        threshold: on a cell's power over the mean noise power.
    """

    range_start: float
    range_step: float
    azimuth_step: float
    threshold: float

    @property
    def reach(self) -> float:
        """Threshold on the amplitude: how near its limit a neighbouring cell must come to be seen."""
        return math.sqrt(self.threshold)


def form_plots(
    groups: Groups,
    quality: FloatArray,
    estimator: AzimuthEstimator,
    envelopes: Envelopes,
    log: PulseLog,
    grid: Grid,
    separator: TargetSeparator,
) -> npt.NDArray[np.void]:
    """Make plots.

    Range is the centroid of the rings weighted by amplitude, azimuth the mean weighted by the inverse variances. What
    is called amplitude, pulse count and quality is that of the strongest burst. A group with a burst cut off by its
    limit, longer than that limit altogether, or with more rings than a target fills, is an extended echo: quality 0,
    errors as wide as the echo.

    Args:
        groups: bursts, powers filled in, with the plot of each; at least one.
        quality: of each burst, shape (bursts,).
        estimator: of the azimuth.
        envelopes: the stored signal, for estimators that look again.
        log: azimuth and time of pulses.
        grid: of the cells.
        separator: takes apart targets that were near enough to be one group.

    Returns:
        Table of dtype PLOT; `time_offset` holds the time of the log.
    """
    centres = estimator.estimate(groups.bursts, envelopes)
    targets = separator.separate(groups, centres, envelopes)
    bursts, first = targets.groups.bursts, targets.groups.first
    size, extents = targets.size, targets.extents

    place, weight = targets.centres.position, 1.0 / np.square(targets.centres.std)
    total = np.add.reduceat(weight, first)
    position = np.add.reduceat(weight * place, first) / total
    plot = np.repeat(np.arange(len(first)), size)
    scatter = np.add.reduceat(weight * np.square(place - position[plot]), first) / total
    # Pieces of one ring's burst look at the same signal; only rings have noise of their own.
    variance = np.maximum(size / (extents.rings * total), scatter)
    amplitude = np.sqrt(bursts["power"].astype(float))
    weighted = np.add.reduceat(amplitude * bursts["ring"], first)
    ring = weighted / np.add.reduceat(amplitude, first) + 0.5
    strongest = np.lexsort((amplitude, plot))[first + (size - 1)]
    peak = amplitude[strongest]
    extended = ~separator.of_a_target(extents)

    plots = np.zeros(len(first), PLOT)
    plots["azimuth"], plots["time_offset"] = log.at(position)
    plots["range"] = grid.range_start + ring * grid.range_step
    plots["x"], plots["y"] = enu_from_polar(plots["range"], plots["azimuth"])
    spread = np.where(extended, extents.length * _UNIFORM, np.sqrt(variance))
    plots["azimuth_std"] = grid.azimuth_step * spread
    near = _range_error(extents.rings, grid.reach / peak)
    plots["range_std"] = grid.range_step * np.where(extended, extents.rings * _UNIFORM, near)
    plots["amplitude"] = peak
    plots["snr_db"] = 20.0 * np.log10(peak)
    length = bursts["end"][strongest] - bursts["start"][strongest] + 1
    plots["pulse_count"] = np.minimum(length, _MOST_PULSES)
    plots["quality"] = np.where(extended, 0.0, quality[targets.burst[strongest]])
    plots["radial_speed"] = plots["radial_speed_std"] = np.nan
    return plots


def _range_error(rings: npt.NDArray[np.int64], reach: FloatArray) -> FloatArray:
    """Standard deviation of the range centroid in cells, for a pulse as long as a cell and its matched filter.

    The echo falls off linearly over one cell to both sides. A target seen in one ring only is so near the ring's middle
    that the neighbours stay under the threshold, `reach` = threshold over amplitude, half a cell at most. Between two
    rings the amplitudes weigh its place. Agrees with simulation to a third of its value.
    """
    nearness = np.minimum(reach, 0.5) / np.sqrt(3.0)
    return np.maximum(np.where(rings == 1, nearness, nearness / 2.0), _BEST_RANGE)
