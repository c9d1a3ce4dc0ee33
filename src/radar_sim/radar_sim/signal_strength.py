# SPDX-License-Identifier: Apache-2.0
"""How strong an echo is: from decibels at a reference range to amplitude at any range.

One convention everywhere: the signal-to-noise ratio is that of mean powers of one pulse at the beam's centre,
S² / (2 sigma²) with S the amplitude and sigma the rms of each quadrature of the noise. For a steady target that is
a²/2 with a = S / sigma, for a Rayleigh one k² (Kuzmin 1967, 1.33-1.39), so equal decibels mean equal mean power.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from radar_sim.radar import Radar

FloatArray = npt.NDArray[np.float64]


def snr_db_at_range(radar: Radar, snr_db: npt.ArrayLike, distance: npt.ArrayLike) -> FloatArray:
    """Signal-to-noise ratio by the fourth-power law of range, limited at short range.

    Args:
        radar: gives the reference range and the limit.
        snr_db: ratio at the reference range, dB, any shape.
        distance: metres, positive, shape that broadcasts with it.

    Returns:
        Power ratio of one pulse at the beam's centre, dB, broadcast shape.
    """
    path = 40.0 * np.log10(radar.reference_range / np.asarray(distance, dtype=float))
    return np.minimum(np.asarray(snr_db, dtype=float) + path, radar.max_snr_db)


def range_of_snr(radar: Radar, snr_db: npt.ArrayLike, wanted_db: npt.ArrayLike) -> FloatArray:
    """Range at which a target falls to a given signal-to-noise ratio, the inverse of `snr_db_at_range`.

    Args:
        radar: gives the reference range.
        snr_db: ratio at the reference range, dB, any shape.
        wanted_db: ratio below the radar's limit, dB, shape that broadcasts with it.

    Returns:
        Metres, broadcast shape.
    """
    excess = np.asarray(snr_db, dtype=float) - np.asarray(wanted_db, dtype=float)
    return np.asarray(radar.reference_range * 10.0 ** (excess / 40.0))


def amplitude_from_snr(snr_db: npt.ArrayLike) -> FloatArray:
    """Amplitude over the noise's rms, a = S / sigma; for a Rayleigh target sqrt(2) k, its rms amplitude.

    Args:
        snr_db: power ratio, dB, any shape.

    Returns:
        Amplitude ratio, same shape.
    """
    return np.sqrt(2.0) * 10.0 ** (np.asarray(snr_db, dtype=float) / 20.0)
