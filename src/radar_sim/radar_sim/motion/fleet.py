# SPDX-License-Identifier: Apache-2.0
"""All targets of a simulation: their state at any time, in closed form and for all at once.

On a leg the turn rate, or the centripetal acceleration, and the acceleration along the course are constant: straight
and uniform, a coordinated turn, a change of speed, or both together (Kuzmin 1967, § 4.2.1, the generalised
hypothesis). After its last leg a target flies straight on. A random motion is drawn once, as a row of polynomials.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from radar_sim.motion.leg_table import LegTable
from radar_sim.motion.legs import Path, State
from radar_sim.motion.pieces import PieceTable

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.intp]


class Fleet:
    """All targets of a simulation."""

    def __init__(self, paths: Sequence[Path]) -> None:
        """Lay out the motion of all paths in arrays.

        Args:
            paths: one a target.
        """
        self.appears = np.array([path.appears for path in paths], dtype=float)
        self.disappears = np.array([path.disappears for path in paths], dtype=float)
        self._start = np.array([path.y + 1j * path.x for path in paths], dtype=complex)
        self._legs = LegTable(paths)
        self._pieces = PieceTable([path.pieces for path in paths])
        self._wander = PieceTable([path.wander for path in paths])

    def __len__(self) -> int:
        """Count the targets."""
        return len(self.appears)

    def present(self, target: IntArray, time: FloatArray) -> npt.NDArray[np.bool_]:
        """Tell which targets are there at which time.

        Args:
            target: index, any shape.
            time: s after the start, same shape.

        Returns:
            Boolean, same shape.
        """
        return np.asarray((self.appears[target] <= time) & (time < self.disappears[target]))

    def state(self, target: IntArray, time: FloatArray) -> State:
        """Evaluate the motion.

        Args:
            target: index, any shape.
            time: s after the start, same shape; before a target's appearance its first leg is continued backwards.

        Returns:
            Position and velocity, same shape.
        """
        position, velocity = self._legs.state(target, time)
        chosen = self._pieces.filled[target]
        if chosen.any():
            some = target[chosen]
            way, moving = self._pieces.state(some, time[chosen] - self.appears[some])
            position[chosen], velocity[chosen] = self._start[some] + way, moving
        chosen = self._wander.filled[target]
        if chosen.any():
            some = target[chosen]
            way, moving = self._wander.state(some, time[chosen] - self.appears[some])
            position[chosen] += way
            velocity[chosen] += moving
        return State(position.imag, position.real, velocity.imag, velocity.real)
