# SPDX-License-Identifier: Apache-2.0
"""Gains of the sequential filters against their batch solutions (Kuzmin 1967, § 4.5.2-4.5.3, figures 4.10-4.12)."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import numpy.typing as npt

from radar_eval.published.result import Row
from secondary_proc.calculators.alpha_beta_gains import steady_second_increment_gains
from secondary_proc.calculators.line_estimator import line_position_weights, line_velocity_weights
from secondary_proc.calculators.sequential_filter import (
    Gains,
    aided_gains,
    bounded_gains,
    run_filter,
    second_increment_gains,
)
from secondary_proc.calculators.velocity_observations import (
    aided_position_weights,
    aided_velocity_weights,
)

FloatArray = npt.NDArray[np.float64]

_PLOTS = 11
_EXACT = 1e-9
# sigma_gamma / sigma_y: alpha, beta.
_STEADY = {
    0.03: (0.2175, 0.0265),
    0.1: (0.3618, 0.0799),
    0.3: (0.5434, 0.2027),
    1.0: (0.7691, 0.4805),
    3.0: (0.9282, 0.8038),
}


def sequential_gains() -> Iterator[Row]:
    """Compute gains and what the filters make of the plots.

    Yields:
        (4.82)-(4.87) against the line, (4.88) and (4.89), (4.90) and (4.91) against the line with velocities.
    """
    kinds = {
        "growing memory (4.82)-(4.87)": bounded_gains(_PLOTS, 0.0, 0.0),
        "Kalman form without increments (4.88)-(4.89)": second_increment_gains(_PLOTS, 0.0),
    }
    for name, gains in kinds.items():
        position, velocity = _responses(gains)
        for what, ours, exact in (
            ("last point", position, line_position_weights(_PLOTS, 0)),
            ("velocity", velocity, line_velocity_weights(_PLOTS)),
        ):
            label = f"{name}, {what} after {_PLOTS} plots: largest difference from the line"
            yield Row(label, 0.0, 0.0, float(np.abs(ours - exact).max()), _EXACT)
    for intensity, values in _STEADY.items():
        closed = steady_second_increment_gains(intensity)
        long = second_increment_gains(600, intensity)
        for symbol, expected, ours, last in zip(
            ("alpha", "beta"), values, closed, (long.alpha[-1], long.beta[-1]), strict=True
        ):
            label = f"steady {symbol} for second increments of {intensity:g} sigma_y (4.88)-(4.89)"
            yield Row(label, None, expected, float(ours), 5.1e-5)
            yield Row(f"{label}, by recursion", None, expected, float(last), 5.1e-5)
    yield from _aided()


def _aided() -> Iterator[Row]:
    for ratio in (0.3, 1.0, 5.0):
        position, velocity = _responses(aided_gains(_PLOTS, ratio), ratio)
        finding = "with alpha_n as printed the recursion leaves the least-squares line"
        for what, ours, exact in (
            ("last point (4.90)", position, aided_position_weights(_PLOTS, ratio, 0)),
            ("velocity (4.91)", velocity, aided_velocity_weights(_PLOTS, ratio)),
        ):
            whole = np.append(exact.position, np.full(_PLOTS, exact.velocity))
            label = f"c = {ratio:g}, {what} after {_PLOTS} plots: largest difference from the line"
            yield Row(label, 0.0, 0.0, float(np.abs(ours - whole).max()), _EXACT, finding)


def _responses(gains: Gains, ratio: float = 0.0) -> tuple[FloatArray, FloatArray]:
    """Weights of all observations in the last coordinate and velocity: one track for each of them."""
    count = 2 * _PLOTS if ratio else _PLOTS
    seen = np.eye(count)
    plots, speeds = seen[:_PLOTS], seen[_PLOTS:]
    if ratio:
        first = aided_position_weights(2, ratio, 0), aided_velocity_weights(2, ratio)
        start = [w.position @ plots[:2] + w.velocity * speeds[:2].sum(axis=0) for w in first]
    else:
        start = [plots[1], plots[1] - plots[0]]
    _, position, velocity = run_filter(
        gains, plots[2:], (start[0], start[1]), speeds[2:] if ratio else None
    )
    return position[-1], velocity[-1]
