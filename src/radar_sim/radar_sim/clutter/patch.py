# SPDX-License-Identifier: Apache-2.0
"""Land and sea: an area whose mean echo varies over the ground and whose speckle changes from pulse to pulse."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from radar_common.parameters import ParameterError, parameter
from radar_sim.clutter.amplitude_laws import LAWS
from radar_sim.clutter.area import Area, AreaSection
from radar_sim.clutter.distributed import SPECTRA, Block, DistributedClutter
from radar_sim.clutter.texture import Grain, Texture
from radar_sim.disturbance import Disturbance
from radar_sim.radar import Radar
from radar_sim.runs import runs

_WEIBULL_SHAPES = (0.3, 2.0)


@dataclass(frozen=True, kw_only=True)
class PatchSection(AreaSection):
    """One entry of `clutter.patches`: land, sea or anything that fills an area."""

    cnr_db: float = parameter(
        20.0,
        "mean clutter-to-noise ratio of one pulse in the middle of the ranges",
        unit="dB",
        low=-40.0,
        high=80.0,
    )
    range_exponent: float = parameter(
        3.0,
        "the ratio falls with this power of range: 3 for a surface, 0 behind a perfect sensitivity time control",
        low=0.0,
        high=8.0,
    )
    law: str = parameter(
        "weibull",
        "of the amplitude: weibull suits land, k suits sea, rayleigh is the same mean power everywhere",
        choices=LAWS,
    )
    shape: float = parameter(
        1.0,
        "weibull: 2 is Rayleigh, rough land has 0.6-1.2; k: large is Rayleigh, spiky sea has 0.5-5; rayleigh: not used",
        low=0.05,
        high=1000.0,
    )
    spectrum: str = parameter(
        "gaussian",
        "pulse-to-pulse correlation: gaussian, exponential, or white for independent pulses as in the book",
        choices=SPECTRA,
    )
    speed_spread: float = parameter(
        0.3,
        "rms of the scatterers' radial speeds; with the turning beam it sets the correlation: trees in wind 0.1-0.4, "
        "sea 0.5-1.5",
        unit="m/s",
        low=0.0,
        high=50.0,
    )
    grain_range: float = parameter(
        500.0, "range in which the mean echo changes", unit="m", low=0.1, high=1e6
    )
    grain_azimuth_deg: float = parameter(
        2.0, "azimuth in which the mean echo changes", unit="deg", low=0.05, high=180.0
    )
    lifetime: float = parameter(
        0.0,
        "time in which the mean echo of a place changes; 0 for land, where it stays",
        unit="s",
        low=0.0,
        high=1e6,
    )

    def check(self) -> None:
        """Check the edges and that the law has this shape.

        Raises:
            ParameterError: they are out of order, or it has not.
        """
        super().check()
        low, high = _WEIBULL_SHAPES
        if self.law == "weibull" and not low <= self.shape <= high:
            raise ParameterError(
                f"shape of weibull must be in [{low:g}, {high:g}], got {self.shape:g}: 2 is Rayleigh, "
                "and no sum of many scatterers fluctuates less"
            )

    def disturbance(self, radar: Radar, rng: np.random.Generator) -> Disturbance:
        """Make the clutter; see `DisturbanceSection.disturbance`.

        Args:
            radar: that receives it.
            rng: of texture and speckle.

        Returns:
            The patch.
        """
        return Patch(self, radar, rng)


class Patch(DistributedClutter):
    """An area with texture."""

    def __init__(self, section: PatchSection, radar: Radar, rng: np.random.Generator) -> None:
        """Lay it out.

        Args:
            section: what it is.
            radar: that receives it.
            rng: source of randomness.
        """
        texture_rng, speckle_rng = rng.spawn(2)
        super().__init__(radar, section.spectrum, section.speed_spread, speckle_rng)
        self._radar = radar
        self._area = Area(section, radar)
        ranges = self._area.ranges
        middle = (section.range_from + section.range_to) / 2.0
        power = 10.0 ** (section.cnr_db / 10.0) * (ranges / middle) ** -section.range_exponent
        self._amplitude = np.sqrt(power).astype(np.float32)
        grain = Grain(
            section.grain_range,
            math.radians(section.grain_azimuth_deg),
            section.lifetime or math.inf,
        )
        self._texture = Texture(section.law, section.shape, grain, radar, ranges, texture_rng)

    def _blocks(self, first: int, pulses: int) -> Iterator[Block]:
        share = self._area.share(self._radar.azimuth(np.arange(first, first + pulses)))
        root = np.sqrt(share).astype(np.float32)
        for begin, end in runs(share > 0.0):
            amplitude = self._texture.amplitude(first + begin, end - begin)
            amplitude *= self._amplitude
            amplitude *= root[begin:end, None]
            yield Block(first + begin, self._area.first_cell, amplitude)
