# SPDX-License-Identifier: Apache-2.0
"""Rules that give plots to tracks, by the name that the parameter `association` gives them."""

from __future__ import annotations

from secondary_proc.association.global_nearest_neighbour import global_nearest_neighbour
from secondary_proc.association.greedy import likelihood, nearest
from secondary_proc.association.interface import Association, GateGraph

ASSOCIATIONS: dict[str, Association] = {
    "global_nearest_neighbour": global_nearest_neighbour,
    "nearest": nearest,
    "likelihood": likelihood,
    "jpda": global_nearest_neighbour,
}
"""Rules by name. Whose plot it is `jpda` decides as the first does; then all plots of the gate move the track."""

SOFT = ("jpda",)
"""Rules that move a track by all plots of its gate, each with its probability."""

__all__ = ["ASSOCIATIONS", "SOFT", "Association", "GateGraph"]
