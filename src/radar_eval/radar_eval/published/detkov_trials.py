# SPDX-License-Identifier: Apache-2.0
"""The test of Detkov 2022, § 4: one angle, two channels, each disturbed for fifty steps of three hundred and fifty."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from bearing_tracker.fusion import ChannelFilter, ChannelPair, Motion, Output, Reading
from bearing_tracker.fusion.azimuth_channels import azimuth_channel, azimuth_pair
from bearing_tracker.fusion.guidance import guidance_covariance, guidance_motion

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.intp]

COLUMNS = ("active channel only", "passive channel only", "both channels")

_JAMMED = 100.0
_CHAIN = ((0.8, 0.2), (0.2, 0.8))


@dataclass(frozen=True, slots=True)
class Setup:
    """What is not the same in every run of the test.

    The angle is a plain number here: with D = 1 it would often leave the circle. The paper prints "<" at both ends of
    the disturbances, which leaves the steps at the ends undefined, and one row of each chain.

    Attributes:
        active_ratio: sqrt(D_x / D_y1).
        passive_ratio: sqrt(D_x / D_y2).
        decay: alpha, 1/s.
        frequency: mu, rad/s.
        steps: of one second.
    """

    active_ratio: float
    passive_ratio: float
    decay: float
    frequency: float = 0.16
    steps: int = 350

    @property
    def motion(self) -> Motion:
        """Of one step, D_x = 1."""
        return guidance_motion(1.0, self.frequency, self.decay, 1.0)

    @property
    def covariance(self) -> FloatArray:
        """Of the state at any time, shape (2, 2)."""
        return guidance_covariance(self.frequency, self.decay, 1.0)

    @property
    def channels(self) -> ChannelPair:
        """Jamming multiplies the variance of the active channel by 100, silence leaves the passive one its noise."""
        return azimuth_pair(
            azimuth_channel(_CHAIN, (1.0, _JAMMED), (1.0, 1.0), circular=False),
            azimuth_channel(_CHAIN, (1.0, 1.0), (1.0, 0.0), circular=False),
            circular=False,
        )

    @property
    def variances(self) -> tuple[FloatArray, FloatArray]:
        """Of the undisturbed readings, each shape (1, 1)."""
        return np.array([[self.active_ratio**-2]]), np.array([[self.passive_ratio**-2]])

    @property
    def states(self) -> tuple[IntArray, IntArray]:
        """Of the active and of the passive channel at each step, the first step being number 1, each shape (steps,)."""
        step = np.arange(1, self.steps + 1)
        jammed, silent = (step > 50) & (step <= 100), (step > 200) & (step <= 250)
        return jammed.astype(np.intp), silent.astype(np.intp)


REGRESSION = Setup(10.0, 5.0, 1.0 / 350.0)
"""Ratios ten times those printed, with which the table's first row comes out."""


@dataclass(frozen=True, slots=True)
class Trials:
    """Runs of the test.

    Attributes:
        truth: state, shape (steps, runs, 2).
        active: readings, shape (steps, runs).
        passive: readings, shape (steps, runs).
    """

    truth: FloatArray
    active: FloatArray
    passive: FloatArray


@dataclass(frozen=True, slots=True)
class Followed:
    """What a filter made of the runs; the three columns of the table are followed side by side.

    Attributes:
        mean: of the state by output, each shape (steps, columns, runs, 2).
        covariance: (25) of it by output, each shape (steps, columns, runs, 2, 2).
        undisturbed: probability that the active and the passive channel is, shape (steps, columns, runs, 2).
    """

    mean: dict[Output, FloatArray]
    covariance: dict[Output, FloatArray]
    undisturbed: FloatArray


def simulate(setup: Setup, runs: int, generator: np.random.Generator) -> Trials:
    """Draw runs.

    Args:
        setup: of the test.
        runs: number of them.
        generator: of noise.

    Returns:
        Truth and readings.
    """
    motion, states = setup.motion, setup.states
    state = generator.standard_normal((runs, 2)) @ np.linalg.cholesky(setup.covariance).T
    shaping = np.linalg.cholesky(motion.noise)
    truth = np.empty((setup.steps, runs, 2))
    for step in range(setup.steps):
        state = state @ motion.transition.T + generator.standard_normal((runs, 2)) @ shaping.T
        truth[step] = state
    noise = generator.standard_normal((2, setup.steps, runs))
    loud = np.where(states[0] == 1, np.sqrt(_JAMMED), 1.0)[:, None] / setup.active_ratio
    heard = np.where(states[1] == 1, 0.0, 1.0)[:, None]
    return Trials(
        truth,
        truth[..., 0] + loud * noise[0],
        heard * truth[..., 0] + noise[1] / setup.passive_ratio,
    )


def follow(
    setup: Setup, trials: Trials, tracker: ChannelFilter, outputs: Sequence[Output]
) -> Followed:
    """Give all runs to a filter, three times at once: with either channel alone and with both.

    Args:
        setup: of the test.
        trials: the runs.
        tracker: made for the channels of the setup.
        outputs: at least one of `mmse` and `map`.

    Returns:
        Its answers.
    """
    steps, runs = trials.active.shape
    columns = len(COLUMNS)
    shape = (steps, columns * runs)
    mean = {output: np.empty((*shape, 2)) for output in outputs}
    covariance = {output: np.empty((*shape, 2, 2)) for output in outputs}
    undisturbed = np.empty((*shape, 2))
    hears = np.repeat([[True, False, True], [False, True, True]], runs, axis=1)
    belief = tracker.start(np.zeros((columns * runs, 2)), setup.covariance)
    for step in range(steps):
        readings = [
            Reading(
                np.tile(values[step], columns)[:, None],
                variance,
                reported,
                np.full(columns * runs, states[step]),
            )
            for values, variance, reported, states in zip(
                (trials.active, trials.passive), setup.variances, hears, setup.states, strict=True
            )
        ]
        belief = tracker.step(belief, setup.motion, *readings)
        for output in outputs:
            estimate = tracker.estimate(belief, output)
            mean[output][step], covariance[output][step] = estimate.mean, estimate.covariance
        undisturbed[step, :, 0] = estimate.active[:, 0]
        undisturbed[step, :, 1] = estimate.passive[:, 0]
    parted = (steps, columns, runs)
    return Followed(
        {output: values.reshape(*parted, 2) for output, values in mean.items()},
        {output: values.reshape(*parted, 2, 2) for output, values in covariance.items()},
        undisturbed.reshape(*parted, 2),
    )


def rms_angle(followed: Followed, trials: Trials, output: Output) -> tuple[FloatArray, FloatArray]:
    """Root of the mean squared error of the angle over all steps and runs.

    Args:
        followed: a filter's answers.
        trials: the runs.
        output: which answer.

    Returns:
        (rms of each column, its standard error, from what the runs differ by), each shape (columns,).
    """
    error = followed.mean[output][..., 0] - trials.truth[:, None, :, 0]
    by_run = np.mean(error**2, axis=0)
    rms = np.sqrt(by_run.mean(axis=1))
    return rms, by_run.std(axis=1, ddof=1) / np.sqrt(by_run.shape[1]) / (2.0 * rms)


def normalised_error(followed: Followed, trials: Trials, output: Output) -> FloatArray:
    """Mean squared error of the state in units of the covariance, per component; one if that is right (NEES / 2).

    Args:
        followed: a filter's answers.
        trials: the runs.
        output: which answer.

    Returns:
        Shape (columns,).
    """
    error = followed.mean[output] - trials.truth[:, None]
    scaled = np.linalg.solve(followed.covariance[output], error[..., None])[..., 0]
    mean: FloatArray = 0.5 * (error * scaled).sum(axis=-1).mean(axis=(0, 2))
    return mean
