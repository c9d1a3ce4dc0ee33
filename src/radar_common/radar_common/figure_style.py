# SPDX-License-Identifier: Apache-2.0
"""Colours and type that all figures of the chain share; only what draws imports it, a node never does."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import matplotlib as mpl
from cycler import cycler

INK, MUTED, FAINT, GRID = "#1f2933", "#66727f", "#b6bfc9", "#e4e8ec"
LINES = ("#1769aa", "#c2410c", "#2f855a", "#7c4dbe", "#b7791f", "#0f8a94", "#b83280", "#66727f")
"""Colours of curves beside each other, well apart also in their lightness."""

_TYPE: Any = {
    "font.family": "sans-serif",
    "font.sans-serif": ["DejaVu Sans"],
    "font.size": 9.0,
    "text.color": INK,
    "axes.edgecolor": FAINT,
    "axes.labelcolor": MUTED,
    "axes.linewidth": 0.8,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "axes.titlesize": 9.5,
    "axes.titlelocation": "left",
    "axes.titlecolor": INK,
    "grid.color": GRID,
    "grid.linewidth": 0.7,
    "xtick.color": MUTED,
    "ytick.color": MUTED,
    "xtick.major.size": 0.0,
    "ytick.major.size": 0.0,
    "legend.frameon": False,
    "legend.fontsize": 8.5,
    "lines.linewidth": 1.4,
    "axes.prop_cycle": cycler(color=LINES),
    # Without these two the same picture would be another file each time.
    "svg.hashsalt": "radar",
    "svg.fonttype": "path",
}


@contextmanager
def style() -> Iterator[None]:
    """Draw in the style of the chain within the context."""
    with mpl.rc_context(_TYPE):
        yield
