# SPDX-License-Identifier: Apache-2.0
"""Colours of plots and tracks, and how a figure gets into a page."""

from __future__ import annotations

import base64
import io
from typing import Any

import numpy as np
import numpy.typing as npt
from matplotlib.figure import Figure

from radar_common.figure_style import FAINT, GRID, INK, MUTED, style

__all__ = ["FAINT", "GRID", "INK", "MUTED", "style"]

PLOT_COLOUR, TRACK_COLOUR, BAD_COLOUR = "#8a97a6", "#1769aa", "#c2410c"

NIGHT, NIGHT_LINE, NIGHT_TEXT = "#0a1119", "#24384a", "#8fa6ba"
NIGHT_TRUTH, NIGHT_PLOT, NIGHT_FALSE = "#dfe9f2", "#7fd8a4", "#6c7f92"

# Bright and well apart on the dark ground; neighbours in the list differ most.
TRACK_COLOURS = (
    "#ffb454", "#59c2ff", "#c2d94c", "#ff8f9c", "#95e6cb", "#d2a6ff",
    "#ffd173", "#73b8ff", "#a6cc70", "#f29e74", "#5ccfe6", "#e6b3d3",
)  # fmt: skip


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
