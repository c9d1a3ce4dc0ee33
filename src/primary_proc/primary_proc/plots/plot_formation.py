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
    bursts, first, centres = targets.groups.bursts, targets.groups.first, targets.centres
    stop = np.concatenate([first[1:], [len(bursts)]])
    size = stop - first
    plot = np.repeat(np.arange(len(first)), size)

    weight = 1.0 / np.square(centres.std)
    total = np.add.reduceat(weight, first)
    position = np.add.reduceat(weight * centres.position, first) / total
    scatter = np.add.reduceat(weight * np.square(centres.position - position[plot]), first) / total
    amplitude = np.sqrt(bursts["power"].astype(float))
    in_ring = bursts["ring"]
    ring = np.add.reduceat(amplitude * in_ring, first) / np.add.reduceat(amplitude, first) + 0.5
    rings = np.maximum.reduceat(in_ring, first) - np.minimum.reduceat(in_ring, first) + 1
    # Pieces of one ring's burst look at the same signal; only rings have noise of their own.
    variance = np.maximum(size / (rings * total), scatter)
    strongest = np.lexsort((amplitude, plot))[stop - 1]
    peak = amplitude[strongest]
    begin = np.minimum.reduceat(bursts["start"], first)
    extent = np.maximum.reduceat(bursts["end"], first) - begin
    extended = (rings > separator.target_rings) | (extent > separator.longest)
    extended |= np.logical_or.reduceat(bursts["overflow"], first)

    plots = np.zeros(len(first), PLOT)
    plots["azimuth"], plots["time_offset"] = log.at(position)
    plots["range"] = grid.range_start + ring * grid.range_step
    plots["x"], plots["y"] = enu_from_polar(plots["range"], plots["azimuth"])
    spread = np.where(extended, extent * _UNIFORM, np.sqrt(variance))
    plots["azimuth_std"] = grid.azimuth_step * spread
    error = np.where(extended, rings * _UNIFORM, _range_error(rings, grid.reach / peak))
    plots["range_std"] = grid.range_step * error
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
