# SPDX-License-Identifier: Apache-2.0
"""Fixed memory: the best line through a track's last plots, or the best parabola while the target manoeuvres.

Source: Kuzmin 1967, § 4.4: hypothesis 1 and 2, and the manoeuvre detector (4.69) that chooses between them.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from secondary_proc.motion import FloatArray, inverse_2x2, normalised_square, trace
from secondary_proc.smoothing.interface import Measured, Smoothed
from secondary_proc.smoothing.manoeuvre import ManoeuvreDetector
from secondary_proc.smoothing.polynomial_fit import fit

_LEAST_FOR_PARABOLA = 4
"""A parabola meets three plots whatever their errors, so it would smooth nothing."""


class PolynomialSmoother:
    """Line or parabola of maximum likelihood through the last plots, each at its own time and with its own error."""

    def __init__(
        self, plots: int, degree: int, noise_density: float, detector: ManoeuvreDetector
    ) -> None:
        """Set the memory.

        Args:
            plots: that are remembered, the new one included.
            degree: highest order of the polynomial; with 1 the detector is not asked.
            noise_density: power spectral density of the acceleration between manoeuvres, m^2/s^3.
            detector: of accelerations.
        """
        self.memory: np.dtype[Any] = np.dtype(
            [
                ("plots", np.int64),
                ("age", float, (plots,)),
                ("position", float, (plots, 2)),
                ("information", float, (plots, 2, 2)),
            ]
        )
        self._capacity = plots
        self._degree = degree
        self._density = noise_density
        self._detector = detector

    def update(self, measured: Measured) -> Smoothed:
        """Combine the remembered plots and the new one.

        Args:
            measured: tracks and plots.

        Returns:
            The tracks at the time of their plots; memory holds the last plots, the newest first.
        """
        memory = self._remember(measured)
        line = fit(memory["age"], memory["position"], memory["information"], 1, self._density)
        state, covariance = line.estimate, line.covariance
        if self._degree > 1:
            enough = np.flatnonzero(memory["plots"] >= _LEAST_FOR_PARABOLA)
            if len(enough):
                self._bend(memory, enough, state, covariance)
        return Smoothed(state, covariance, memory)

    def _bend(
        self,
        memory: npt.NDArray[Any],
        tracks: npt.NDArray[np.intp],
        state: FloatArray,
        covariance: FloatArray,
    ) -> None:
        few = memory[tracks]
        parabola = fit(few["age"], few["position"], few["information"], 2, self._density)
        surprise, _ = normalised_square(parabola.estimate[:, 4:], parabola.covariance[:, 4:, 4:])
        turning = self._detector.declared(surprise, 2)
        state[tracks[turning]] = parabola.estimate[turning, :4]
        covariance[tracks[turning]] = parabola.covariance[turning, :4, :4]

    def _remember(self, measured: Measured) -> npt.NDArray[Any]:
        before = measured.memory
        new = before["plots"] == 0
        if new.any():
            before = np.where(new, self._recall(measured), before)
        memory = np.zeros(len(before), self.memory)
        memory["plots"] = np.minimum(before["plots"] + 1, self._capacity)
        memory["age"][:, 1:] = before["age"][:, :-1] + measured.seconds[:, None]
        for name in ("position", "information"):
            memory[name][:, 1:] = before[name][:, :-1]
        memory["position"][:, 0] = measured.position
        memory["information"][:, 0] = inverse_2x2(measured.position_covariance)[0]
        return memory

    def _recall(self, measured: Measured) -> npt.NDArray[Any]:
        """Two plots that tell what a state without memory tells.

        They lie so far apart that their errors are independent, as those of the two plots that opened the track are.
        """
        place, cross = measured.covariance[:, :2, :2], measured.covariance[:, :2, 2:]
        motion = measured.covariance[:, 2:, 2:]
        since = trace(place) / np.maximum(np.abs(trace(cross)), 1e-9)
        # An old state's errors are hardly correlated and would put the first plot long before the track.
        since = np.minimum(since, np.sqrt(4.0 * trace(place) / trace(motion)))
        ago = since[:, None]
        earlier = (
            place - ago[:, None] * (cross + cross.transpose(0, 2, 1)) + ago[:, None] ** 2 * motion
        )
        recalled = np.zeros(len(since), self.memory)
        recalled["plots"] = 2
        recalled["age"][:, 1] = since
        recalled["position"][:, 0] = measured.state[:, :2]
        recalled["position"][:, 1] = measured.state[:, :2] - ago * measured.state[:, 2:]
        recalled["information"][:, 0] = inverse_2x2(place)[0]
        recalled["information"][:, 1] = inverse_2x2(earlier)[0]
        return recalled
