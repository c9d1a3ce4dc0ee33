# SPDX-License-Identifier: Apache-2.0
"""What gates and initiation are expected to do among false plots, by calculation instead of trial."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from radar_common.frames import TWO_PI, enu_covariance
from secondary_proc.calculators.rule_chain import CONFIRMED, IDLE, StateArray, rule_chain
from secondary_proc.motion import (
    FloatArray,
    predict_covariance,
    predict_position_covariance,
    two_point_state,
)
from secondary_proc.smoothing import joseph_update

_STEPS = 200


def gate_probability(sigmas: float) -> float:
    """Probability that the plot of a target lies in its elliptical gate.

    Args:
        sigmas: half axis of the gate in standard deviations.

    Returns:
        1 - exp(-sigmas^2 / 2).
    """
    return float(-np.expm1(-(sigmas**2) / 2.0))


def correct_selection(density: FloatArray, determinant: FloatArray) -> FloatArray:
    """Probability that the nearest plot is the target's own.

    Source: Kuzmin 1967, (4.149).

    Args:
        density: false plots per square metre, shape (n,).
        determinant: of the covariance of the predicted difference, m^4, shape (n,).

    Returns:
        Probability, shape (n,).
    """
    return 1.0 / (1.0 + TWO_PI * density * np.sqrt(determinant))


@dataclass(frozen=True, kw_only=True)
class FalsePlots:
    """False plots at equal rate in range and azimuth (Kuzmin 1967, 4.10), and how they are searched.

    Attributes:
        per_scan: number in a turn of the antenna.
        nearest: least range, metres.
        farthest: greatest range, metres.
        range_std: error that they tell, metres.
        azimuth_std: error that they tell, radians.
        period: of the antenna, seconds.
        maximum_speed: outer radius of the annulus per second, m/s; the inner one is zero.
        sigmas: half axis of the gate in standard deviations.
        quiet_density: process noise when a track is opened, m^2/s^3.
        gate_density: process noise that the gates stay open for, m^2/s^3.
    """

    per_scan: float
    nearest: float
    farthest: float
    range_std: float
    azimuth_std: float
    period: float
    maximum_speed: float
    sigmas: float
    quiet_density: float
    gate_density: float

    def density(self, ranges: FloatArray) -> FloatArray:
        """Density by place.

        Args:
            ranges: metres, shape (n,).

        Returns:
            False plots per square metre and scan, shape (n,).
        """
        return self.per_scan / (self.farthest - self.nearest) / (TWO_PI * ranges)


def false_tracks_handed_over(
    false: FalsePlots, hits: int = 3, window: int = 4, drop_misses: int | None = None
) -> float:
    """Tracks of false plots alone that a rule l/m confirms.

    The paths of the rule's automaton from the first plot to confirmation, as in Kuzmin 1967, (4.25), but each gate with
    its own area as the tracker draws it, and every plot of the annulus as a candidate of its own (§ 4.3.1), for a
    density so low that candidates do not take each other's plots.

    Args:
        false: the plots and the gates.
        hits: plots needed, l, at least 2.
        window: scans in which they must fall, m.
        drop_misses: misses in a row after which a candidate is given up; None leaves it to the rule alone.

    Returns:
        Confirmed false tracks per scan.

    Raises:
        ValueError: there is no such rule.
    """
    if hits < 2:
        raise ValueError("a track needs two plots at least")
    chain = rule_chain(hits, window, drop_misses)
    edges = np.linspace(false.nearest, false.farthest, _STEPS + 1)
    search = _Search(false, (edges[1:] + edges[:-1]) / 2.0, chain)
    # The few that live longer add nothing that a trial would show; the book stops at one window.
    longest = 2 * window
    expected = np.zeros(_STEPS)
    alone = np.ones(_STEPS)
    state, gap = int(chain[IDLE, 1]), 1
    while state != IDLE:
        candidates = search.density * _annulus(false, search.ranges, gap)
        track = search.opened(gap)
        confirmed = search.confirmed(int(chain[state, 1]), track, 1, longest - gap)
        expected += alone * candidates * confirmed
        # A first plot that found its second in one turn takes none in a later one.
        alone = alone * np.exp(-candidates)
        state, gap = int(chain[state, 0]), gap + 1
    return float(false.per_scan * expected.mean())


class _Search:
    """Candidates among false plots, at all ranges at once."""

    def __init__(self, false: FalsePlots, ranges: FloatArray, chain: StateArray) -> None:
        each = np.ones(len(ranges))
        self._false, self._chain, self._each = false, chain, each
        self.ranges = ranges
        self.density = false.density(ranges)
        self._error = enu_covariance(
            ranges, 0.0 * each, false.range_std * each, false.azimuth_std * each
        )

    def opened(self, gap: int) -> FloatArray:
        """Covariance of a candidate's state after two plots, so many turns apart."""
        place = np.zeros((len(self._each), 2))
        seconds = gap * self._false.period * self._each
        return two_point_state(
            place, self._error, place, self._error, seconds, self._false.quiet_density
        )[1]

    def confirmed(self, state: int, covariance: FloatArray, wait: int, scans: int) -> FloatArray:
        """Probability that a candidate is confirmed yet, its last plot so many turns ago, within some scans."""
        if state in (IDLE, CONFIRMED) or not scans:
            return self._each * (state == CONFIRMED)
        seconds = wait * self._false.period * self._each
        gate = self._error + predict_position_covariance(
            covariance, seconds, self._false.gate_density
        )
        area = np.pi * self._false.sigmas**2 * np.sqrt(np.linalg.det(gate))
        found = -np.expm1(-self.density * area)
        moved = predict_covariance(covariance, seconds, self._false.quiet_density)
        gain = moved[:, :, :2] @ np.linalg.inv(moved[:, :2, :2] + self._error)
        after = joseph_update(moved, gain, self._error)
        miss, hit = self._chain[state].tolist()
        return np.asarray(
            found * self.confirmed(hit, after, 1, scans - 1)
            + (1.0 - found) * self.confirmed(miss, covariance, wait + 1, scans - 1)
        )


def _annulus(false: FalsePlots, ranges: FloatArray, gap: int) -> FloatArray:
    direction = np.linspace(0.0, TWO_PI, 180, endpoint=False)
    along = 2.0 * false.range_std**2 * np.cos(direction) ** 2
    across = 2.0 * (ranges[:, None] * false.azimuth_std) ** 2 * np.sin(direction) ** 2
    radius = false.maximum_speed * gap * false.period + false.sigmas * np.sqrt(along + across)
    return np.pi * np.mean(radius**2, axis=1)
