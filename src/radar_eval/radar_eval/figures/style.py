# SPDX-License-Identifier: Apache-2.0
"""Colours and type that all figures share, and how a figure gets into a page."""

from __future__ import annotations

import base64
import io
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import matplotlib as mpl
import numpy as np
import numpy.typing as npt
from matplotlib.figure import Figure

INK, MUTED, FAINT, GRID = "#1f2933", "#66727f", "#b6bfc9", "#e4e8ec"
PLOT_COLOUR, TRACK_COLOUR, BAD_COLOUR = "#8a97a6", "#1769aa", "#c2410c"

NIGHT, NIGHT_LINE, NIGHT_TEXT = "#0a1119", "#24384a", "#8fa6ba"
NIGHT_TRUTH, NIGHT_PLOT, NIGHT_FALSE = "#dfe9f2", "#7fd8a4", "#6c7f92"

# Bright and well apart on the dark ground; neighbours in the list differ most.
TRACK_COLOURS = (
    "#ffb454", "#59c2ff", "#c2d94c", "#ff8f9c", "#95e6cb", "#d2a6ff",
    "#ffd173", "#73b8ff", "#a6cc70", "#f29e74", "#5ccfe6", "#e6b3d3",
)  # fmt: skip

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
    # Without these two the same picture would be another file each time.
    "svg.hashsalt": "radar_eval",
    "svg.fonttype": "path",
}


@contextmanager
def style() -> Iterator[None]:
    """Draw in the style of the report within the context."""
    with mpl.rc_context(_TYPE):
        yield


def as_png(figure: Figure, *, dpi: int = 170) -> bytes:
    """Render a figure as PNG.

    Args:
        figure: to render.
        dpi: dots an inch.

    Returns:
        The file's content.
    """
    return _rendered(figure, "png", dpi=dpi, metadata={"Software": None})


def png_uri(png: bytes) -> str:
    """Write a PNG as an address that holds the picture itself.

    Args:
        png: the file's content.

    Returns:
        A data URI.
    """
    return "data:image/png;base64," + base64.b64encode(png).decode("ascii")


def as_svg(figure: Figure) -> str:
    """Render a figure as SVG to be put into a page.

    Args:
        figure: to render.

    Returns:
        The element, without the XML prologue.
    """
    text = _rendered(figure, "svg", metadata={"Date": None, "Creator": None}).decode("utf-8")
    return text[text.index("<svg") :]


def track_colours(ids: npt.NDArray[np.uint32]) -> list[str]:
    """Give each track a colour that depends on nothing but its identity.

    Args:
        ids: of the tracks, shape (n,).

    Returns:
        Colours, n of them.
    """
    return [TRACK_COLOURS[int(number) % len(TRACK_COLOURS)] for number in ids]


def _rendered(figure: Figure, kind: str, **options: Any) -> bytes:
    buffer = io.BytesIO()
    with style():
        figure.savefig(buffer, format=kind, facecolor=figure.get_facecolor(), **options)
    return buffer.getvalue()
