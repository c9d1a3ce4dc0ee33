# SPDX-License-Identifier: Apache-2.0
"""Logarithmic video becomes the linear envelope that everything behind expects."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import numpy.typing as npt

VIDEO_LAWS = ("linear", "logarithmic")

# So far over the zero of the scale an envelope can still be squared in float32; no receiver reaches it.
_LARGEST_DB = 300.0


def expansion(law: str, db_per_count: float) -> Callable[[npt.NDArray], npt.NDArray]:
    """Choose what turns samples into envelopes.

    Args:
        law: one of VIDEO_LAWS.
        db_per_count: step of logarithmic video, dB.

    Returns:
        A function of video of any shape and sample type. Linear video it returns as it is; logarithmic video v becomes
        10^(v db_per_count / 20) in float32, by a look-up table where samples are integers. NaN stays NaN.
    """
    if law == "linear":
        return _unchanged
    return _Expansion(db_per_count)


def _unchanged(video: npt.NDArray) -> npt.NDArray:
    return video


class _Expansion:
    def __init__(self, db_per_count: float) -> None:
        self._db_per_count = db_per_count
        self._tables: dict[np.dtype, npt.NDArray[np.float32]] = {}

    def __call__(self, video: npt.NDArray) -> npt.NDArray:
        if video.dtype.kind == "f":
            return self._envelope(video)
        if video.dtype not in self._tables:
            codes = np.arange(np.iinfo(video.dtype).max + 1)
            self._tables[video.dtype] = self._envelope(
                np.minimum(codes, _LARGEST_DB / self._db_per_count)
            )
        return np.take(self._tables[video.dtype], video)

    def _envelope(self, counts: npt.NDArray) -> npt.NDArray[np.float32]:
        nepers = np.multiply(
            counts,
            math.log(10.0) / 20.0 * self._db_per_count,
            dtype=np.float32,
            casting="same_kind",
        )
        # What overflows is counted with the other samples that are not finite.
        with np.errstate(over="ignore"):
            return np.exp(nepers, out=nepers)
