# SPDX-License-Identifier: Apache-2.0
"""How many pulses clutter stays alike: its inner motion and the turning beam both change it."""

from __future__ import annotations

import math

import numpy as np

from radar_sim.radar import Radar

_STEPS = 4001


def scanning_coherence(radar: Radar) -> float:
    """Pulses in which echoes of scatterers at rest become unlike because the beam moves on.

    Their correlation at two directions of the axis is that of the two-way pattern with itself.

    Args:
        radar: pattern and pulses in the beam.

    Returns:
        Number of pulses in which the correlation falls to 1/e.
    """
    extent = radar.beam.extent
    alpha = np.linspace(-extent, extent, _STEPS)
    pattern = radar.beam(alpha)
    correlation = np.correlate(pattern, pattern, "full")[_STEPS - 1 :]
    shift = (alpha[1] - alpha[0]) * np.arange(_STEPS)
    at = float(np.interp(-1.0 / math.e, -correlation / correlation[0], shift))
    return at * radar.pulses_in_beam / 2.0


def motion_coherence(radar: Radar, speed_spread: float) -> float:
    """Pulses in which echoes become unlike because the scatterers move.

    Radial speeds with a normal spread s widen the line to a Gaussian of standard deviation 2 s / wavelength; its
    correlation is exp(-2 (2 pi s t / wavelength)²) (Skolnik, Introduction to Radar Systems, ch. 4).

    Args:
        radar: wavelength and pulse rate.
        speed_spread: rms of the radial speeds, m/s.

    Returns:
        Number of pulses in which the correlation falls to 1/e; inf without motion.
    """
    if speed_spread == 0.0:
        return math.inf
    return radar.wavelength / (2.0 * math.pi * math.sqrt(2.0) * speed_spread) * radar.pulse_rate


def coherence(radar: Radar, speed_spread: float) -> float:
    """Pulses in which the two together make echoes unlike; for Gaussian laws their spectra add up.

    Args:
        radar: the radar.
        speed_spread: rms of the radial speeds, m/s.

    Returns:
        Number of pulses in which the correlation falls to 1/e.
    """
    return 1.0 / math.hypot(
        1.0 / scanning_coherence(radar), 1.0 / motion_coherence(radar, speed_spread)
    )
