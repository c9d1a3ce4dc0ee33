# SPDX-License-Identifier: Apache-2.0
"""The second threshold: how many ones of a rectangular burst make a detection, and what each choice costs."""

from __future__ import annotations

import math

import numpy as np

from primary_proc.calculators.integration.binary_integration import required_snr_db


def kuzmin_threshold(pulses: float) -> int:
    """Count of ones near the optimum for bursts of ten to some tens of pulses.

    Source: Kuzmin 1967, (3.17): 1.5 sqrt(N_0).

    Args:
        pulses: N_0.

    Returns:
        Nearest whole number, at least 1.
    """
    return max(1, round(1.5 * math.sqrt(pulses)))


def best_threshold(
    pulses: int, false_alarm: float, detection: float, target: str = "steady"
) -> int:
    """Count of ones that needs the least signal.

    Args:
        pulses: N_0, the burst being rectangular and just filling the window.
        false_alarm: probability that noise alone reaches the count in one window, (3.14).
        detection: wanted probability (3.13).
        target: name in `TARGETS`.

    Returns:
        The count, 1 to N_0.
    """
    counts = range(1, pulses + 1)
    needed = [required_snr_db(pulses, c, false_alarm, detection, target) for c in counts]
    return counts[int(np.argmin(needed))]
