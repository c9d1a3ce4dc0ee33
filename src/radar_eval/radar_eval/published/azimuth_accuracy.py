# SPDX-License-Identifier: Apache-2.0
"""Azimuth accuracy of the program detector 3/4-2 (Kuzmin 1967, § 3.3.6, figures 3.29-3.30)."""

from __future__ import annotations

from collections.abc import Iterator

from primary_proc.automata.program import Program
from primary_proc.calculators.azimuth_accuracy import AzimuthError, azimuth_error
from primary_proc.calculators.burst_shape import burst_shape
from primary_proc.calculators.false_alarms import noise_probability
from primary_proc.calculators.single_pulse import steady_probability, threshold_for
from radar_eval.published.result import Row

_PROGRAM = Program(3, 4, 2)
_SIGMA = {
    (4e-3, "kuzmin"): {2.0: 1.40, 3.0: 0.95, 4.0: 0.75},
    (4e-3, "exact"): {2.0: 1.44, 3.0: 1.02, 4.0: 0.85},
    (2e-4, "kuzmin"): {2.0: 1.08, 3.0: 0.79, 4.0: 0.61},
    (2e-4, "exact"): {2.0: 1.09, 3.0: 0.81, 4.0: 0.65},
}
_SIGMA_OF_15 = {2.0: 1.86, 3.0: 1.30, 4.0: 1.02}
_SIGMA_TOLERANCE = 6e-3


def azimuth_accuracies() -> Iterator[Row]:
    """Compute spread, bias and number of starts.

    Yields:
        The rows for 3/4-2.
    """
    for (false_alarm, model), points in _SIGMA.items():
        for amplitude, expected in points.items():
            ours = float(_error(false_alarm, amplitude, model=model).std)
            label = (
                f"P_fa = {false_alarm:g}, a_0 = {amplitude:g}, N_0 = 11: sigma in steps, {model}"
            )
            yield Row(label, None, expected, ours, _SIGMA_TOLERANCE)
    for amplitude, expected in _SIGMA_OF_15.items():
        ours = float(_error(4e-3, amplitude, pulses=15, model="kuzmin").std)
        label = f"P_fa = 0.004, a_0 = {amplitude:g}, N_0 = 15: sigma in steps, kuzmin"
        yield Row(label, None, expected, ours, _SIGMA_TOLERANCE)
    error = _error(4e-3, 3.0)
    yield Row(
        "P_fa = 0.004, a_0 = 3: bias in steps", 2.5, 2.176, float(error.bias), 2e-3,
        "(m + k - 1)/2 counts m positions up to the start, but 3/4-2 mostly starts on three ones in a row: l = 3 "
        "belongs in the place of m",
    )  # fmt: skip
    yield Row("nominal bias with l for m, in steps", None, 2.0, _PROGRAM.nominal_bias, 1e-12)
    yield Row("P_fa = 0.004, a_0 = 3: starts a burst", None, 0.89, float(error.bursts), 6e-3)
    several = [
        float(_error(4e-3, 2.5, pulses=15, pattern="gaussian", model=model).bursts)
        for model in ("kuzmin", "exact")
    ]
    yield Row(
        "Gaussian pattern, N_0 = 15, a_0 = 2.5: starts a burst can exceed one (1 = yes)", 1.0, 1.0,
        float(min(several) > 1.0), 0.0,
    )  # fmt: skip


def _error(
    false_alarm: float,
    amplitude: float,
    *,
    pulses: int = 11,
    pattern: str = "sinc2",
    model: str = "exact",
) -> AzimuthError:
    noise = noise_probability(_PROGRAM, false_alarm, "kuzmin")
    signal = steady_probability(threshold_for(noise), amplitude * burst_shape(pattern, pulses))
    return azimuth_error(_PROGRAM, noise, signal, model=model)
