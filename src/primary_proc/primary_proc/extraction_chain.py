# SPDX-License-Identifier: Apache-2.0
"""Normalise, quantise, detect, merge, estimate: the chain for one set of range cells."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
import numpy.typing as npt

from primary_proc.choices import ESTIMATORS, NORMALISERS
from primary_proc.criterion.criterion_control import CriterionControl
from primary_proc.design import design
from primary_proc.detectors.burst_detector import joined
from primary_proc.parameters import ExtractorParameters
from primary_proc.plots.close_targets import TargetSeparator
from primary_proc.plots.plot_formation import Grid, form_plots
from primary_proc.plots.power_meter import PowerMeter
from primary_proc.plots.ratio_history import RatioHistory
from primary_proc.plots.ring_merge import Groups, RingMerger
from primary_proc.rate_watch import RateWatch
from primary_proc.stream.pulse_log import PulseLog
from primary_proc.stream.sweep_stream import Pulses
from radar_common.health import Health
from radar_common.tables import PLOT

_NO_PLOTS = np.zeros(0, PLOT)
_BLOCK = 128
_RETUNE = 0.02
_MARGIN = 8


class ExtractionChain:
    """Extracts plots from consecutive pulses; keeps of the past only what open bursts need."""

    def __init__(self, parameters: ExtractorParameters, pulses: Pulses, health: Health) -> None:
        """Set up for the radar that the pulses come from.

        Args:
            parameters: what the user wants.
            pulses: the first pulses; they are not processed yet.
            health: where counts and rates go.

        Raises:
            ValueError: the parameters do not fit the radar.
        """
        self._parameters = parameters
        self._health = health
        self._layout = _layout(pulses)
        cells = pulses.video.shape[1]
        self._design = design(parameters, cells, pulses.azimuth_step)
        self._normaliser = NORMALISERS[parameters.normaliser](parameters, cells)
        self._detector = self._design.method.detector(cells, self._design.longest)
        self._meter = PowerMeter(self._normaliser.noise_scale, self._detector.memory)
        self._merger = RingMerger(self._design.longest, self._design.requirements.gap)
        self._log = PulseLog()
        self._history = RatioHistory(self._normaliser)
        self._criterion = CriterionControl(parameters, cells, health)
        self._begin = 0
        self._going = self._detector.open_bursts()
        self._tune()

    def fits(self, pulses: Pulses) -> bool:
        """Tell whether pulses have the range cells of this chain.

        Args:
            pulses: to look at.

        Returns:
            Whether they can be given to `extract`.
        """
        return _layout(pulses) == self._layout

    def extract(self, pulses: Pulses) -> npt.NDArray[np.void]:
        """Go on with the next pulses.

        Args:
            pulses: a continuation of those before.

        Returns:
            Plots completed, dtype PLOT, `time_offset` in the time of the pulses.

        Raises:
            ValueError: the rotation has changed to one that the parameters do not fit.
        """
        finished = _NO_PLOTS
        if abs(pulses.azimuth_step / self._design.step - 1.0) > _RETUNE:
            finished = self._redesign(pulses.azimuth_step)
        return joined(finished, *[self._block(*block) for block in _blocks(pulses)])

    def finish(self) -> npt.NDArray[np.void]:
        """End the stream of pulses; bursts that have not ended are dropped.

        Returns:
            Plots that waited for a neighbour.
        """
        self._health.drop("bursts cut by a break", len(self._going))
        plots = self._plots(self._merger.finish())
        self._detector.reset()
        self._going = self._detector.open_bursts()
        self._criterion.restart()
        self._begin = self._log.next
        self._history.restart(self._begin)
        return plots

    def _block(
        self, video: npt.NDArray, azimuth: npt.NDArray, time: npt.NDArray
    ) -> npt.NDArray[np.void]:
        oldest = self._oldest()
        first = self._log.append(azimuth, time, oldest)
        ratios = self._history.room(len(video), oldest - self._estimator.reach)
        bad = self._normaliser.ratios(video, azimuth, ratios)
        bits = self._quantiser.quantise(self._criterion.apply(ratios, azimuth))
        closed = self._whole(self._detector.detect(bits, first))
        self._going = self._detector.open_bursts()
        self._meter.measure(closed, self._history)
        plots = self._plots(self._merger.add(closed, self._going, self._log.next - 1))

        self._health.drop("bursts that prolong an extended echo", self._merger.left_out)
        self._health.drop("samples that are not finite, taken as zero", bad)
        self._health.count("pulses in", len(video))
        self._health.count("bursts cut at their longest", int(np.count_nonzero(closed["overflow"])))
        self._rates.add(len(video), self._quantiser.ones, len(plots))
        return plots

    def _whole(self, closed: npt.NDArray[np.void]) -> npt.NDArray[np.void]:
        """Leave out bursts that were under way when the stream began: their true start was not seen."""
        whole = closed["start"] > self._begin + self._detector.memory
        if np.logical_and.reduce(whole):
            return closed
        self._health.drop("bursts cut by a break", int((~whole).sum()))
        return closed[whole]

    def _plots(self, groups: Groups) -> npt.NDArray[np.void]:
        bursts = groups.bursts
        if not len(bursts):
            return _NO_PLOTS
        ratio = bursts["power"] / self._normaliser.noise_scale[bursts["ring"]]
        quality = self._design.method.quality(self._normaliser.exceedance(ratio, bursts["ring"]))
        plots = form_plots(
            groups,
            quality,
            self._estimator,
            self._history,
            self._log,
            self._grid,
            self._separator,
        )
        self._health.count("plots out", len(plots))
        cell = (plots["range"] - self._grid.range_start) / self._grid.range_step
        self._criterion.count(cell, plots["azimuth"])
        return plots

    def _redesign(self, step: float) -> npt.NDArray[np.void]:
        """Take another rotation; bursts under way go on unless the detector itself becomes another."""
        plan = design(self._parameters, self._layout[0], step)
        detector = plan.method.detector(self._layout[0], plan.longest)
        finished = _NO_PLOTS
        if detector.rule != self._detector.rule:
            finished = self.finish()
            self._detector, self._going = detector, detector.open_bursts()
            self._meter = PowerMeter(self._normaliser.noise_scale, detector.memory)
        self._design = plan
        self._tune()
        self._health.count("changes of the rotation")
        return finished

    def _tune(self) -> None:
        """Take over the design."""
        cells, range_start, range_step = self._layout
        plan = self._design
        self._quantiser = plan.method.quantiser(self._normaliser)
        self._estimator = ESTIMATORS[self._parameters.azimuth_estimator](
            plan.method, plan.requirements, self._normaliser
        )
        threshold = -math.log(plan.method.noise_probability)
        self._grid = Grid(range_start, range_step, plan.step, threshold)
        self._separator = TargetSeparator(
            plan.requirements.pattern,
            plan.requirements.pulses,
            threshold,
            self._parameters.target_rings,
            plan.longest,
            self._parameters.split_valley_db,
        )
        self._detector.longest = self._merger.longest = plan.longest
        self._merger.gap = plan.requirements.gap
        self._criterion.tune(plan, self._normaliser)
        self._rates = RateWatch(plan, cells, self._health)

    def _oldest(self) -> int:
        starts = (self._going["start"], self._merger.waiting["start"])
        oldest = [int(np.minimum.reduce(start)) for start in starts if len(start)]
        return min([self._log.next, *oldest]) - max(self._detector.memory, _MARGIN)


def _layout(pulses: Pulses) -> tuple[int, float, float]:
    return pulses.video.shape[1], pulses.range_start, pulses.range_step


def _blocks(pulses: Pulses) -> Iterator[tuple[npt.NDArray, npt.NDArray, npt.NDArray]]:
    """Parts whose ratios stay in the processor's cache; a message may hold a whole turn."""
    for first in range(0, len(pulses.video), _BLOCK):
        part = slice(first, first + _BLOCK)
        yield pulses.video[part], pulses.azimuth[part], pulses.time[part]
