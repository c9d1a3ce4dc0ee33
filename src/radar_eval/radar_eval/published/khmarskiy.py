# SPDX-License-Identifier: Apache-2.0
"""Bearings of a moving direction finder (Khmarskiy and Sushchinskiy 2015): its azimuth, its bounds, its filters.

The paper gives a model and no number. Expected are the values of an independent computation: of the bounds exactly, of
the filters with 500 runs, whose prior was drawn as one Gaussian of the Cartesian state, not about the first bearing.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np
import numpy.typing as npt

from bearing_tracker.emitters import (
    DEFAULT_FILTER,
    FILTERS,
    Belief,
    CorrelatedError,
    FilterSettings,
)
from bearing_tracker.emitters.sight import sight
from radar_common.frames import wrap_pi
from radar_eval.published.result import Row
from radar_eval.studies.emitter_location import STEADY
from radar_eval.studies.emitter_location_scenes import LocationScene, aircraft, ship
from radar_eval.studies.emitter_location_trials import LocationOutcome, try_filter

FloatArray = npt.NDArray[np.float64]

_POINTS, _RUNS = 200_000, 500
_FOUR_SIGMAS = 4.0
_MISPRINT = (
    "the signs must be of the relative coordinates, and the first one of z: as printed the bracket belongs to the "
    "arctangent of X/Z"
)


def emitter_location() -> Iterator[Row]:
    """Compute the azimuth by all readings of the formula, bounds, and errors of the filters.

    Yields:
        Shares of wrong azimuths, bounds in metres, ratios to the bound, and filters beside the independent computation.
    """
    yield from _azimuths()
    yield from _bounds()
    yield from _default_filter()
    yield from _other_filters()
    yield from _correlated()


def printed_azimuth(sign_of: FloatArray, relative: FloatArray, first: int) -> FloatArray:
    """Compute the paper's azimuth, beta = arctan(Z/X) + pi/2 [2 - sgn a - sgn x sgn z], in its axes.

    Args:
        sign_of: the coordinates (x north, z east) that the signs are of, shape (n, 2).
        relative: (X, Z), position less that of the direction finder, metres, shape (n, 2).
        first: which coordinate a is: 0 for x as printed, 1 for z.

    Returns:
        Radians, shape (n,).
    """
    signs = np.sign(sign_of)
    bracket = 2.0 - signs[:, first] - signs[:, 0] * signs[:, 1]
    return np.arctan(relative[:, 1] / relative[:, 0]) + 0.5 * np.pi * bracket


def _azimuths() -> Iterator[Row]:
    random = np.random.default_rng(4)
    emitter, finder = random.uniform(-1.0, 1.0, (2, _POINTS, 2))
    relative = emitter - finder
    # The only place where the paper's axes meet ours: its (x, z) is our (y, x).
    true = sight(relative[:, ::-1]).azimuth
    for text, sign_of, first, expected, finding in (
        ("as printed", emitter, 0, 0.499, _MISPRINT),
        ("relative coordinates", relative, 0, 0.499, _MISPRINT),
        ("first sign of z", emitter, 1, 0.25, _MISPRINT),
        ("both corrected", relative, 1, 0.0, ""),
    ):
        wrong = np.abs(wrap_pi(printed_azimuth(sign_of, relative, first) - true)) > 1e-6
        # The expected share was itself found with as many points, and is given to three digits.
        sampling = _FOUR_SIGMAS * float(np.sqrt(2.0 * expected * (1.0 - expected) / _POINTS))
        label = f"share of wrong azimuths, {text}"
        yield Row(
            label, 0.0, expected, float(wrong.mean()), sampling + 5e-4 * bool(expected), finding
        )


def _bounds() -> Iterator[Row]:
    for scene, look, expected in (
        (ship(), -1, 52.0),
        (aircraft(), -1, 4435.0),
        (aircraft("A, stationary", speed=0.0), -1, 3804.0),
        (aircraft("A, 40 degrees", turn_deg=40.0), -1, 3617.0),
        (aircraft("A, no manoeuvre", turn_deg=0.0), 100, 5749.0),
        (aircraft("A, no manoeuvre", turn_deg=0.0), 200, 7482.0),
    ):
        covariance = scene.bound()[look]
        when = "at the end" if look < 0 else f"after {look} bearings"
        ours = float(np.sqrt(covariance[0, 0] + covariance[1, 1]))
        yield Row(f"{scene.name}: Cramer-Rao bound {when}, m", None, expected, ours, 0.51)


def _default_filter() -> Iterator[Row]:
    for scene, most, lost, nees in ((ship(), 1.35, 0.0, 1.2), (aircraft(), 1.25, 0.002, 1.03)):
        done = _run(scene, DEFAULT_FILTER)
        half = 0.5 * (most - 0.9)
        label = f"{scene.name}: {DEFAULT_FILTER}, RMS error over the bound, 0.9 to {most:g}"
        yield Row(label, None, most - half, done.rms / done.bound, half)
        label = f"{scene.name}: {DEFAULT_FILTER}, share of diverged runs"
        yield Row(label, None, lost, done.diverged, _of_shares(lost))
        label = f"{scene.name}: {DEFAULT_FILTER}, NEES / 4"
        yield Row(label, None, nees, done.nees, nees * _of_nees(done))


def _other_filters() -> Iterator[Row]:
    scene = ship()
    for name, median, lost in (
        ("ekf", 79.0, 0.142),
        ("modified_polar", 137.0, 0.258),
        ("ukf", 59.0, 0.048),
        ("ckf", 60.0, 0.03),
    ):
        done = _run(scene, name, gaussian=True)
        # The median m of n errors of Rayleigh's law has a deviation of 0.72 m / sqrt(n).
        tolerance = _FOUR_SIGMAS * np.sqrt(2.0) * 0.72 * median / np.sqrt(_RUNS)
        label = f"R: {name} from a drawn state, median error, m"
        yield Row(label, None, median, done.median, float(tolerance))
        label = f"R: {name} from a drawn state, share of diverged runs"
        yield Row(label, None, lost, done.diverged, _of_shares(lost))
    for name, rms in (("ukf", 5829.0), ("ckf", 5805.0)):
        done = _run(aircraft(), name, gaussian=True)
        label = f"A: {name} from a drawn state, RMS error, m"
        tolerance = _FOUR_SIGMAS * np.sqrt(2.0) * done.rms_std
        yield Row(label, None, rms, done.rms, float(tolerance))


def _correlated() -> Iterator[Row]:
    scene = aircraft("A, correlated errors", lasting_std_deg=0.8)
    error = CorrelatedError(std=scene.lasting_std, time=scene.lasting_time)
    inflated = FilterSettings(acceleration_std=STEADY.acceleration_std, correlated=error)
    for text, settings, nees, rms in (
        ("taken for white", STEADY, 5.7, 7679.0),
        ("inflated", inflated, 0.88, 5814.0),
    ):
        done = _run(scene, DEFAULT_FILTER, settings)
        label = f"{scene.name} {text}: {DEFAULT_FILTER}"
        tolerance = float(_FOUR_SIGMAS * np.sqrt(2.0) * done.rms_std)
        yield Row(f"{label}, RMS error, m", None, rms, done.rms, tolerance)
        yield Row(f"{label}, NEES / 4", None, nees, done.nees, nees * _of_nees(done))


def _run(
    scene: LocationScene, name: str, settings: FilterSettings = STEADY, *, gaussian: bool = False
) -> LocationOutcome:
    seed = 4
    begun = _drawn(scene, seed) if gaussian else None
    return try_filter(scene, name, FILTERS[name](settings), _RUNS, seed, begun)


def _drawn(scene: LocationScene, seed: int) -> Callable[[Belief], Belief]:
    """Let filters start from states drawn about the truth, first bearing and all."""
    covariance = scene.bound()[0]
    random = np.random.default_rng(seed + 100)

    def begun(belief: Belief) -> Belief:
        drawn = random.multivariate_normal(scene.path[0], covariance, len(belief))
        return replace(
            belief,
            mean=drawn[:, np.newaxis, np.newaxis],
            covariance=np.tile(covariance, (len(belief), 1, 1, 1, 1)),
        )

    return begun


def _of_shares(expected: float) -> float:
    """Four deviations of the difference of two shares, each of 500 runs."""
    return float(_FOUR_SIGMAS * np.sqrt(2.0 * expected * (1.0 - expected) / _RUNS))


def _of_nees(done: LocationOutcome) -> float:
    """Share by which NEES may be off: its sampling error and that of a density which is not Gaussian."""
    return 0.25 + float(_FOUR_SIGMAS * np.sqrt(2.0 / (4.0 * done.runs)))
