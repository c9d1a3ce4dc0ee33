# SPDX-License-Identifier: Apache-2.0
"""What is known of a track when its second plot opens it."""

from __future__ import annotations

from typing import Any

from radar_common.tables import TrackStatus
from secondary_proc.motion import two_point_state
from secondary_proc.plots import Plots


def first_state(first: Plots, second: Plots, noise_density: float) -> dict[str, Any]:
    """Columns of new tracks that follow from their two plots.

    Args:
        first: earlier plots, n of them.
        second: later plots, n of them.
        noise_density: power spectral density of the acceleration per axis, m^2/s^3.

    Returns:
        Values by name of the track store's column.
    """
    state, covariance = two_point_state(
        first.position,
        first.covariance,
        second.position,
        second.covariance,
        second.time - first.time,
        noise_density,
    )
    return {
        "status": TrackStatus.TENTATIVE,
        "state": state,
        "covariance": covariance,
        "time": second.time,
        "crossing": second.time,
        "expected": second.time,
        "opens": second.time,
        "due": second.time,
        "born": first.time,
        "hits": 2,
        "misses": 0,
        "plot_range": second.range,
        "plot_azimuth": second.azimuth,
    }
