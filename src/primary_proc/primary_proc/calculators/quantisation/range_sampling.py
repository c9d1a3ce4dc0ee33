# SPDX-License-Identifier: Apache-2.0
"""How finely to sample in range: what is lost between samples, and what a wider time quantum does to detection."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import numpy.typing as npt

from primary_proc.calculators.pulse.gauss_rule import gauss_rule

FloatArray = npt.NDArray[np.float64]
Correlation = Callable[[FloatArray], FloatArray]

_NODES = 64


def reconstruct(
    samples: npt.ArrayLike, interval: float, time: npt.ArrayLike, correlation: Correlation
) -> FloatArray:
    """Signal between its samples, from the nearest of them and the correlation.

    Source: Kuzmin 1967, (2.3), with the filter of least error, f = R within half an interval.

    Args:
        samples: U(k tau_1), the first at time zero, shape (..., samples).
        interval: tau_1.
        time: within half an interval of the samples, shape (n,).
        correlation: R, normalised.

    Returns:
        U*(t), shape (..., n).
    """
    values = np.asarray(samples, dtype=float)
    moments = np.asarray(time, dtype=float)
    nearest = np.rint(moments / interval).astype(np.intp)
    return values[..., nearest] * correlation(moments - nearest * interval)


def reconstruction_error(correlation: Correlation, interval: float) -> float:
    """Mean squared error of `reconstruct` for a signal of variance one.

    Source: Kuzmin 1967, (2.4)-(2.5).

    Args:
        correlation: R, normalised.
        interval: tau_1.

    Returns:
        Variance.
    """
    lag, weight = gauss_rule(0.0, interval / 2.0, _NODES)
    return float(1.0 - 2.0 / interval * np.sum(np.square(correlation(lag)) * weight))


def triangular_reconstruction_error(samples_per_correlation: npt.ArrayLike) -> FloatArray:
    """The same for a triangular correlation, in closed form.

    Source: Kuzmin 1967, (2.6).

    Args:
        samples_per_correlation: gamma >= 1, length of the correlation over the interval, any shape.

    Returns:
        Variance, same shape.
    """
    gamma = np.asarray(samples_per_correlation, dtype=float)
    return np.asarray((6.0 * gamma - 1.0) / (12.0 * np.square(gamma)))


def widened_probabilities(
    signal: npt.ArrayLike, noise: npt.ArrayLike, factor: npt.ArrayLike
) -> tuple[FloatArray, FloatArray]:
    """Probabilities of a one when the time quantum is longer than the correlation.

    Source: Kuzmin 1967, (2.26)-(2.27), for a rectangular pulse that lies wholly within one quantum.

    Args:
        signal: P_S1 of a quantum as long as the correlation.
        noise: P_N1, broadcast with it.
        factor: mu >= 1, how many times longer the quantum is, broadcast with them.

    Returns:
        P_S and P_N of the longer quantum, of the broadcast shape.
    """
    quiet, times = 1.0 - np.asarray(noise, dtype=float), np.asarray(factor, dtype=float)
    missed = (1.0 - np.asarray(signal, dtype=float)) * quiet ** (times - 1.0)
    return np.asarray(1.0 - missed), np.asarray(1.0 - quiet**times)
