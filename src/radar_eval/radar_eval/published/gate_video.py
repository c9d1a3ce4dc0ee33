# SPDX-License-Identifier: Apache-2.0
"""Simulated video in a time gate, which the formulas of Kuzmin 1967, § 2.4, are held to.

The reference values of simulated video have an error of their own of about 0.0015; ours is drawn anew, from few enough
sweeps to be quick, and the tolerance is four standard errors of both.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache

import numpy as np
import numpy.typing as npt

from primary_proc.calculators.quantisation.noise_excursions import video_model
from primary_proc.quantisers.time_gate import gate_levels
from radar_common.pulse_response import PulseResponse
from radar_sim.waveform import WaveformGenerator

SWEEPS = 12_000

_STEP, _SEED = 0.02, 5
_REFERENCE_ERROR = 0.0015


@dataclass(frozen=True)
class GateVideo:
    """Envelopes from -1 to 1 pulse length.

    Attributes:
        grid: times, shape (points,).
        envelope: by the a_0 of the pulse, 0 for noise alone, 1, 2 and 3; shape (sweeps, points).
    """

    grid: npt.NDArray[np.float64]
    envelope: dict[float, npt.NDArray[np.float64]]

    def detected(self, signal: float, gate: float, shift: float, threshold: float = 2.0) -> float:
        """Count the sweeps that are over a threshold anywhere in a gate.

        Args:
            signal: a_0, 0 to 3.
            gate: its length.
            shift: where its middle is.
            threshold: x_0.

        Returns:
            Share of all.
        """
        inside = np.abs(self.grid - shift) <= gate / 2.0 + _STEP / 4.0
        within = self.envelope[signal][:, inside]
        return float(np.mean(gate_levels(within, [threshold], within.shape[1])))


@cache
def gate_video(noise: str) -> GateVideo:
    """Draw video.

    The references keep the book's pulse exp(-pi nu^2) also in noise that is white before the filter.

    Args:
        noise: "book" or "physical".

    Returns:
        The same video in every call.
    """
    response: PulseResponse = replace(video_model(noise), echo=video_model("book").echo)
    generator = WaveformGenerator(response, -1.0, 1.0, _STEP, np.random.default_rng(_SEED))
    voltage = generator.noise(SWEEPS)
    envelopes = {a: np.abs(voltage + generator.pulses(SWEEPS, a)) for a in (0.0, 1.0, 2.0, 3.0)}
    return GateVideo(generator.grid, envelopes)


def scatter(probability: float) -> float:
    """Tell how far our share of sweeps may lie from that of the reference.

    Args:
        probability: of the reference.

    Returns:
        Four standard errors of both.
    """
    variance = probability * (1.0 - min(probability, 1.0)) / SWEEPS
    return 4.0 * float(np.sqrt(variance + _REFERENCE_ERROR**2))
