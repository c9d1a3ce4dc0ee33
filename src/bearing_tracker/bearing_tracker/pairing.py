# SPDX-License-Identifier: Apache-2.0
"""Which target a look's bearings belong to, by the sensor's identities and, where these do not tell, by gates.

An identity of a passive sensor is no number of a track. Which target it speaks of is found once, by gate and
assignment, and kept until its bearings stay on one side of the target's for too long.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from bearing_tracker.bearing_association import Directions, Edges, assign, gate
from bearing_tracker.fused_targets import FusedTargets
from radar_common.health import Health
from radar_common.tables import BearingChannel

if TYPE_CHECKING:
    from bearing_tracker.fusion_parameters import FusionParameters

IndexArray = npt.NDArray[np.intp]
Rows = npt.NDArray[np.void]

_ALLOWANCE = 1.0
"""Seconds of flight that the errors of two ranges may amount to."""


def pair(
    targets: FusedTargets, look: Rows, parameters: FusionParameters, health: Health
) -> IndexArray:
    """Give the bearings of a look to targets; an identity stays with the target that it gets.

    Args:
        targets: all of them.
        look: dtype SIGHTING, all of one channel, each identity once, shape (n,).
        parameters: of the fusion.
        health: where events are counted.

    Returns:
        Index of the target of each bearing, -1 where there is none, each target once, shape (n,).
    """
    columns, channel = targets.columns, int(look["channel"][0])
    target = targets.of_identities(look["id"], channel)
    known = target[target >= 0]
    misled = known[np.abs(columns["misfits"][known, channel]) >= parameters.release_after]
    if len(misled):
        health.count("identities parted from their targets", len(misled))
        columns["partner"][misled, channel] = 0
        columns["misfits"][misled, channel] = 0
        target[np.isin(target, misled)] = -1
    loose = np.flatnonzero(target < 0)
    taken = np.zeros(len(columns), bool)
    # Else a parted identity would at once find the same target again.
    taken[known] = True
    free = np.flatnonzero(~taken)
    if not len(loose) or not len(free):
        return target
    bearings = look[loose]
    expected, jammed = targets.expected(free, float(look["time"].mean()))
    if channel == BearingChannel.ACTIVE:
        # A jammed radar is still its target's: the gate is as wide as the errors that may be.
        widening = jammed * (parameters.jammed_factor**2 - 1.0)
        usual = float(np.median(bearings["azimuth_std"]))
        expected = Directions(expected.azimuth, np.sqrt(expected.std**2 + widening * usual**2))
    reported = Directions(bearings["azimuth"], bearings["azimuth_std"])
    edges = gate(expected, reported, parameters.gate_sigmas)
    # A target that has an identity in this channel takes no bearing of another one.
    partner = columns["partner"][free, channel]
    open_to = (bearings["id"][edges.bearing] == 0) | (partner[edges.target] == 0)
    open_to &= _reachable(columns[free[edges.target]], bearings[edges.bearing], parameters.fastest)
    edges = Edges(edges.target[open_to], edges.bearing[open_to], edges.cost[open_to])
    # Where directions cross, a bearing is of what the channel has lately reported, not of what it has yet to see.
    lately = look["time"].mean() - columns["heard"][free, channel] <= parameters.end_after
    rank = columns["confirmed"][free] * (1 + lately)
    chosen = assign(edges, rank[edges.target])
    row, which = loose[edges.bearing[chosen]], free[edges.target[chosen]]
    target[row] = which
    named = look["id"][row] != 0
    columns["partner"][which[named], channel] = look["id"][row[named]]
    columns["misfits"][which[named], channel] = 0
    return target


def _reachable(targets: Rows, bearings: Rows, fastest: float) -> npt.NDArray[np.bool_]:
    """Say which bearings may be of their targets by range, where both ranges are known."""
    seconds = np.abs(bearings["time"] - targets["ranged"]) + _ALLOWANCE
    return ~(np.abs(bearings["range"] - targets["range"]) > fastest * seconds)
