# SPDX-License-Identifier: Apache-2.0
"""What a message must hold to be a sector of sweeps, and which of its pulses can be used."""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np
import numpy.typing as npt

from radar_common.cloud import TableError, require_finite
from radar_common.health import Health

_NUMBERS = ("azimuth", "time_offset", "range_start", "range_step")
_SAMPLES = tuple(np.dtype(kind) for kind in (np.float32, np.uint8, np.uint16))


def require_sweeps(rows: npt.NDArray[np.void]) -> None:
    """Refuse rows that are no sweeps.

    Args:
        rows: rows of a message.

    Raises:
        TableError: a field is missing or of another type.
    """
    _require_layout(rows.dtype)


@lru_cache(maxsize=8)
def _require_layout(layout: np.dtype[np.void]) -> None:
    """Refuse other layouts; messages of one radar all have the same, so that the answer is remembered."""
    names = layout.names or ()
    for name in _NUMBERS:
        if name not in names or layout[name].newbyteorder("=") != np.float64:
            raise TableError(f"sweeps need a float64 field {name!r}")
    if "video" not in names:
        raise TableError("sweeps need a field 'video' with the range cells of a pulse")
    video = layout["video"]
    if video.base.newbyteorder("=") not in _SAMPLES or len(video.shape) != 1:
        raise TableError(f"video must be cells of float32, uint8 or uint16, not {video}")


def usable_rows(rows: npt.NDArray[np.void], health: Health) -> npt.NDArray[np.void]:
    """Leave out the pulses that have no place in azimuth, time or range.

    Args:
        rows: sweeps.
        health: where the others are counted.

    Returns:
        The usable ones.
    """
    if not len(rows):
        return rows
    # A sum is finite only if all its terms are: one cheap look at what is nearly always good.
    total = sum(float(np.add.reduce(rows[name])) for name in _NUMBERS)
    if math.isfinite(total) and np.minimum.reduce(rows["range_step"]) > 0.0:
        return rows
    good = require_finite(rows, *_NUMBERS) & (rows["range_step"] > 0.0)
    health.drop("pulses without a finite azimuth, time or range", int((~good).sum()))
    return rows[good]
