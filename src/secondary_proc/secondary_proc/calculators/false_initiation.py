# SPDX-License-Identifier: Apache-2.0
"""Tracks of false plots: how many are being initiated, and how many are handed over to tracking.

Source: Kuzmin 1967, § 4.3.3, (4.16)-(4.25). Sequences that outlive the rule's window are neglected, as there.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from secondary_proc.calculators.rule_chain import CONFIRMED, IDLE, FloatArray, rule_chain, step


def occupied_gate(mean: npt.ArrayLike) -> FloatArray:
    """Probability that a gate holds a false plot.

    Args:
        mean: false plots in the gate, density times area (nu_0 N_a), any shape.

    Returns:
        p_a = 1 - exp(-mean), same shape.
    """
    return np.asarray(-np.expm1(-np.asarray(mean, dtype=float)))


@dataclass(frozen=True, slots=True)
class FalseInitiation:
    """The steady state, each number per false plot of a scan.

    Attributes:
        started: tracks that begin, N_1 of (4.18).
        tentative: tracks that are being initiated, those just confirmed included, N_sigma of (4.21).
        handed_over: tracks that are confirmed, (4.22), (4.23), (4.25).
    """

    started: float
    tentative: float
    handed_over: float


def false_initiation(
    hits: int, window: int, found: npt.ArrayLike, drop_misses: int | None = None
) -> FalseInitiation:
    """Follow tracks from their first plot to confirmation or drop; a plot in no gate starts a track.

    Args:
        hits: plots needed, l.
        window: scans in which they must fall, m.
        found: p_a, that a gate holds a false plot; one for all gates, or by scans since the first plot, shape
            (window - 1,), as the annulus of the second plot is larger than the gates behind it.
        drop_misses: misses in a row after which a tentative track is given up.

    Returns:
        The numbers per false plot.

    Raises:
        ValueError: there is no such rule, or there are more or fewer gates than scans.
    """
    alive, confirmed = _ages(hits, window, found, drop_misses)
    gates = np.broadcast_to(np.asarray(found, dtype=float), window - 1)
    # The oldest tracks have one gate more; it takes plots like the one before.
    gates = np.append(gates, gates[-1])
    started = 1.0 / (1.0 + float(gates @ alive))
    return FalseInitiation(started, started * float(alive.sum()), started * float(confirmed.sum()))


def initiation_build_up(
    hits: int, window: int, found: float, scans: int, drop_misses: int | None = None
) -> tuple[FloatArray, FloatArray]:
    """Numbers from the first scan on, when there are no tracks yet.

    Source: (4.17), (4.18), (4.20).

    Args:
        hits: plots needed, l.
        window: scans in which they must fall, m.
        found: p_a, that a gate holds a false plot.
        scans: number of scans.
        drop_misses: misses in a row after which a tentative track is given up.

    Returns:
        (tentative tracks, tracks handed over), each per false plot of a scan, shape (scans,).

    Raises:
        ValueError: there is no such rule.
    """
    alive, confirmed = _ages(hits, window, found, drop_misses)
    started, tentative, handed_over = np.zeros((3, scans))
    for scan in range(scans):
        started[scan] = 1.0 - found * (tentative[scan - 1] if scan else 0.0)
        ages = min(scan + 1, len(alive))
        recent = started[scan - ages + 1 : scan + 1][::-1]
        tentative[scan] = recent @ alive[:ages]
        handed_over[scan] = recent @ confirmed[:ages]
    return tentative, handed_over


def runs_handed_over(length: int, found: npt.ArrayLike) -> FloatArray:
    """False tracks per false plot of the rule m/m in closed form, from (4.21) and (4.23).

    Args:
        length: m.
        found: p_a in [0, 1), any shape.

    Returns:
        p^(m-1) (1 - p) / (1 - p^(m+1)), same shape.
    """
    p = np.asarray(found, dtype=float)
    return np.asarray(p ** (length - 1) * (1.0 - p) / (1.0 - p ** (length + 1)))


def _ages(
    hits: int, window: int, found: npt.ArrayLike, drop_misses: int | None
) -> tuple[FloatArray, FloatArray]:
    """Tracks there are, and those just confirmed, by scans since their first plot, per track."""
    if window < 2:
        raise ValueError("a rule of one scan follows no track")
    chain = rule_chain(hits, window, drop_misses)
    gates = np.asarray(found, dtype=float)
    if gates.ndim and len(gates) != window - 1:
        raise ValueError(f"{len(gates)} gates for {window - 1} scans")
    gates = np.broadcast_to(gates, window - 1)
    state = np.zeros(len(chain))
    state[chain[IDLE, 1]] = 1.0
    alive, confirmed = np.zeros((2, window))
    for age in range(window):
        confirmed[age] = state[CONFIRMED]
        state[IDLE] = 0.0
        # A track still counts in the scan of its confirmation, as its next gate takes plots too.
        alive[age] = state.sum()
        state[CONFIRMED] = 0.0
        if age < window - 1:
            state = step(chain, state, gates[age])
    return alive, confirmed
