# SPDX-License-Identifier: Apache-2.0
"""From how often clutter makes bursts at low criteria to the criterion at which it makes as few as wanted.

A zone of clutter has R resolution cells, and in each the echo stays nearly the same while the beam passes. Bursts over
the criterion T then number N(T) = R exp(-(T / mu)^k) for clutter whose power is Weibull distributed: k = 1 for the
Rayleigh clutter of § 1.2, smaller where it is spiky. Two points of N(T) where bursts are many give mu and k, and these
the T with the wanted number. What noise alone would add to N(T) is known and taken off first, and so are targets.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]

STEP_DB = 2.0
LEVELS_DB: FloatArray = np.arange(-6.0, 17.0, STEP_DB)
"""Criteria at which bursts are counted, dB over the criterion of the design."""

_TARGET_LEVELS = 3
_FEWEST, _FEW, _MANY = 4.0, 12.0, 32.0
_SIGNIFICANT = 4.0
_DESIGN_SHARE = 4.0
_DENSEST = 0.4
_LEAST_COUNT = 0.1
_LEAST_SHAPE, _LARGEST_SHAPE = 0.25, 4.0


def needed_raise_db(
    counts: FloatArray, noise: FloatArray, wanted: FloatArray, resolution_cells: FloatArray
) -> FloatArray:
    """Find how far above the design the criterion must lie for clutter to make the wanted bursts.

    A burst that would still be seen 6 dB higher is taken for a target. The points are where 32 and 12 bursts remain, so
    that single targets and small formations of weak ones do not look like clutter; where clutter fills so little of a
    zone that it never makes 32, they are at 12 and 4.

    Args:
        counts: mean bursts of a zone in a turn at each of LEVELS_DB, shape (zones, levels).
        noise: the same as noise alone makes it, shape (zones, levels).
        wanted: bursts of a zone in a turn that noise makes by design, shape (zones,).
        resolution_cells: R, shape (zones,).

    Returns:
        dB, shape (zones,); zero where it is not higher, infinite where clutter fills the zone at all levels.
    """
    seen, chance = (n[:, :-_TARGET_LEVELS] - n[:, _TARGET_LEVELS:] for n in (counts, noise))
    excess = np.where(seen - chance > _SIGNIFICANT * np.sqrt(chance), seen - chance, 0.0)
    scale = 1.0 + _DESIGN_SHARE * wanted / _FEW
    few, many, fewest = (number * scale for number in (_FEW, _MANY, _FEWEST))
    middle, filled = _crossing_db(excess, few)
    # Clutter that fills little of a zone is never many; then the upper part of the curve tells its shape.
    filling = excess.max(axis=1) >= many
    other_number = np.where(filling, many, fewest)
    other, _ = _crossing_db(excess, other_number)
    with np.errstate(divide="ignore", invalid="ignore"):
        depth_few, depth_other, depth = (
            np.log(resolution_cells / number) for number in (few, other_number, wanted)
        )
        spread = np.maximum(np.abs(other - middle), 0.1) * (np.log(10.0) / 10.0)
        shape = np.abs(np.log(depth_few / depth_other)) / spread
        shape = np.clip(shape, _LEAST_SHAPE, _LARGEST_SHAPE)
        needed = middle + 10.0 * np.log10(depth / depth_few) / shape
    needed = np.where(filled, np.inf, np.maximum(needed, 0.0))
    usable = (excess.max(axis=1) >= few) & (many < _DENSEST * resolution_cells)
    return np.where(usable, needed, 0.0)


def _crossing_db(
    excess: FloatArray, number: FloatArray
) -> tuple[FloatArray, npt.NDArray[np.bool_]]:
    """Level above which there are fewer bursts than a number, and whether there is none such."""
    last = excess.shape[1] - 1
    over = excess >= number[:, None]
    highest = np.where(over.any(axis=1), last - over[:, ::-1].argmax(axis=1), 0)
    following = np.minimum(highest + 1, last)
    row = np.arange(len(excess))
    here, there = (np.log(np.maximum(excess[row, i], _LEAST_COUNT)) for i in (highest, following))
    with np.errstate(divide="ignore", invalid="ignore"):
        part = np.where(here > there, (here - np.log(number)) / (here - there), 0.0)
    filled = over[:, last]
    return LEVELS_DB[highest] + STEP_DB * np.clip(part, 0.0, 1.0), filled
