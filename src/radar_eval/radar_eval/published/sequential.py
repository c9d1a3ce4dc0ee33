# SPDX-License-Identifier: Apache-2.0
"""Wald's sequential test on a steady target (Kuzmin 1967, § 1.3)."""

from __future__ import annotations

import math
from collections.abc import Iterator

from primary_proc.calculators.integration.sequential_analysis import sequential_quality, wald_bounds
from radar_eval.published.result import Row

_AMPLITUDE = 1.5
_MISS = 0.1
# Simulated 60 000 times: P_fa, then its true value, that of P_miss, samples to a decision in noise and on the target.
_SIMULATED = ((1e-3, 6e-4, 0.069, 8.9, 17.6), (1e-2, 0.0057, 0.071, 8.8, 12.2))
_RUNS = 60_000


def sequential_tests() -> Iterator[Row]:
    """Compute bounds, errors and lengths.

    Yields:
        The bounds for one pair of errors, and what two tests really do.
    """
    lower, upper = wald_bounds(1e-3, _MISS)
    at = "P_fa = 0.001, P_miss = 0.1"
    yield Row(f"{at}: A", None, 0.1001, lower, 5.1e-5)
    yield Row(f"{at}: B", None, 900.0, upper, 1e-9)
    yield Row(f"{at}: ln A", None, -2.3016, math.log(lower), 5.1e-5)
    yield Row(f"{at}: ln B", None, 6.8024, math.log(upper), 5.1e-5)
    for false_alarm, true_false_alarm, true_miss, noise_length, target_length in _SIMULATED:
        quality = sequential_quality(_AMPLITUDE, false_alarm, _MISS)
        at = f"P_fa = {false_alarm:g}, P_miss = 0.1, a = 1.5"
        finding = (
            "the ratio mostly jumps over a bound, so both errors are smaller than those asked for"
        )
        yield Row(
            f"{at}: true P_fa", false_alarm, true_false_alarm, quality.false_alarm,
            _sampling(true_false_alarm), finding,
        )  # fmt: skip
        yield Row(
            f"{at}: true P_miss", _MISS, true_miss, quality.miss, _sampling(true_miss), finding
        )
        yield Row(f"{at}: mean samples in noise", None, noise_length, quality.noise_length, 0.1)
        yield Row(f"{at}: mean samples on target", None, target_length, quality.target_length, 0.1)


def _sampling(probability: float) -> float:
    """99.9 % of a simulation's errors are below this."""
    return 3.3 * math.sqrt(probability / _RUNS)
