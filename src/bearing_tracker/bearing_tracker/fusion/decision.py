# SPDX-License-Identifier: Apache-2.0
"""One answer of many hypotheses: (22)-(25) of Detkov 2022."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from bearing_tracker.fusion.belief import Belief
from bearing_tracker.fusion.hypotheses import spread
from bearing_tracker.fusion.interface import ChannelPair, Estimate, Loss, Output
from bearing_tracker.fusion.tangent import on_tangent, wrapped

IntArray = npt.NDArray[np.intp]


def decide(belief: Belief, loss: Loss) -> IntArray:
    """Pick the hypothesis of least risk, (24).

    (24) is printed with a plus. Deciding for hypothesis h costs alpha (1 - P_h) + beta P_h tr R_h on average, which is
    alpha - P_h (alpha - beta tr R_h): the weight has a minus, as the paper's own remark that a larger error lowers the
    weight demands. (23) says what a wrong hypothesis costs only where both indices are wrong; here one is enough.

    Args:
        belief: in n targets.
        loss: alpha and beta.

    Returns:
        Number of a hypothesis, shape (n,).

    Raises:
        ValueError: alpha <= beta tr R of some hypothesis, so weights turn negative and improbable ones would win.
    """
    if loss.squared_error == 0.0 and loss.wrong > 0.0:
        return belief.log_probability.argmax(axis=1)
    weight = loss.wrong - loss.squared_error * np.einsum("nhii->nh", belief.covariance)
    if not (weight > 0.0).all():
        raise ValueError(
            "deciding for a wrong hypothesis must cost more than the error expected under the right one: "
            f"{loss.wrong} against {loss.wrong - weight.min():.3g}"
        )
    return (belief.log_probability + np.log(weight)).argmax(axis=1)


def estimate(channels: ChannelPair, belief: Belief, output: Output, loss: Loss) -> Estimate:
    """Make one answer per target.

    Args:
        channels: to whose states the hypotheses belong.
        belief: in n targets.
        output: see ChannelFilter.estimate.
        loss: for rule (24).

    Returns:
        State, its covariance (25) about whichever mean is reported, and the channels' states.

    Raises:
        ValueError: there is no such output, or the loss cannot be weighed.
    """
    if output not in ("mmse", "map"):
        raise ValueError(f"the output is mmse or map, not {output!r}")
    chosen = decide(belief, loss)
    state = on_tangent(channels, belief)
    probability = np.exp(state.log_probability)
    picked = state.mean[:, chosen, np.arange(len(belief))]
    centre = picked if output == "map" else (probability * state.mean).sum(axis=1)
    covariance = spread(
        probability[:, None],
        state.mean[:, :, None],
        state.covariance[:, :, :, None],
        centre[:, None],
    )
    pairs = probability.reshape(channels.active.states, channels.passive.states, -1)
    active, passive = np.divmod(chosen, channels.passive.states)
    return Estimate(
        mean=wrapped(state.reference + centre, channels.angles).T,
        covariance=covariance[:, :, 0].T,
        active=pairs.sum(axis=1).T,
        passive=pairs.sum(axis=0).T,
        active_state=active,
        passive_state=passive,
    )
