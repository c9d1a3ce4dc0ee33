# SPDX-License-Identifier: Apache-2.0
"""What clutter and interference have in common: a section of the scenario that becomes a source of signal or noise."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass

import numpy as np

from radar_common.parameters import Parameters
from radar_sim.radar import Radar
from radar_sim.reception import Reception


class Disturbance(ABC):
    """Adds its share to the pulses as they come.

    What a pulse receives depends on its number alone, never on how pulses are grouped into sectors.
    """

    @abstractmethod
    def add_to(self, reception: Reception) -> None:
        """Add what is received of it.

        Args:
            reception: pulses that follow those of the call before.
        """


@dataclass(frozen=True, kw_only=True)
class DisturbanceSection(Parameters, ABC):
    """One entry of a scenario's `clutter` or `interference`."""

    def require_fit(self, radar: Radar) -> None:
        """Check that the radar can receive it.

        Args:
            radar: the radar of the scenario.

        Raises:
            ParameterError: it cannot; the text says why.
        """

    @abstractmethod
    def disturbance(self, radar: Radar, rng: np.random.Generator) -> Disturbance:
        """Make the source.

        Args:
            radar: that receives it.
            rng: its own source of randomness.

        Returns:
            The source, before the first pulse.
        """
