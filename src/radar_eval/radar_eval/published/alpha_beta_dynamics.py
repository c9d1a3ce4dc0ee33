# SPDX-License-Identifier: Apache-2.0
"""The alpha-beta filter with constant gains (Kuzmin 1967, § 4.5.4, (4.92)-(4.112), figures 4.13-4.16)."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import numpy.typing as npt
from scipy.signal import lfilter

from radar_eval.published.result import Row
from secondary_proc.calculators.alpha_beta_dynamics import (
    OUTPUTS,
    dynamic_error,
    is_stable,
    random_variance,
    speed_jump_errors,
    speed_jump_square,
    transfer,
)
from secondary_proc.calculators.alpha_beta_optimum import optimal_gains
from secondary_proc.calculators.sequential_filter import Gains, run_filter

FloatArray = npt.NDArray[np.float64]

_EXACT = 1e-9
_LONG = 3000
_PAIRS = ((0.5, 0.3), (0.8, 0.8), (0.3, 0.05), (1.0, 1.0))
_JUMPS = {
    (0.5, 0.3): (1.0, 1.2, 0.94, 0.528, 0.1636, -0.0677),
    (0.8, 0.8): (1.0, 0.4, -0.04, -0.096, -0.0304, 0.007),
    (1.0, 1.0): (1.0, 0.0, 0.0, 0.0, 0.0, 0.0),
    (0.3, 0.05): (1.0, 1.65, 2.0225, 2.1821, 2.1848, 2.0774),
}
# alpha, beta: variance of smoothed, predicted, velocity, residual.
_VARIANCES = {
    (0.1, 0.01): (0.0976, 0.1082, 0.0005, 1.1082),
    (0.2, 0.05): (0.2113, 0.2676, 0.0070, 1.2676),
    (0.3, 0.1): (0.2929, 0.4141, 0.0202, 1.4141),
    (0.5, 0.2): (0.4286, 0.7143, 0.0571, 1.7143),
    (0.5, 0.3): (0.4815, 0.9259, 0.1333, 1.9259),
    (0.7, 0.5): (0.6327, 1.5850, 0.3401, 2.5850),
    (0.8, 0.8): (0.7500, 2.7500, 1.0000, 3.7500),
    (1.0, 0.5): (1.0000, 2.3333, 0.3333, 3.3333),
    (1.0, 1.0): (1.0000, 5.0000, 2.0000, 6.0000),
}
_EQUATIONS = {
    "smoothed": "smoothed coordinate (4.102)",
    "predicted": "prediction (4.103)",
    "velocity": "velocity (4.104)",
    "residual": "residual",
}
_TIMES = {(0.1, 0.01): 1.11, (0.5, 0.3): 1.92, (0.8, 0.8): 3.67}
# Gamma^2: alpha, beta, error to smooth; the same to predict.
_OPTIMA = {
    1e-4: (0.1985, 0.0398, 0.2310, 0.1772, 0.0386, 0.2969),
    1e-3: (0.3026, 0.0938, 0.3412, 0.2554, 0.0904, 0.5075),
    0.01: (0.4469, 0.2108, 0.4849, 0.3491, 0.2031, 0.9088),
    0.05: (0.5687, 0.3549, 0.6005, 0.4152, 0.3459, 1.4245),
    0.1: (0.6241, 0.4372, 0.6518, 0.4408, 0.4302, 1.7544),
    0.2: (0.6794, 0.5326, 0.7027, 0.4632, 0.5310, 2.1842),
    0.5: (0.7503, 0.6777, 0.7672, 0.4859, 0.6921, 2.9755),
    1.0: (0.8000, 0.8000, 0.8125, 0.4963, 0.8363, 3.8245),
    2.0: (0.8449, 0.9301, 0.8535, 0.5000, 1.0000, 5.0000),
    5.0: (0.8950, 1.1078, 0.8997, 0.4933, 1.2448, 7.3420),
    10.0: (0.9252, 1.2408, 0.9279, 0.4793, 1.4486, 10.0717),
}


def alpha_beta_dynamics() -> Iterator[Row]:
    """Compute what a filter with constant gains does.

    Yields:
        Transfer functions, stability, transients, random and dynamic errors, the optimum by both criteria.
    """
    yield from _transfers()
    yield _stability()
    yield from _jumps()
    yield from _random()
    yield from _dynamic()
    yield from _optima()


def _transfers() -> Iterator[Row]:
    plots = np.zeros(60)
    plots[0] = 1.0
    for alpha, beta in _PAIRS:
        predicted, smoothed, velocity = _run(alpha, beta, plots)
        followed = {
            "smoothed": smoothed,
            "velocity": velocity,
            "predicted": predicted,
            "residual": plots - predicted,
        }
        for output, equation in zip(OUTPUTS, ("(4.94)", "(4.95)", "(4.96)", "(4.97)"), strict=True):
            ours = lfilter(*transfer(output, alpha, beta), plots)
            difference = float(np.abs(ours - followed[output]).max())
            label = f"alpha = {alpha:g}, beta = {beta:g}, {equation}: largest difference from the recursion"
            yield Row(label, 0.0, 0.0, difference, _EXACT)


def _run(alpha: float, beta: float, plots: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    none = np.zeros(len(plots))
    gains = Gains(none + alpha, none + beta, none, none)
    return run_filter(gains, plots, (np.zeros(()), np.zeros(())))


def _stability() -> Row:
    alpha, beta = np.meshgrid(np.linspace(-0.49, 2.51, 61), np.linspace(-0.48, 4.52, 101))
    companion = np.zeros((*alpha.shape, 2, 2))
    companion[..., 0, 0], companion[..., 0, 1] = 2.0 - alpha - beta, alpha - 1.0
    companion[..., 1, 0] = 1.0
    poles = np.abs(np.linalg.eigvals(companion)).max(axis=-1)
    mismatches = float(np.count_nonzero(is_stable(alpha, beta) != (poles < 1.0)))
    label = "stability triangle: gains of 61 x 101 whose poles contradict it"
    finding = (
        "the triangle's base beta = 0, which the book counts in, has a pole on the unit circle"
    )
    return Row(label, 0, 0, mismatches, 0.0, finding)


def _jumps() -> Iterator[Row]:
    for (alpha, beta), values in _JUMPS.items():
        errors = speed_jump_errors(alpha, beta, len(values))
        for scan, (expected, ours) in enumerate(zip(values, errors, strict=True), start=1):
            label = f"alpha = {alpha:g}, beta = {beta:g}: error {scan} scans after a jump of speed"
            yield Row(label, None, expected, float(ours), 5.1e-5)
        ours = float(np.square(speed_jump_errors(alpha, beta, _LONG)).sum())
        label = f"alpha = {alpha:g}, beta = {beta:g}: sum of the squares of these errors"
        yield Row(label, None, float(speed_jump_square(alpha, beta)), ours, _EXACT)


def _random() -> Iterator[Row]:
    impulse = np.zeros(_LONG)
    impulse[0] = 1.0
    for (alpha, beta), values in _VARIANCES.items():
        for output, expected in zip(
            ("smoothed", "predicted", "velocity", "residual"), values, strict=True
        ):
            label = f"alpha = {alpha:g}, beta = {beta:g}: variance of the {_EQUATIONS[output]}"
            ours = float(random_variance(output, alpha, beta))
            yield Row(label, None, expected, ours, 5.1e-5)
            summed = float(np.square(lfilter(*transfer(output, alpha, beta), impulse)).sum())
            yield Row(f"{label}, summed responses", None, expected, summed, 5.1e-5)
    finding = "'several times' is true of large gains only"
    for (alpha, beta), expected in _TIMES.items():
        ratio = random_variance("predicted", alpha, beta) / random_variance("smoothed", alpha, beta)
        label = f"alpha = {alpha:g}, beta = {beta:g}: variance predicted over smoothed"
        yield Row(label, None, expected, float(ratio), 6e-3, finding)


def _dynamic() -> Iterator[Row]:
    time = np.arange(400.0)
    plots = 0.5 * time**2
    for alpha, beta in _PAIRS[:3]:
        predicted, smoothed, _ = _run(alpha, beta, plots)
        for output, equation, track in (
            ("smoothed", "(4.105)", smoothed),
            ("predicted", "(4.106)", predicted),
        ):
            label = f"alpha = {alpha:g}, beta = {beta:g}: lag of the {output} coordinate {equation}"
            ours = float(dynamic_error(output, alpha, beta))
            yield Row(label, None, float(plots[-1] - track[-1]), ours, 1e-6)


def _optima() -> Iterator[Row]:
    for intensity, values in _OPTIMA.items():
        smoothing = optimal_gains(intensity)
        predicting = optimal_gains(intensity, "predicted")
        for name, equation, found, expected in (
            ("smooth", "(4.111)", smoothing, values[:3]),
            ("predict", "(4.112)", predicting, values[3:]),
        ):
            what = f"Gamma^2 = {intensity:g}, to {name}"
            for quantity, value, ours in zip(
                ("alpha", "beta", "error"),
                expected,
                (found.alpha, found.beta, found.error),
                strict=True,
            ):
                yield Row(f"{what}: {quantity}, {equation}", None, value, ours, 5.1e-5)
