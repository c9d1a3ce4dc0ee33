# SPDX-License-Identifier: Apache-2.0
"""What every burst detector offers: bursts of the range rings, followed across messages and across north."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Hashable

import numpy as np
import numpy.typing as npt

BURST = np.dtype(
    [
        ("ring", np.int32),  # range cell
        ("start", np.int64),  # lambda: pulse at which the burst was detected
        ("end", np.int64),  # mu: pulse at which it was found to have ended
        ("overflow", np.bool_),  # ended by the limit of its length
        ("power", np.float32),  # peak over the mean noise power; filled in by the peak meter
        (
            "centre",
            np.float64,
        ),  # pulse over which the detector's sum was largest, with a fraction; NaN without a sum
    ]
)


class BurstDetector(ABC):
    """Finds bursts in the samples of all range rings, pulse by pulse.

    Pulses are numbered from the start of the stream. A burst that is longer than the limit is ended by it, once; the
    ring then stays silent until the end criterion is met, so that a long clutter edge gives one burst and not many.

    Attributes:
        rule: all that decides where bursts start and end but the limit; detectors of one rule can take each other's
            place in mid-stream.
        memory: pulses before the start that may belong to the burst.
        longest: limit of a burst's length, in pulses after its start.
    """

    rule: Hashable
    memory: int
    longest: int

    @abstractmethod
    def detect(self, samples: npt.NDArray, first: int) -> npt.NDArray[np.void]:
        """Go on with the next pulses.

        Args:
            samples: what the detector's quantiser gives for the pulses.
            first: number of the first of them.

        Returns:
            Bursts that ended, dtype BURST, in order of end and ring.
        """

    @abstractmethod
    def open_bursts(self) -> npt.NDArray[np.void]:
        """List the bursts that have not ended, dtype BURST, their end unset, in order of ring."""

    @abstractmethod
    def reset(self) -> None:
        """Forget all past pulses."""


def bursts(
    ring: npt.ArrayLike,
    start: npt.ArrayLike,
    end: npt.ArrayLike,
    overflow: npt.ArrayLike,
    centre: npt.ArrayLike = np.nan,
) -> npt.NDArray[np.void]:
    """Make a table of bursts.

    Args:
        ring: range cells, shape (n,).
        start: pulse of detection, shape (n,).
        end: pulse of the end, shape (n,) or one for all.
        overflow: whether ended by the limit, shape (n,) or one for all.
        centre: pulse of the largest sum, shape (n,) or one for all.

    Returns:
        Table of dtype BURST, powers zero.
    """
    table = np.zeros(np.shape(ring), BURST)
    table["ring"], table["start"], table["end"], table["overflow"] = ring, start, end, overflow
    table["centre"] = centre
    return table


def in_order(table: npt.NDArray[np.void]) -> npt.NDArray[np.void]:
    """Sort bursts by end, then ring.

    Args:
        table: dtype BURST.

    Returns:
        The same bursts in order.
    """
    return table[np.lexsort((table["ring"], table["end"]))] if len(table) > 1 else table


def joined(*tables: npt.NDArray[np.void]) -> npt.NDArray[np.void]:
    """Concatenate tables of one dtype; most of the time all but one are empty, and numpy is slow on structures.

    Args:
        tables: at least one.

    Returns:
        The rows of all, in order.
    """
    filled = [table for table in tables if len(table)]
    if len(filled) < 2:
        return (filled or tables)[0]
    # Numpy's own concatenation works out a common structure field by field, each time.
    whole = np.empty(sum(map(len, filled)), filled[0].dtype)
    begin = 0
    for table in filled:
        whole[begin : begin + len(table)] = table
        begin += len(table)
    return whole
