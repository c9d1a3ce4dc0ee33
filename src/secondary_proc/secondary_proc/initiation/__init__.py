# SPDX-License-Identifier: Apache-2.0
"""Rules that confirm tracks, by the name that the parameter `initiation` gives them."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from secondary_proc.initiation.drop import DROP_RULES
from secondary_proc.initiation.interface import Evidence, Initiation, Verdict
from secondary_proc.initiation.l_of_m import LOfM
from secondary_proc.initiation.likelihood_ratio import LikelihoodRatio
from secondary_proc.initiation.wald import Wald

if TYPE_CHECKING:
    from secondary_proc.parameters import TrackerParameters

INITIATIONS: dict[str, Callable[[TrackerParameters], Initiation]] = {
    "likelihood_ratio": LikelihoodRatio,
    "l_of_m": LOfM,
    "wald": Wald,
}
"""Rules by name, each made of the parameters."""

__all__ = ["DROP_RULES", "INITIATIONS", "Evidence", "Initiation", "Verdict"]
