# SPDX-License-Identifier: Apache-2.0
"""A bearing that is a random process: oscillating, damped, stationary (Detkov 2022, (26), made consistent).

The printed Phi21 = -mu sin(mu T) and Gamma22 = sqrt(mu² - alpha²) take mu for the natural frequency where the other
elements take it for the damped one; here it is the damped one throughout, so that the process is stationary with
the covariance D [[1, -alpha], [-alpha, alpha² + mu²]] whatever the step.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from radar_sim.bearings.sections import BearingProcessSection

FloatArray = npt.NDArray[np.float64]

_CHUNK = 256


def transition(alpha: FloatArray, mu: FloatArray, elapsed: FloatArray) -> FloatArray:
    """Phi, how bearing and rate run on over a time.

    Args:
        alpha: damping, 1/s, any shape.
        mu: damped frequency, rad/s, same shape.
        elapsed: s, same shape.

    Returns:
        Matrices, shape (..., 2, 2).
    """
    cosine, sine = np.cos(mu * elapsed), np.sin(mu * elapsed)
    matrix = np.empty((*np.shape(cosine), 2, 2))
    matrix[..., 0, 0] = cosine + alpha / mu * sine
    matrix[..., 0, 1] = sine / mu
    matrix[..., 1, 0] = -(mu**2 + alpha**2) / mu * sine
    matrix[..., 1, 1] = cosine - alpha / mu * sine
    return matrix * np.exp(-alpha * elapsed)[..., None, None]


class BearingProcesses:
    """Several of them, drawn step by step as far as they are asked for; what has been drawn stays."""

    def __init__(self, sections: Sequence[BearingProcessSection], rng: np.random.Generator) -> None:
        """Draw the first states from their stationary law.

        Args:
            sections: one a process.
            rng: source of randomness.
        """
        self._streams = rng.spawn(len(sections))
        self.mean = np.radians([s.azimuth_deg for s in sections])
        self._step = np.array([s.step for s in sections], dtype=float)
        self._alpha = 1.0 / np.array([s.correlation_time for s in sections], dtype=float)
        self._mu = np.array([s.frequency for s in sections], dtype=float)
        deviation = np.radians([s.deviation_deg for s in sections])
        self._shape = np.zeros((len(sections), 2, 2))
        self._shape[:, 0, 0] = deviation
        self._shape[:, 1, 0] = -self._alpha * deviation
        self._shape[:, 1, 1] = self._mu * deviation
        first = self._normal(1)[0]
        self._drawn = np.einsum("nij,nj->ni", self._shape, first)[None]
        self._phi = transition(self._alpha, self._mu, self._step)
        driving = np.sqrt(-np.expm1(-2.0 * self._alpha * self._step))
        self._gamma = driving[:, None, None] * self._shape

    def _normal(self, steps: int) -> FloatArray:
        drawn = [stream.standard_normal((steps, 2)) for stream in self._streams]
        return np.stack(drawn, axis=1) if drawn else np.empty((steps, 0, 2))

    def __len__(self) -> int:
        """Count them."""
        return len(self.mean)

    def state(self, time: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Evaluate all.

        Args:
            time: s after the start, shape (n, processes).

        Returns:
            Azimuth about north in rad, not wrapped, and its rate in rad/s, same shape.
        """
        # A look at the very time of a step must not fall behind it by a rounding.
        step = np.floor(time / self._step + 1e-9).astype(np.intp)
        elapsed = np.maximum(time - step * self._step, 0.0)
        self._extend(int(step.max(initial=0)))
        states = self._drawn[step, np.arange(len(self))]
        run_on = transition(
            np.broadcast_to(self._alpha, time.shape),
            np.broadcast_to(self._mu, time.shape),
            elapsed,
        )
        states = np.einsum("...ij,...j->...i", run_on, states)
        return self.mean + states[..., 0], states[..., 1]

    def _extend(self, step: int) -> None:
        missing = step + 1 - len(self._drawn)
        if missing <= 0 or not len(self):
            return
        more = np.einsum("nij,knj->kni", self._gamma, self._normal(_CHUNK * -(-missing // _CHUNK)))
        state = self._drawn[-1]
        for row in more:
            state = np.einsum("nij,nj->ni", self._phi, state) + row
            row[:] = state
        self._drawn = np.concatenate([self._drawn, more])
