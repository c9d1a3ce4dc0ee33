# SPDX-License-Identifier: Apache-2.0
"""The moments of the book's models of motion and wander, from targets that move by them (Kuzmin 1967, § 4.2)."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import numpy.typing as npt

from radar_eval.published.result import Row
from radar_sim.motion import Fleet, Path
from radar_sim.motion.correlated import CorrelatedMotion, WanderSection
from radar_sim.motion.increments import FirstIncrementsMotion, SecondIncrementsMotion
from radar_sim.motion.model import MotionModel
from radar_sim.motion.polynomials import PiecewiseMotion
from radar_sim.motion.sections import draw_paths
from radar_sim.motion.speed_course import ArcsMotion

FloatArray = npt.NDArray[np.float64]
ComplexArray = npt.NDArray[np.complex128]

_TARGETS, _SEED = 600, 45
_SPEED = 200.0
_RATE = 0.1
_SWITCHED = 300.0


def motion_models() -> Iterator[Row]:
    """Move targets and measure how they do.

    Yields:
        Correlations of acceleration and wander, growth of variance, size of curvature.
    """
    yield from _accelerations()
    yield from _increments()
    wander = WanderSection(std=40.0, correlation_time=12.0, step=4.0, duration=_SWITCHED)
    offset, _ = _flown(None, np.arange(0.0, _SWITCHED, 4.0), wander)
    independent = 2 * _TARGETS * _SWITCHED / 24.0
    yield _variance("wander: variance in m² of each component (4.8)", 1600.0, offset, independent)
    for steps in (1, 2, 4):
        label = f"wander: correlation {steps} steps of a third of its time apart (4.8)"
        yield _correlation(label, np.exp(-steps / 3.0), offset, steps, independent)
    yield _curvature()


def _accelerations() -> Iterator[Row]:
    # Acceleration is measured over a moment in which it hardly ever changes.
    begin, moment = np.arange(0.0, _SWITCHED - 1.0), 0.01
    times: FloatArray = (begin[:, None] + [0.0, moment]).ravel()
    models: dict[str, MotionModel] = {
        "Poisson switching of acceleration": PiecewiseMotion(
            acceleration_std=3.0, leg_duration=1.0 / _RATE, duration=_SWITCHED
        ),
        "Markov acceleration": CorrelatedMotion(
            acceleration_std=3.0, correlation_time=1.0 / _RATE, step=1.0, duration=_SWITCHED
        ),
    }
    independent = 2 * _TARGETS * _SWITCHED * _RATE / 2.0
    for name, model in models.items():
        _, velocity = _flown(model, times)
        acceleration = np.diff(velocity, axis=1)[:, ::2] / moment
        for lag in (1, 4, 10):
            label = f"{name}: correlation over {lag} s at 0.1 changes a second (4.4)"
            expected = float(np.exp(-_RATE * lag))
            yield _correlation(label, expected, acceleration, lag, independent)


def _increments() -> Iterator[Row]:
    steps = 50
    times: FloatArray = np.multiply(4.0, np.arange(steps + 1), dtype=float)
    first = FirstIncrementsMotion(step=4.0, increment_std=30.0, duration=200.0)
    offset, _ = _flown(first, times)
    label = f"independent first increments of 30 m: variance in m² after {steps}"
    yield _variance(label, 900.0 * steps, offset[:, steps:], 2 * _TARGETS)
    second = SecondIncrementsMotion(step=4.0, increment_std=6.0, duration=200.0)
    offset, _ = _flown(second, times)
    growth = 36.0 * steps * (steps + 1) * (2 * steps + 1) / 6.0
    label = f"independent second increments of 6 m: variance in m² after {steps}"
    yield _variance(label, growth, offset[:, steps:], 2 * _TARGETS)
    label = "independent second increments: correlation of neighbouring first ones after 50"
    moved = np.diff(offset, axis=1)
    expected = np.sqrt((steps - 1) / steps)
    found = np.mean((moved[:, -1] * np.conj(moved[:, -2])).real)
    found /= np.sqrt(np.mean(np.abs(moved[:, -1]) ** 2) * np.mean(np.abs(moved[:, -2]) ** 2))
    # A sample correlation scatters by (1 - r²) over the root of the number.
    tolerance = 4.0 * (1.0 - expected**2) / np.sqrt(2 * _TARGETS)
    yield Row(label, None, float(expected), float(found), float(tolerance))


def _curvature() -> Row:
    step, std = 1e-3, 2e-4
    model = ArcsMotion(curvature_std=std, leg_duration=20.0, duration=100.0)
    _, velocity = _flown(model, np.array([0.0, step]))
    turn = np.angle(velocity[:, 1] / velocity[:, 0])
    curvature = turn / (step * _SPEED)
    found = float(np.sqrt(np.mean(curvature**2)))
    tolerance = 4.0 * std * np.sqrt(0.5 / _TARGETS)
    return Row("arcs at constant speed: rms curvature in 1/m (4.6)", None, std, found, tolerance)


def _flown(
    model: MotionModel | None, times: FloatArray, wander: WanderSection | None = None
) -> tuple[ComplexArray, ComplexArray]:
    """Offset from the straight way and velocity, shape (targets, times)."""
    paths = [Path(0.0, 0.0, _SPEED, 0.0)] * _TARGETS
    fleet = Fleet(draw_paths(paths, model, wander, np.random.default_rng(_SEED)))
    target = np.repeat(np.arange(_TARGETS)[:, None], len(times), axis=1)
    state = fleet.state(target, np.broadcast_to(times, target.shape))
    return state.y - _SPEED * times + 1j * state.x, state.vy + 1j * state.vx


def _variance(label: str, expected: float, values: ComplexArray, independent: float) -> Row:
    found = float(np.mean(np.abs(values) ** 2)) / 2.0
    return Row(label, None, expected, found, 4.0 * expected * float(np.sqrt(2.0 / independent)))


def _correlation(
    label: str, expected: float, values: ComplexArray, lag: int, independent: float
) -> Row:
    product = values[:, lag:] * np.conj(values[:, :-lag])
    found = float(np.mean(product.real) / np.mean(np.abs(values) ** 2))
    return Row(label, None, expected, found, 4.0 / float(np.sqrt(independent)))
