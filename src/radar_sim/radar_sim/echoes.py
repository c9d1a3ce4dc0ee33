# SPDX-License-Identifier: Apache-2.0
"""Signals that reach few range cells: one row for each pulse and cell, in order of the pulses."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

IntArray = npt.NDArray[np.int64]


@dataclass(frozen=True, slots=True)
class Echoes:
    """Signal in range cells, one row for each pulse and cell that it reaches, in order of the pulses.

    Attributes:
        pulse: number of the pulse since the start, shape (n,).
        cell: range cell, shape (n,).
        amplitude: complex, over the rms of one quadrature of the noise, shape (n,).
    """

    pulse: IntArray
    cell: IntArray
    amplitude: npt.NDArray[np.complex128]

    def __len__(self) -> int:
        """Count the rows."""
        return len(self.pulse)

    def where(self, rows: slice | npt.NDArray[np.bool_]) -> Echoes:
        """Select rows.

        Args:
            rows: a slice, or a mask of shape (n,).

        Returns:
            The selected rows.
        """
        return Echoes(self.pulse[rows], self.cell[rows], self.amplitude[rows])


NO_ECHOES = Echoes(np.empty(0, np.int64), np.empty(0, np.int64), np.empty(0, np.complex128))


def joined(*parts: Echoes) -> Echoes:
    """Put echoes behind each other; the order of the pulses is lost.

    Args:
        parts: any number of them.

    Returns:
        All rows.
    """
    return Echoes(
        np.concatenate([NO_ECHOES.pulse, *(part.pulse for part in parts)]),
        np.concatenate([NO_ECHOES.cell, *(part.cell for part in parts)]),
        np.concatenate([NO_ECHOES.amplitude, *(part.amplitude for part in parts)]),
    )


class EchoQueue:
    """Echoes that wait for their pulse."""

    def __init__(self) -> None:
        """Start empty."""
        self._waiting = NO_ECHOES

    def add(self, echoes: Echoes) -> None:
        """Add echoes behind those of the same pulses that already wait.

        Args:
            echoes: in any order.
        """
        waiting = joined(self._waiting, echoes)
        order = np.argsort(waiting.pulse, kind="stable")
        self._waiting = Echoes(waiting.pulse[order], waiting.cell[order], waiting.amplitude[order])

    def take(self, after: int) -> Echoes:
        """Take out the echoes of the next pulses.

        Args:
            after: number of the first pulse that stays.

        Returns:
            Echoes of all pulses before it, in order of the pulses.
        """
        taken = int(np.searchsorted(self._waiting.pulse, after))
        echoes, self._waiting = (
            self._waiting.where(slice(taken)),
            self._waiting.where(slice(taken, None)),
        )
        return echoes
