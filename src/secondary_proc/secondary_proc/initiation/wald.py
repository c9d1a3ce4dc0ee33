# SPDX-License-Identifier: Apache-2.0
"""Wald's sequential test on hits and misses alone: where in its gate a plot lies does not count.

Source: Wald 1947; Kuzmin 1967, § 4.3.2, (4.14). A hit multiplies the likelihood ratio by p_d / p_a with p_a of the
track's own gate among the false plots measured there. A miss multiplies it by 1 - p_d; the 1 - p_a under it is left
out, as that makes false tracks fewer than promised and costs targets nothing while gates are mostly empty.
"""

from __future__ import annotations

from math import inf, log, log1p
from typing import TYPE_CHECKING

import numpy as np

from secondary_proc.initiation.drop import lowest_score
from secondary_proc.initiation.interface import Evidence, FloatArray, IntArray, Verdict

if TYPE_CHECKING:
    from secondary_proc.parameters import TrackerParameters


class Wald:
    """Sequential test on hits, for errors of plots that cannot be trusted in detail."""

    def __init__(self, parameters: TrackerParameters) -> None:
        """Set the bounds.

        Args:
            parameters: `missed_targets` sets the lower bound, `false_tracks_per_hour` the upper one.
        """
        self._hits = parameters.confirm_hits
        self._log_detection = log(parameters.detection_probability)
        self._half_size_squared = parameters.gate_sigmas**2
        self._allowance = log1p(-parameters.missed_targets)
        by_misses = parameters.drop_rule == "misses"
        self._floor = -inf if by_misses else lowest_score(parameters.missed_targets)
        self._misses = parameters.tentative_misses if by_misses else inf
        self.longest_gap = parameters.tentative_misses

    def hit_gain(self, determinant: FloatArray, density: FloatArray) -> FloatArray:
        """Gain of the score by any plot in the gate.

        Args:
            determinant: of the covariance of the predicted difference, m^4, shape (n,).
            density: false plots per square metre, shape (n,).

        Returns:
            ln(p_d / p_a), shape (n,).
        """
        mean = np.pi * self._half_size_squared * np.sqrt(determinant) * density
        gain: FloatArray = self._log_detection - np.log(-np.expm1(-mean))
        return gain

    def opened(self, gap: IntArray) -> IntArray:
        """Memory of tracks that have just been opened by two plots.

        Args:
            gap: turns of the antenna between both plots, 1 to longest_gap, shape (n,).

        Returns:
            Zeros, shape (n,): the score is memory enough.
        """
        return np.zeros(len(gap), np.intp)

    def judge(self, evidence: Evidence) -> Verdict:
        """Take one more scan into account.

        Args:
            evidence: the tracks after the scan.

        Returns:
            The decision about each.
        """
        # B is (1 - P_miss) / P_false; the tracker's threshold is its denominator.
        sure = evidence.score >= evidence.threshold + self._allowance
        confirmed = evidence.found & sure & (evidence.hits >= self._hits)
        dropped = (evidence.misses >= self._misses) | (evidence.score <= self._floor)
        return Verdict(evidence.rule, confirmed, dropped & ~confirmed)
