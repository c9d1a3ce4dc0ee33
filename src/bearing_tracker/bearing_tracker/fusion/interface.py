# SPDX-License-Identifier: Apache-2.0
"""What a filter of two angle channels is told and what it answers; all targets at once.

Sizes: n targets, nx components of the state, ny components of a channel's reading; the active channel is in one of
M1 states (undisturbed, jammed...), the passive one in one of M2 (heard, silent...), state 0 always the undisturbed
one. A hypothesis is a pair (j, m) of them, number j * M2 + m, so there are M = M1 * M2.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, Protocol

import numpy as np
import numpy.typing as npt

from bearing_tracker.fusion.belief import Belief

FloatArray = npt.NDArray[np.float64]
BoolArray = npt.NDArray[np.bool_]
IntArray = npt.NDArray[np.intp]

Output = Literal["mmse", "map"]
"""How one estimate is made of M hypotheses: their mean, or the one that rule (24) picks."""


@dataclass(frozen=True, slots=True)
class Channel:
    """One angle channel and the Markov chain of its disturbances, (2) of Detkov 2022.

    In state j a reading is y = h_j x + G_j e, where e has the covariance R that the reading brings along: the noise
    covariance is G_j R G_j'. A jammed state whose noise has 100 times the variance has G = 10 I; a model with a
    given Gamma_yy has G = Gamma_yy and readings with R = I. A state without signal has h_j = 0 and keeps its noise,
    which then lies about the axis (see Motion).

    Attributes:
        transition: probability of state j after state i, one step later, shape (states, states), rows sum to 1.
        observation: h of each state, shape (states, ny, nx).
        noise: G of each state, shape (states, ny, ny).
        angles: which components of a reading are angles (radians, counted around the circle), shape (ny,).
    """

    transition: FloatArray
    observation: FloatArray
    noise: FloatArray
    angles: BoolArray

    def __post_init__(self) -> None:
        """Refuse what does not fit together.

        Raises:
            ValueError: shapes disagree, a number is not finite or a row of the chain does not sum to one.
        """
        states, ny, _ = self.observation.shape
        if self.transition.shape != (states, states):
            raise ValueError(f"{states} states need a {states} x {states} transition matrix")
        if self.noise.shape != (states, ny, ny) or self.angles.shape != (ny,):
            raise ValueError(f"noise and angles do not fit {states} states of {ny} components")
        for numbers in (self.transition, self.observation, self.noise):
            if not np.isfinite(numbers).all():
                raise ValueError("a channel's numbers must be finite")
        if (self.transition < 0.0).any() or not np.allclose(self.transition.sum(axis=1), 1.0):
            raise ValueError("rows of a transition matrix are probabilities and sum to one")

    @property
    def states(self) -> int:
        """Number of states that the channel can be in."""
        return len(self.transition)


@dataclass(frozen=True, slots=True)
class ChannelPair:
    """The two channels through which one state is seen.

    Attributes:
        active: the radar's own angle.
        passive: the angle of the target's emission.
        angles: which components of the state are angles, shape (nx,).
    """

    active: Channel
    passive: Channel
    angles: BoolArray

    def __post_init__(self) -> None:
        """Refuse channels that see different states.

        Raises:
            ValueError: the dimensions of the state disagree.
        """
        sizes = {self.active.observation.shape[2], self.passive.observation.shape[2]}
        if sizes != {len(self.angles)}:
            raise ValueError(f"the channels see states of different dimensions: {sorted(sizes)}")

    @property
    def hypotheses(self) -> int:
        """Number M of pairs of states."""
        return self.active.states * self.passive.states


@dataclass(frozen=True, slots=True)
class Motion:
    """How states move on to the time of the new readings; one for all targets or one per target.

    Attributes:
        transition: Phi, shape (nx, nx) or (n, nx, nx).
        noise: covariance Q of the process noise, Gamma Gamma' of the paper, shape as transition.
        axis: directions about which the model is linear, shape (n, nx), zero where the state is no angle: the model
            moves what an angle deviates from it, and readings without signal lie about it. None where the model
            works the same in every direction; then each target's own direction serves.
        active_chain: transition matrix of the active channel over this step, shape (M1, M1) or (n, M1, M1); None
            for the channel's own. Needed where steps have different lengths.
        passive_chain: the same of the passive channel, (M2, M2) or (n, M2, M2).
    """

    transition: FloatArray
    noise: FloatArray
    axis: FloatArray | None = None
    active_chain: FloatArray | None = None
    passive_chain: FloatArray | None = None


@dataclass(frozen=True, slots=True)
class Reading:
    """What one channel reported about each target in this step.

    A target of which it did not report is not a sign of disturbance: the channel then says nothing, under every
    hypothesis alike. The numbers of such rows are not looked at and may be NaN.

    Attributes:
        value: y, shape (n, ny).
        covariance: R of an undisturbed reading, shape (ny, ny) or (n, ny, ny).
        reported: whether the channel reported of the target, shape (n,).
        state: the channel's true state, shape (n,), where a simulation knows it; only the oracle reads it.
    """

    value: FloatArray
    covariance: FloatArray
    reported: BoolArray
    state: IntArray | None = None


@dataclass(frozen=True, slots=True)
class Loss:
    """What a wrong decision costs, (23) of Detkov 2022.

    Attributes:
        wrong: cost of deciding for a wrong hypothesis, alpha_L.
        squared_error: cost of a unit of squared error of the state under the right one, beta_L.
    """

    wrong: float = 1.0
    squared_error: float = 0.0


@dataclass(frozen=True, slots=True)
class Estimate:
    """One answer per target.

    Attributes:
        mean: of the state, angles in [-pi, pi), shape (n, nx).
        covariance: of its error, the spread of the hypotheses included, (25), shape (n, nx, nx).
        active: probability of each state of the active channel, shape (n, M1).
        passive: probability of each state of the passive channel, shape (n, M2).
        active_state: of the active channel in the hypothesis that rule (24) picks, shape (n,).
        passive_state: of the passive channel in it, shape (n,).
    """

    mean: FloatArray
    covariance: FloatArray
    active: FloatArray
    passive: FloatArray
    active_state: IntArray
    passive_state: IntArray


NO_LOSS_OF_ERROR = Loss()
"""Rule (24) then picks the most probable hypothesis."""


class ChannelFilter(Protocol):
    """Follows n targets through two channels that may be disturbed. It keeps nothing between calls."""

    channels: ChannelPair

    def start(
        self,
        mean: FloatArray,
        covariance: FloatArray,
        active: FloatArray | None = None,
        passive: FloatArray | None = None,
    ) -> Belief:
        """Begin with the same state under every hypothesis.

        Args:
            mean: of the state, shape (n, nx).
            covariance: of the state, shape (nx, nx) or (n, nx, nx).
            active: probability of each state of the active channel, shape (M1,) or (n, M1); None for equal ones.
            passive: probability of each state of the passive channel, shape (M2,) or (n, M2); None for equal ones.

        Returns:
            The belief in each target.

        Raises:
            ValueError: shapes disagree.
        """
        ...

    def step(
        self,
        belief: Belief,
        motion: Motion,
        active: Reading | None = None,
        passive: Reading | None = None,
    ) -> Belief:
        """Move on to the time of the readings and take them in.

        Without any reading this is the prediction, whose estimate serves a gate.

        Args:
            belief: at the previous time.
            motion: from then to now.
            active: what the active channel reported; None if of no target.
            passive: what the passive channel reported; None if of no target.

        Returns:
            The belief now; covariances symmetric and positive definite.
        """
        ...

    def estimate(
        self, belief: Belief, output: Output = "mmse", loss: Loss = NO_LOSS_OF_ERROR
    ) -> Estimate:
        """Make one answer of the hypotheses.

        Args:
            belief: at some time.
            output: `mmse` for the mean over the hypotheses, `map` for the hypothesis that rule (24) picks.
            loss: that the rule weighs.

        Returns:
            State, covariance and the channels' states.

        Raises:
            ValueError: a wrong hypothesis costs no more than the error under the right one, so the rule would prefer
                improbable ones; or there is no such output.
        """
        ...
