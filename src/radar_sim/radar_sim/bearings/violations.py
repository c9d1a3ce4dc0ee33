# SPDX-License-Identifier: Apache-2.0
"""When a channel is violated: a Markov chain of two states from look to look, and scripted intervals."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from radar_common.tables import CHANNEL_STATES
from radar_sim.bearings.sections import ChannelSection, IntervalSection

FloatArray = npt.NDArray[np.float64]
BoolArray = npt.NDArray[np.bool_]

_CHUNK = 256


class Violations:
    """The A(k) or B(k) of a run: drawn as far as it is asked for; what has been drawn stays."""

    def __init__(
        self,
        section: ChannelSection,
        intervals: Sequence[IntervalSection],
        period: float,
        rng: np.random.Generator,
    ) -> None:
        """Begin without violation.

        Args:
            section: probabilities of the chain.
            intervals: in which the channel is violated whatever the chain says.
            period: s from look to look, the step of the chain.
            rng: source of randomness.
        """
        self._section = section
        self._intervals = intervals
        self._period = period
        self._rng = rng
        self._chain = np.zeros(1, dtype=bool)

    def at(self, time: FloatArray) -> BoolArray:
        """Tell when the channel is violated.

        Args:
            time: s after the start, any shape.

        Returns:
            Boolean, same shape; between two looks as at the one before.
        """
        violated = np.zeros(np.shape(time), dtype=bool)
        for interval in self._intervals:
            violated |= (interval.begins <= time) & (time < interval.ends)
        if self._section.begin_probability > 0.0 and violated.size:
            look = np.floor(np.asarray(time) / self._period + 1e-9).astype(np.intp)
            self._extend(int(look.max()))
            violated |= self._chain[look]
        return violated

    def _extend(self, look: int) -> None:
        missing = look + 1 - len(self._chain)
        if missing <= 0:
            return
        drawn = self._rng.random(_CHUNK * (1 + (missing - 1) // _CHUNK))
        begins = drawn < self._section.begin_probability
        ends = drawn < self._section.end_probability
        state, states = bool(self._chain[-1]), np.empty(len(drawn), dtype=bool)
        for number in range(len(drawn)):
            state = not ends[number] if state else bool(begins[number])
            states[number] = state
        self._chain = np.concatenate([self._chain, states])


def one_hot(violated: BoolArray) -> npt.NDArray[np.float32]:
    """Write a state of two as probabilities that are certain.

    Args:
        violated: shape (n,).

    Returns:
        Columns of undisturbed and violated, NaN in those of states that there are not, shape (n, CHANNEL_STATES).
    """
    health = np.full((len(violated), CHANNEL_STATES), np.nan, dtype=np.float32)
    health[:, 0] = ~violated
    health[:, 1] = violated
    return health
