# SPDX-License-Identifier: Apache-2.0
"""What ends a tentative track: its own rule, misses in a row, or a score too low.

Source: Kuzmin 1967, § 4.3.4, for k misses in a row, and after (4.14) for the lower bound of the likelihood ratio.
"""

from __future__ import annotations

from math import log

from secondary_proc.calculators.hit_sequence import wald_bounds

DROP_RULES = ("rule", "misses", "score")

_FALSE_CANDIDATES = 1e-6
"""Share of them that is confirmed: anything so small, as the lower bound hardly hangs on it."""


def lowest_score(missed_targets: float) -> float:
    """Score at which a candidate is given up.

    Args:
        missed_targets: share of the targets' candidates that may be lost by it.

    Returns:
        Logarithm of Wald's lower bound A.
    """
    return log(wald_bounds(_FALSE_CANDIDATES, missed_targets)[0])
