# SPDX-License-Identifier: Apache-2.0
"""Rules that give plots to tracks, by the name that the parameter `association` gives them."""

from __future__ import annotations

from secondary_proc.association.global_nearest_neighbour import global_nearest_neighbour
from secondary_proc.association.interface import Association, GateGraph

ASSOCIATIONS: dict[str, Association] = {"global_nearest_neighbour": global_nearest_neighbour}

__all__ = ["ASSOCIATIONS", "Association", "GateGraph"]
