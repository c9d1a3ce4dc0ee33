# SPDX-License-Identifier: Apache-2.0
"""Probability that a target's track is confirmed, and when.

Source: Kuzmin 1967, § 4.3.5, (4.35)-(4.37), by stepping the rule's automaton, which is exact for any l, m and k.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from secondary_proc.calculators.rule_chain import CONFIRMED, IDLE, FloatArray, rule_chain, step


def track_detection(
    found: FloatArray, hits: int, window: int, drop_misses: int | None = None
) -> FloatArray:
    """Probability that the track is confirmed by the end of each scan.

    Args:
        found: probability of the target's plot in each scan, shape (scans, ...).
        hits: plots needed, l.
        window: scans in which they must fall, m.
        drop_misses: misses in a row after which a tentative track is given up, k.

    Returns:
        Probability P_i of (4.35), same shape.

    Raises:
        ValueError: there is no such rule.
    """
    chain = rule_chain(hits, window, drop_misses)
    state = np.zeros((len(chain), *found.shape[1:]))
    state[IDLE] = 1.0
    confirmed = np.empty(found.shape)
    for scan, probability in enumerate(found):
        state = step(chain, state, probability)
        confirmed[scan] = state[CONFIRMED]
    return confirmed


def printed_track_detection(found: FloatArray, hits: int, window: int) -> FloatArray:
    """The same by the book's recurrences: right for m/m; for 3/4 up to the sixth scan, too large from then on.

    Source: (4.36), (4.37).

    Args:
        found: probability of a plot in each scan, shape (scans,).
        hits: plots needed.
        window: scans in which they must fall.

    Returns:
        Sum of the increments, shape (scans,).

    Raises:
        ValueError: the rule is neither m/m nor 3/4.
    """
    if hits != window and (hits, window) != (3, 4):
        raise ValueError(f"there is no recurrence for {hits}/{window}")
    # Scans before the first: no plot, nothing confirmed.
    before = window + 3
    p = np.concatenate([np.zeros(before), found])
    q = 1.0 - p
    total = np.zeros(len(p))
    for i in range(before, len(p)):
        if hits == window:
            rise = p[i - window + 1 : i + 1].prod() * q[i - window] * (1 - total[i - window - 1])
        else:
            rise = p[i] * p[i - 1] * p[i - 2] * q[i - 3] * q[i - 4]
            rise += p[i] * p[i - 1] * q[i - 2] * p[i - 3] * q[i - 4]
            rise += p[i] * q[i - 1] * p[i - 2] * p[i - 3] * q[i - 4] * q[i - 5]
            rise *= 1.0 - total[i - 6]
        total[i] = total[i - 1] + rise
    return total[before:]


def approach(speed: float, scans: int, start: float = 1.0) -> FloatArray:
    """Ranges of a target that flies straight at the radar.

    Args:
        speed: v_d T_0, range lost in a scan over the farthest range; negative where the target flies away.
        scans: number of scans.
        start: range in the first scan.

    Returns:
        d_i, shape (scans,); those not positive are left out, as the target has passed.
    """
    ranges = start - speed * np.arange(scans)
    return np.asarray(ranges[ranges > 0.0], dtype=float)


def confirmation_delay(
    found: npt.ArrayLike, hits: int, window: int, drop_misses: int | None = None
) -> FloatArray:
    """Mean scans from the target's first plot to the confirmation of its track.

    A track that is dropped begins anew, so this is finite for any probability above zero.

    Args:
        found: probability of the target's plot, the same in all scans, in (0, 1], any shape.
        hits: plots needed, l.
        window: scans in which they must fall, m.
        drop_misses: misses in a row after which a tentative track is given up, k.

    Returns:
        Scans after the one of the first plot, same shape.

    Raises:
        ValueError: there is no such rule.
    """
    chain = rule_chain(hits, window, drop_misses)
    probability = np.asarray(found, dtype=float)
    states = len(chain)
    moves = np.zeros((*probability.shape, states, states))
    rows = np.arange(states)
    for symbol, weight in ((0, 1.0 - probability), (1, probability)):
        moves[..., rows, chain[:, symbol]] += weight[..., None]
    transient = np.delete(rows, CONFIRMED)
    inside = moves[..., transient[:, None], transient]
    ones = np.ones((*probability.shape, states - 1, 1))
    scans = np.linalg.solve(np.eye(states - 1) - inside, ones)[..., 0]
    first = chain[IDLE, 1]
    if first == CONFIRMED:
        return np.zeros(probability.shape)
    return np.asarray(scans[..., np.flatnonzero(transient == first)[0]])


def scans_until(confirmed: FloatArray, probability: float) -> int | None:
    """Scan by whose end a track is confirmed with a given probability.

    Args:
        confirmed: from `track_detection`, shape (scans,).
        probability: wanted.

    Returns:
        Index of the scan; None where it is not reached.
    """
    reached = np.flatnonzero(confirmed >= probability)
    return int(reached[0]) if len(reached) else None
