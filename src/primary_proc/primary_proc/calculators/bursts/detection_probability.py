# SPDX-License-Identifier: Apache-2.0
"""Probability that a binary detector detects a target's burst."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from primary_proc.automata.automaton_chain import first_detection
from primary_proc.automata.book_chain import book_chain
from primary_proc.automata.burst_rule import BurstRule
from primary_proc.calculators.pulse.burst_shape import burst_shape
from primary_proc.calculators.pulse.single_pulse import threshold_for
from primary_proc.calculators.pulse.target_models import TARGETS

FloatArray = npt.NDArray[np.float64]

_OFFSETS = np.array([-0.375, -0.125, 0.125, 0.375])


def detection_probability(
    rule: BurstRule, noise: float, signal: npt.ArrayLike, model: str = "exact"
) -> float:
    """Probability of at least one detection on the positions of a target, noise before it.

    Source: Kuzmin 1967, (3.77)-(3.91) for "kuzmin"; the automaton's own absorbing chain for "exact".

    Args:
        rule: of the detector.
        noise: probability p_N of a one in noise.
        signal: probability of a one on each position of the target, shape (positions,).
        model: "exact" or "kuzmin".

    Returns:
        Probability.

    Raises:
        ValueError: the model is neither, or the book has no form for the rule.
    """
    if model == "exact":
        return float(first_detection(rule.automaton, noise, signal))
    if model != "kuzmin":
        raise ValueError(f"model {model!r} is neither exact nor kuzmin")
    chain = book_chain(rule)
    detection = chain.signal_states(noise, signal)[:, chain.detection]
    lag = chain.lag + 1
    detected = np.zeros(len(detection) + lag)
    for position, now in enumerate(detection, start=lag):
        detected[position] = detected[position - 1] + now * (1.0 - detected[position - lag])
    return float(min(detected[-1], 1.0))


def detection_in_the_beam(
    rule: BurstRule, noise: float, pattern: str, pulses: float, snr_db: npt.ArrayLike, target: str
) -> FloatArray:
    """Probability that a target in a rotating beam is detected, mean over its place between two pulses.

    Args:
        rule: of the detector.
        noise: probability p_N of a one in noise.
        pattern: antenna pattern's name.
        pulses: N_0.
        snr_db: power over the mean noise power at the beam's axis, any shape.
        target: name in `TARGETS`.

    Returns:
        Probability, same shape.
    """
    shape = burst_shape(pattern, pulses, _OFFSETS, book=False)
    threshold = threshold_for(noise)
    model = TARGETS[target]

    def detected(ratio_db: FloatArray) -> FloatArray:
        peak = np.sqrt(2.0) * 10.0 ** (ratio_db / 20.0)
        signal = model.single_pulse(threshold, peak[:, None, None] * shape)
        return first_detection(rule.automaton, noise, signal).mean(axis=-1)

    return model.average(detected, snr_db)
