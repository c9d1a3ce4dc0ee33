# SPDX-License-Identifier: Apache-2.0
"""Wald's sequential test of a tentative track on hits and misses: its bounds and what it really does.

Source: A. Wald, Sequential Analysis, 1947; Kuzmin 1967, § 4.3.2, (4.13), (4.14). A hit multiplies the likelihood ratio
by p_d / p_a, a miss by (1 - p_d) / (1 - p_a).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from secondary_proc.calculators.rule_chain import FloatArray


@dataclass(frozen=True, slots=True)
class HitTest:
    """A test, followed scan by scan; the first plot, which starts the track, is not counted.

    Attributes:
        confirmed: probability that the track is confirmed by the end of each scan, shape (scans,).
        dropped: probability that it is dropped by then, shape (scans,).
        mean_scans: scans to the decision; those undecided at the end count as if they ended there.
    """

    confirmed: FloatArray
    dropped: FloatArray
    mean_scans: float


def wald_bounds(false_track: float, missed_track: float) -> tuple[float, float]:
    """Bounds of the likelihood ratio.

    Source: A and B after (4.14).

    Args:
        false_track: probability to confirm a track of false plots.
        missed_track: probability to drop a target's.

    Returns:
        (A, below which a track is dropped, B, above which it is confirmed).

    Raises:
        ValueError: the errors are not positive, or their sum is one or more.
    """
    if min(false_track, missed_track) <= 0.0 or false_track + missed_track >= 1.0:
        raise ValueError(f"no test has the errors {false_track:g} and {missed_track:g}")
    return missed_track / (1.0 - false_track), (1.0 - missed_track) / false_track


def follow_hit_test(
    found: float, detection: float, occupied: float, bounds: tuple[float, float], scans: int
) -> HitTest:
    """Follow the test exactly; the ratio after a scan hangs on the number of hits alone.

    Args:
        found: true probability of a plot in the gate: p_d for a target, p_a for false plots.
        detection: p_d that the test assumes.
        occupied: p_a that it assumes, below p_d.
        bounds: A and B.
        scans: after which following ends.

    Returns:
        What the test does.

    Raises:
        ValueError: p_a is not below p_d, or one of them is not inside (0, 1).
    """
    if not 0.0 < occupied < detection < 1.0:
        raise ValueError(f"no test tells p_d = {detection:g} from p_a = {occupied:g}")
    hit = np.log(detection / occupied)
    miss = np.log((1.0 - detection) / (1.0 - occupied))
    low, high = np.log(bounds)
    state = np.zeros(scans + 1)
    state[0] = 1.0
    hits = np.arange(scans + 1)
    confirmed, dropped = np.zeros((2, scans))
    length = 0.0
    for scan in range(scans):
        length += state.sum()
        state = (1.0 - found) * state + found * np.append(0.0, state[:-1])
        ratio = hits * hit + (scan + 1 - hits) * miss
        confirmed[scan], dropped[scan] = state[ratio >= high].sum(), state[ratio <= low].sum()
        state[(ratio >= high) | (ratio <= low)] = 0.0
    return HitTest(np.cumsum(confirmed), np.cumsum(dropped), float(length))
