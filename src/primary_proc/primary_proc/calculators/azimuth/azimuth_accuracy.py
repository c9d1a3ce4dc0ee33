# SPDX-License-Identifier: Apache-2.0
"""Bias and spread of the azimuth that a binary detector's start and end give (Kuzmin 1967, § 3.3.6)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from primary_proc.automata.automaton_chain import StartEnd, start_end_distribution
from primary_proc.automata.book_chain import book_chain, zero_runs
from primary_proc.automata.burst_rule import BurstRule
from primary_proc.automata.program import Program

FloatArray = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class AzimuthError:
    """Error of the middle between start and end, in azimuth steps.

    Attributes:
        bias: mean of (lambda + mu) / 2 less the target's position (3.95), shape (...).
        std: its standard deviation (3.102), shape (...).
        bursts: mean number of bursts of a target, Pi, shape (...).
    """

    bias: FloatArray
    std: FloatArray
    bursts: FloatArray


def azimuth_error(
    rule: BurstRule,
    noise: float,
    signal: npt.ArrayLike,
    offset: npt.ArrayLike = 0.0,
    model: str = "exact",
) -> AzimuthError:
    """Bias and standard deviation of the start-end estimate (3.92).

    Source: Kuzmin 1967, (3.95)-(3.103). "kuzmin" cuts ends off at N_0 + k as (3.103) does; "exact" does not.

    Args:
        rule: of the detector.
        noise: probability p_N of a one in noise.
        signal: probability of a one on each position of the target, shape (..., positions); for "kuzmin" (positions,).
        offset: target's displacement from the middle position, in steps, broadcast with the leading axes.
        model: "exact" or "kuzmin".

    Returns:
        Errors, of the shape of the leading axes.

    Raises:
        ValueError: the model is neither, or the book has no form for the rule.
    """
    signal = np.asarray(signal, dtype=float)
    if model == "exact":
        joint = start_end_distribution(rule.automaton, noise, signal)
    elif model == "kuzmin":
        joint = _kuzmin_distribution(rule, noise, signal)
    else:
        raise ValueError(f"model {model!r} is neither exact nor kuzmin")
    return error_of(joint, signal.shape[-1], offset)


def error_of(joint: StartEnd, pulses: int, offset: npt.ArrayLike = 0.0) -> AzimuthError:
    """Errors from a joint distribution of start and end, (3.96)-(3.102).

    Args:
        joint: the distribution.
        pulses: positions of the target.
        offset: target's displacement from the middle position, in steps, broadcast with the leading axes.

    Returns:
        Errors, of the shape of the leading axes.
    """
    bursts = joint.probability.sum(axis=(-2, -1))
    middle = (joint.start[:, None] + joint.end) / 2.0
    target = (pulses + 1) / 2.0 + np.asarray(offset)
    mean = (joint.probability * middle).sum(axis=(-2, -1)) / bursts
    square = (joint.probability * middle**2).sum(axis=(-2, -1)) / bursts
    return AzimuthError(mean - target, np.sqrt(np.maximum(square - mean**2, 0.0)), bursts)


def _kuzmin_distribution(rule: BurstRule, noise: float, signal: FloatArray) -> StartEnd:
    """P_lambda P(mu | lambda) of (3.101), what is left lumped at mu = N_0 + k."""
    if not isinstance(rule, Program):
        raise ValueError(f"Kuzmin 1967 gives the ends of programs only, not of {rule}")
    chain = book_chain(rule)
    positions, zeros = len(signal), rule.zeros
    starts = chain.signal_states(noise, signal)[:, chain.detection]
    tail = np.concatenate([signal, np.full(zeros, noise)])
    resets = zero_runs(zeros, noise, tail)
    probability = np.zeros((positions, positions + zeros))
    for first in range(positions):
        left = 1.0
        for last in range(first + zeros, positions + zeros - 1):
            probability[first, last] = left * resets[last]
            left *= 1.0 - resets[last]
        probability[first, -1] = left
    return StartEnd(
        probability * starts[:, None],
        np.arange(1, positions + 1),
        np.arange(1, positions + zeros + 1),
    )
