# SPDX-License-Identifier: Apache-2.0
"""Gate probabilities and the growth of a gate with the track's age (Kuzmin 1967, § 4.7.2)."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from radar_eval.published.gate_sizes import gate_sizes
from radar_eval.published.result import Row
from secondary_proc.gates import gate
from secondary_proc.plots import Plots

_SAMPLES = 40_000
_ELLIPSE = {1.0: (0.68, 0.3935), 2.0: (0.92, 0.8647), 3.0: (0.997, 0.9889)}
_FOUR_SIGMAS = 4.0


def gate_probabilities() -> Iterator[Row]:
    """Count plots inside the tracker's gates.

    Yields:
        Share of a target's plots that fall into a gate of one, two and three sigmas; sizes of gates.
    """
    finding = (
        "0.68 and 0.997 are probabilities of one coordinate, 0.92 is nearly that of two; the tracker's gate is the "
        "ellipse of both coordinates, 1 - exp(-lambda^2/2)"
    )
    for sigmas, (published, expected) in _ELLIPSE.items():
        # Sampling error of a share, at four sigmas, seed fixed.
        tolerance = _FOUR_SIGMAS * float(np.sqrt(expected * (1.0 - expected) / _SAMPLES))
        label = f"share of plots in a gate of {sigmas:g} sigma"
        yield Row(label, published, expected, _share_inside(sigmas), tolerance, finding)
    yield from gate_sizes()


def _share_inside(sigmas: float) -> float:
    generator = np.random.default_rng(4)
    state = np.array([30e3, 20e3, 120.0, -60.0])
    covariance = np.kron(
        np.array([[90.0**2, 90.0 * 9.0], [90.0 * 9.0, 2 * 9.0**2]]),
        np.array([[1.0, 0.3], [0.3, 0.7]]),
    )
    seconds = 4.0
    error = np.array([[150.0**2, -(60.0**2)], [-(60.0**2), 80.0**2]])
    ahead = np.concatenate([np.eye(2), seconds * np.eye(2)], axis=1)
    total = ahead @ covariance @ ahead.T + error
    position = generator.multivariate_normal(ahead @ state, total, _SAMPLES)
    plots = Plots.at(np.full(_SAMPLES, seconds), position, np.broadcast_to(error, (_SAMPLES, 2, 2)))
    track = np.concatenate([state, covariance.ravel(), np.zeros(1)])[:, None]
    gated = gate(track, plots, sigmas=sigmas, noise_density=np.zeros(1), shortest=1.0)
    return len(gated.plot) / _SAMPLES
