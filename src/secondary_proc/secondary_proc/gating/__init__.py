# SPDX-License-Identifier: Apache-2.0
"""Sizes of gates, and how surely what is selected in them is the target's own."""

from __future__ import annotations

from secondary_proc.gating.selection_watch import SelectionWatch
from secondary_proc.gating.sharp_turns import SharpTurns, usual_first
from secondary_proc.gating.three_sizes import narrowed

GATE_SHAPES = ("ellipse", "three_sizes")
"""One ellipse wide enough for a manoeuvre, or the smallest of three that holds a plot."""

__all__ = ["GATE_SHAPES", "SelectionWatch", "SharpTurns", "narrowed", "usual_first"]
