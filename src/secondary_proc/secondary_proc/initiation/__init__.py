# SPDX-License-Identifier: Apache-2.0
"""Rules that confirm tracks, by the name that the parameter `initiation` gives them."""

from __future__ import annotations

from collections.abc import Callable

from secondary_proc.initiation.interface import Evidence, Initiation, Verdict
from secondary_proc.initiation.l_of_m import LOfM
from secondary_proc.initiation.likelihood_ratio import LikelihoodRatio

INITIATIONS: dict[str, Callable[[int, int, int], Initiation]] = {
    "likelihood_ratio": lambda hits, window, misses: LikelihoodRatio(hits, misses),
    "l_of_m": lambda hits, window, misses: LOfM(hits, window),
}

__all__ = ["INITIATIONS", "Evidence", "Initiation", "Verdict"]
