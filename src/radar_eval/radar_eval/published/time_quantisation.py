# SPDX-License-Identifier: Apache-2.0
"""Quantisation in time (Kuzmin 1967, § 2.2.1 and 2.3): samples, the time quantum and the delay of a pulse."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from scipy.integrate import quad
from scipy.optimize import minimize_scalar

from primary_proc.calculators.quantisation.noise_excursions import video_model
from primary_proc.calculators.quantisation.range_delay import (
    best_delay_threshold,
    crossing_delay_variance,
    potential_delay_variance,
)
from primary_proc.calculators.quantisation.range_sampling import (
    reconstruction_error,
    triangular_reconstruction_error,
    widened_probabilities,
)
from primary_proc.calculators.quantisation.surveillance_grid import SurveillanceGrid
from radar_eval.published.result import Row, to_digits

_DELAY = {
    (3.0, 1.0): 0.0724,
    (3.0, 1.5): 0.051,
    (3.0, 2.0): 0.0491,
    (3.0, 2.5): 0.0698,
    (5.0, 1.0): 0.0494,
    (5.0, 1.5): 0.0294,
    (5.0, 2.0): 0.0217,
    (5.0, 2.5): 0.0184,
    (10.0, 1.0): 0.0346,
    (10.0, 1.5): 0.0186,
    (10.0, 2.0): 0.0124,
    (10.0, 2.5): 0.0092,
}
_PLACES = 0.51e-4


def time_quantisation() -> Iterator[Row]:
    """Compute what quantisation in time does to a signal between its samples.

    Yields:
        Rows 3, 4, 8-11, 20, 21 and 39 of the chapter's numbers, and the tables behind them.
    """
    for gamma, expected in ((1, 0.41667), (2, 0.22917), (3, 0.15741), (5, 0.09667), (10, 0.04917)):
        label = f"§ 2.2.1: error between samples, triangular correlation, gamma = {gamma}"
        published = 5.0 / 12.0 if gamma == 1 else None
        closed = float(triangular_reconstruction_error(gamma))
        integral = reconstruction_error(lambda lag: 1.0 - np.abs(lag), 1.0 / gamma)
        yield Row(f"{label}, (2.6)", published, expected, closed, to_digits(expected))
        yield Row(f"{label}, (2.5)", published, expected, integral, to_digits(expected))
    yield Row(
        "§ 2.2.1: the error goes as 1 / gamma: gamma times it at 10 over that at 1", 1.0, 1.18,
        float(10.0 * triangular_reconstruction_error(10.0) / triangular_reconstruction_error(1.0)), 6e-3,
        "the product grows from 5/12 to its limit 1/2",
    )  # fmt: skip
    yield from _bandwidths()
    yield from _grid()
    for before, after, gain in ((0.8, 0.82, 2.5), (0.3, 0.37, 23.3)):
        signal, noise = widened_probabilities(before, 0.1, 2.0)
        label = f"§ 2.3.3, (2.26), twice the quantum, P_S1 = {before:g}, P_N1 = 0.1"
        yield Row(f"{label}: P_S2", after, after, float(signal), 1e-12)
        growth = 100.0 * (float(signal) / before - 1.0)
        yield Row(f"{label}: growth in per cent", gain, gain, growth, to_digits(gain))
        yield Row(f"{label}: P_N2", None, 0.19, float(noise), 1e-12)
    yield from _delay()


def _bandwidths() -> Iterator[Row]:
    def power(f: float, order: int) -> float:
        return float(f**order * np.exp(-2.0 * np.pi * f**2))

    moments = [quad(power, -np.inf, np.inf, args=(order,))[0] for order in (0, 2)]
    effective = 2.0 * np.pi * float(np.sqrt(moments[1] / moments[0]))
    yield Row(
        "§ 2.3.1, (2.20): effective bandwidth over that of the filter",
        1.7725,
        1.7725,
        effective,
        _PLACES,
    )
    omega = video_model("book").bandwidth
    ratio = omega / (np.pi * effective)
    yield Row("§ 2.4.2: delta-omega over pi times the effective bandwidth", 0.8, 0.7979, ratio, _PLACES,
              "0.8 is (2 / pi)^(1/2) rounded")  # fmt: skip
    physical = video_model("physical").bandwidth
    yield Row(
        "§ 2.3.1, (2.21): delta-omega over that of white noise behind (2.19)",
        1.0,
        2.5066,
        omega / physical,
        _PLACES,
        "(2.20) already holds 2 pi, and (2.21) takes it for hertz: printed noise changes 2.5 times too fast",
    )
    for model, expected, finding in (
        ("book", 5.17e-5, ""),
        (
            "physical",
            0.208,
            "white noise behind the filter keeps a fifth of its correlation; the printed formula has it at 5e-5",
        ),
    ):
        ours = float(video_model(model).correlation(np.ones(())))
        yield Row(
            f"§ 2.3.1: correlation at one pulse length, {model}",
            0.0,
            expected,
            ours,
            to_digits(expected),
            finding or '"practically 0" is 5e-5 by (2.21)',
        )


def _grid() -> Iterator[Row]:
    grid = SurveillanceGrid(2e-6, 1.0 / 500.0, 10.0, 300e3)
    for label, expected, ours, tolerance in (
        ("(2.23): range cells", 1001.0, grid.range_cells, 0.5),
        ("(2.24): azimuth step, deg", 0.072, float(np.degrees(grid.azimuth_step)), 1e-12),
        ("(2.25): cells", 5.0e6, grid.cells, 5e4),
        ("(1.27): N_0", 20.8, grid.pulses_in_burst(float(np.radians(1.5))), 0.05),
    ):
        yield Row(
            f"§ 2.3.2, 500 Hz, 10 s, 1.5 deg, 2 us, 300 km, {label}",
            None,
            expected,
            ours,
            tolerance,
        )


def _delay() -> Iterator[Row]:
    for (a, x), expected in _DELAY.items():
        ours = float(crossing_delay_variance(x, a))
        yield Row(
            f"§ 2.3.4, (2.42): variance of the delay, a_0 = {a:g}, x_0 = {x:g}",
            None,
            expected,
            ours,
            _PLACES,
        )
    for a, expected in ((3.0, 0.0354), (5.0, 0.0127), (10.0, 0.0032)):
        yield Row(
            f"§ 2.3.4, (2.44): least variance, a_0 = {a:g}",
            None,
            expected,
            float(potential_delay_variance(a)),
            _PLACES,
        )
    for model, loss in (("book", np.e / 2.0), ("physical", np.e)):
        found = minimize_scalar(
            lambda x, model=model: float(np.log(crossing_delay_variance(x, 1.0, model))),
            bounds=(0.05, 0.95),
            method="bounded",
            options={"xatol": 1e-8},
        )
        label = f"§ 2.3.4, {model} pulse"
        yield Row(f"{label}: best threshold over a_0, found", 0.607, 0.60653, float(found.x), 1e-5)
        yield Row(
            f"{label}: best threshold over a_0, formula",
            0.607,
            0.60653,
            float(best_delay_threshold(1.0)),
            1e-5,
        )
        lost = float(np.exp(found.fun) / potential_delay_variance(1.0))
        yield Row(f"{label}: variance there over the least", None, float(loss), lost, 1e-6)
    place = float(np.sqrt(-np.log(best_delay_threshold(1.0))))
    yield Row("§ 2.3.4: steepest point, pi^(1/2) nu", 0.707, 0.7071, place, _PLACES)
    yield Row(
        "§ 2.3.4, (2.44): least variance times a_0^2",
        1.0 / np.pi,
        0.31831,
        float(potential_delay_variance(1.0)),
        1e-5,
    )
    worse = crossing_delay_variance(2.0, 10.0) / crossing_delay_variance(
        best_delay_threshold(10.0), 10.0
    )
    yield Row(
        "§ 2.3.4: x_0 is not critical for timing a strong signal: variance at x_0 = 2, a_0 = 10 over the least", 1.0,
        2.86, float(worse), 6e-3,
        "true of a threshold that follows the signal as a_0 / 2, not of a fixed one",
    )  # fmt: skip
