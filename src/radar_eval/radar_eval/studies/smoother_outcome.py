# SPDX-License-Identifier: Apache-2.0
"""How well one smoother followed one kind of flight."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Outcome:
    """Errors at the plots that tracks took during the manoeuvre and shortly after it.

    Attributes:
        smoother: its name.
        flight: name of the flight.
        period: of the antenna, s.
        plots: that there were.
        plot_rms: error of the plots that tracks took, m.
        position_rms: error of the smoothed positions, m.
        velocity_rms: error of the smoothed velocities, m/s.
        lost: share of the plots that fell beside the gate of their own track.
        tracks_per_target: on the whole flight.
        nees: mean square of the error of the state, normalised by its covariance; 4 where the model is the truth.
    """

    smoother: str
    flight: str
    period: float
    plots: int
    plot_rms: float
    position_rms: float
    velocity_rms: float
    lost: float
    tracks_per_target: float
    nees: float
