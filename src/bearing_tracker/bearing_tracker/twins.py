# SPDX-License-Identifier: Apache-2.0
"""Targets that either channel has opened for itself and that are one: found by long agreement, then joined.

A radar that loses a target under jamming finds it again under a new number, perhaps beside the target that the passive
channel has kept; and a strobe may be heard first where the gate did not reach.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from bearing_tracker.bearing_association import assign, gate
from bearing_tracker.fused_targets import FusedTargets

if TYPE_CHECKING:
    from bearing_tracker.fusion_parameters import FusionParameters

IndexArray = npt.NDArray[np.intp]

_SIGMAS = 3.0


def join_twins(
    targets: FusedTargets, heard: IndexArray, channel: int, parameters: FusionParameters
) -> int:
    """Join targets that have long been in one place though either channel sees only one of them.

    The older one stays and takes over the other's identity.

    Args:
        targets: all of them.
        heard: indices of those that a look has just updated, shape (n,).
        channel: of the look.
        parameters: of the fusion.

    Returns:
        Number of pairs joined.
    """
    columns, other = targets.columns, 1 - channel
    silence = columns["time"][:, None] - columns["heard"]
    lonely = (silence > parameters.end_after) & (columns["partner"] == 0)
    lonely &= columns["confirmed"][:, None]
    here = heard[lonely[heard, other]]
    if not len(here):
        return 0
    there = np.setdiff1d(np.flatnonzero(lonely[:, channel]), here)
    now = float(columns["time"][here].mean())
    edges = gate(targets.expected(there, now)[0], targets.expected(here, now)[0], _SIGMAS)
    chosen = assign(edges)
    first, second = there[edges.target[chosen]], here[edges.bearing[chosen]]
    again = columns["twin"][second] == columns["id"][first]
    agreed = np.where(again, columns["agreed"][second], 0) + 1
    columns["twin"][here] = columns["agreed"][here] = 0
    columns["twin"][second], columns["agreed"][second] = columns["id"][first], agreed
    same = agreed >= parameters.join_after
    if not same.any():
        return 0
    # Targets stand in order of age.
    kept, gone = np.sort(np.stack([first[same], second[same]]), axis=0)
    for name in ("partner", "heard"):
        columns[name][kept] = np.maximum(columns[name][kept], columns[name][gone])
    ranged = np.isnan(columns["range"][kept])
    for name in ("range", "ranged", "closing_speed"):
        columns[name][kept[ranged]] = columns[name][gone[ranged]]
    columns["twin"][kept] = columns["agreed"][kept] = columns["misfits"][kept] = 0
    mask = np.zeros(len(columns), bool)
    mask[gone] = True
    targets.remove(mask)
    return len(gone)
