# SPDX-License-Identifier: Apache-2.0
"""Raises the detection criterion where clutter would make more plots than the design allows, and lowers it again.

§ 1.1 of Kuzmin (1967) asks this of the primary device: that it change the criterion of detection so that under strong
interference the plots stay as many as the computer can take. No plot is ever dropped for it.
"""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import numpy.typing as npt

from primary_proc.criterion.examiner import Examiner
from primary_proc.criterion.plots_limit import PlotsLimit
from primary_proc.criterion.raises import Raises
from primary_proc.criterion.zones import Zones
from primary_proc.design import Design
from primary_proc.normalisers.normaliser import Normaliser
from primary_proc.parameters import ExtractorParameters
from radar_common.frames import TWO_PI
from radar_common.health import Health

FloatArray = npt.NDArray[np.float64]
Ratios = npt.NDArray[np.float32]

_WHOLE = 0.75
_ROUNDING = 1e-6
_PULSES_AT_HAND = 128


class CriterionControl:
    """Follows the beam from sector to sector, looks at suspicious zones and lowers the ratios of raised ones.

    Everything is decided where the beam enters or leaves a sector, from plots that lie so far back that all of them
    have come; so nothing depends on how pulses are cut into messages. A raise decided in a sector holds there from the
    next turn on.
    """

    def __init__(self, parameters: ExtractorParameters, cells: int, health: Health) -> None:
        """Start with nothing raised.

        Args:
            parameters: limits of the raises and of the plots in a turn.
            cells: range cells of a pulse.
            health: where raises are reported.
        """
        largest, limit = parameters.largest_raise_db, parameters.plots_limit_per_scan
        zones = Zones(cells, math.radians(parameters.beamwidth_deg))
        self._zones, self._health = zones, health
        self._raises = Raises(zones, largest)
        self._limit = PlotsLimit(limit, largest, zones.sectors) if limit else None
        self._on = largest > 0.0
        self._sectors_per_rad = zones.sectors / TWO_PI
        self._new: list[tuple[FloatArray, FloatArray]] = []
        self._plots = np.zeros((zones.sectors, len(zones)), np.int64)
        self._factors: dict[int, Ratios] = {}
        # The first report says that nothing is raised; without news there is no other.
        self._reported = True
        self.restart()

    @property
    def raise_db(self) -> FloatArray:
        """Raise of each zone, dB, shape (sectors, zones)."""
        return self._raises.raise_db

    def tune(self, design: Design, normaliser: Normaliser) -> None:
        """Take over a design; raises stay.

        Args:
            design: what is wanted and how it is detected.
            normaliser: that the ratios come from.
        """
        pulses = TWO_PI / design.step / self._zones.sectors
        self._examiner = Examiner(design, normaliser, pulses)
        self._expected = design.method.false_starts * pulses * self._zones.widths
        self._fewest = _WHOLE * pulses
        self._half_turn = pulses * self._zones.sectors / 2
        # Plots come up to two longest bursts after their azimuth, and not before the end of the pulses at hand.
        latest = 2 * design.longest + design.requirements.gap + _PULSES_AT_HAND
        sectors = self._zones.sectors
        self._lag = min(1 + math.ceil(latest / pulses), sectors - 1)
        self._every = min(sectors // 2, sectors - self._lag)

    def restart(self) -> None:
        """Expect pulses that do not continue those before; what was learned stays."""
        self._sector = -1
        self._zone = np.zeros(0, np.int64)
        self._kept: list[Ratios] = []
        self._factor: Ratios | None = None

    def apply(self, ratios: Ratios, azimuth: FloatArray) -> Ratios:
        """Lower the ratios where the criterion is raised.

        Args:
            ratios: of the next pulses, shape (pulses, cells); not changed.
            azimuth: of the pulses, rad in [0, 2 pi), shape (pulses,).

        Returns:
            The same array where nothing is raised, else a copy.
        """
        if not self._on:
            return ratios
        seen = ratios
        for sector, begin, end in self._runs(azimuth):
            if sector != self._sector:
                self._follow(sector)
            if len(self._zone):
                self._kept.append(ratios[begin:end, self._cells])
            if self._factor is not None:
                seen = ratios.copy() if seen is ratios else seen
                seen[begin:end] *= self._factor
        return seen

    def count(self, cell: FloatArray, azimuth: FloatArray) -> None:
        """Note plots.

        Args:
            cell: range cell with its fraction, shape (n,).
            azimuth: rad in [0, 2 pi), shape (n,).
        """
        if self._on:
            self._new.append((cell, azimuth))

    def _runs(self, azimuth: FloatArray) -> list[tuple[int, int, int]]:
        """Sectors of the pulses, with the first pulse in each and the first after it."""
        scale, sectors = self._sectors_per_rad, self._zones.sectors
        first = int(float(azimuth[0]) * scale + _ROUNDING)
        if first == int(float(azimuth[-1]) * scale + _ROUNDING) and len(azimuth) < self._half_turn:
            # The rule, and ten times faster than looking at every pulse.
            return [(first % sectors, 0, len(azimuth))]
        sector = (azimuth * scale + _ROUNDING).astype(np.int64) % sectors
        bounds = [0, *(np.flatnonzero(np.diff(sector)) + 1).tolist(), len(sector)]
        return [(int(sector[i]), i, j) for i, j in pairwise(bounds)]

    def _follow(self, sector: int) -> None:
        """Go on to the sector of the next pulses."""
        ahead = (sector - self._sector) % self._zones.sectors
        # An encoder that trembles where two sectors meet does not take the beam back.
        if self._sector >= 0 and not 0 < ahead <= self._zones.sectors // 2:
            return
        self._leave()
        if sector // self._every != self._sector // self._every:
            self._suspect(sector)
        if self._limit is not None:
            self._sort_plots()
            self._limit.settle((sector - self._lag) % self._zones.sectors)
        self._sector = sector
        self._zone = self._raises.choose(sector)
        if len(self._zone):
            self._cells, self._place = self._zones.cells(self._zone)
        self._factor = self._factors.get(sector)
        if self._limit is not None and self._limit.raise_db:
            gain = np.float32(10.0 ** (-self._limit.raise_db / 10.0))
            self._factor = np.atleast_1d(gain) if self._factor is None else self._factor * gain

    def _suspect(self, sector: int) -> None:
        """Judge the plots of the sectors that lie some way back; once or twice a turn, for it is slow on few."""
        self._sort_plots()
        behind = (sector - self._lag - np.arange(self._every)) % self._zones.sectors
        plots = np.zeros_like(self._plots)
        plots[behind] = self._plots[behind]
        self._plots[behind] = 0
        self._raises.suspect(plots, self._expected)
        if self._limit is not None or self._factors or self._reported:
            self._report()

    def _sort_plots(self) -> None:
        """Sort the plots that have come into their zones."""
        if not self._new:
            return
        cell, azimuth = map(np.concatenate, zip(*self._new, strict=True))
        self._new = []
        sector = self._zones.sector(azimuth)
        place = sector * len(self._zones) + self._zones.zone(cell)
        np.add.at(self._plots.reshape(-1), place, 1)
        if self._limit is not None:
            self._limit.add(sector)

    def _leave(self) -> None:
        """Learn from the sector that ends, if the beam has seen enough of it."""
        zone, kept = self._zone, self._kept
        self._zone, self._kept = zone[:0], []
        if sum(map(len, kept)) < self._fewest or not len(zone):
            return
        counts = self._examiner.counts(np.concatenate(kept), self._cells, self._place)
        noise = np.outer(self._zones.widths[zone], self._examiner.noise)
        self._raises.learn(self._sector, zone, counts, noise, self._expected[zone])
        raises = self.raise_db[self._sector]
        self._factors.pop(self._sector, None)
        if raises.any():
            gain = np.repeat(10.0 ** (-raises / 10.0), self._zones.widths)
            self._factors[self._sector] = gain.astype(np.float32)

    def _report(self) -> None:
        self._reported = bool(self._factors)
        raise_db = self.raise_db
        share = (raise_db > 0.0) @ self._zones.widths / self._zones.bounds[-1]
        watch = self._health.watch
        watch(
            "share of the coverage with a raised criterion (expected: no clutter)",
            0.0,
            share.mean(),
        )
        watch("largest raise of the criterion, dB (expected: no clutter)", 0.0, raise_db.max())
        if self._limit is not None:
            watch(
                "plots of the last turn (expected: their limit)",
                self._limit.limit,
                self._limit.load,
            )
            watch("raise of the criterion to keep the limit, dB", 0.0, self._limit.raise_db)
