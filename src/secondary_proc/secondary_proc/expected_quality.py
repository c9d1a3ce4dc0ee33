# SPDX-License-Identifier: Apache-2.0
"""What gates and initiation are expected to do among false plots, by calculation instead of trial."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from radar_common.frames import TWO_PI, enu_covariance
from secondary_proc.motion import FloatArray, predict_position_covariance, two_point_state

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


def false_tracks_handed_over(false: FalsePlots) -> float:
    """Tracks of false plots alone that the rule 3/4 confirms.

    The paths 111, 1101 and 1011 of Kuzmin 1967, (4.25), each gate with its own area as the tracker draws it, for a
    density so low that few gates hold a plot.

    Args:
        false: the plots and the gates.

    Returns:
        Confirmed false tracks per scan.
    """
    edges = np.linspace(false.nearest, false.farthest, _STEPS + 1)
    ranges = (edges[1:] + edges[:-1]) / 2.0
    density = false.density(ranges)
    annulus = {gap: density * _annulus(false, ranges, gap) for gap in (1, 2)}
    near = density * _gate(false, ranges, first_gap=1, wait=1)
    after_miss = density * _gate(false, ranges, first_gap=1, wait=2)
    after_gap = density * _gate(false, ranges, first_gap=2, wait=1)
    expected = annulus[1] * (near + np.exp(-near) * after_miss)
    expected += np.exp(-annulus[1]) * annulus[2] * after_gap
    return float(false.per_scan * expected.mean())


def _annulus(false: FalsePlots, ranges: FloatArray, gap: int) -> FloatArray:
    direction = np.linspace(0.0, TWO_PI, 180, endpoint=False)
    along = 2.0 * false.range_std**2 * np.cos(direction) ** 2
    across = 2.0 * (ranges[:, None] * false.azimuth_std) ** 2 * np.sin(direction) ** 2
    radius = false.maximum_speed * gap * false.period + false.sigmas * np.sqrt(along + across)
    return np.pi * np.mean(radius**2, axis=1)


def _gate(false: FalsePlots, ranges: FloatArray, *, first_gap: int, wait: int) -> FloatArray:
    each = np.ones(len(ranges))
    error = enu_covariance(ranges, 0.0 * each, false.range_std * each, false.azimuth_std * each)
    place = np.zeros((len(ranges), 2))
    _, covariance = two_point_state(
        place, error, place, error, first_gap * false.period * each, false.quiet_density
    )
    expected = error + predict_position_covariance(
        covariance, wait * false.period * each, false.gate_density
    )
    return np.pi * false.sigmas**2 * np.sqrt(np.linalg.det(expected))
