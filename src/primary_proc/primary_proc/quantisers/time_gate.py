# SPDX-License-Identifier: Apache-2.0
"""Quantisers that work between samples, on waveforms far finer than the cells: what a gate sees, and what a circuit."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

BoolArray = npt.NDArray[np.bool_]


def gate_levels(
    envelope: npt.NDArray[np.floating], thresholds: npt.ArrayLike, samples_per_gate: int
) -> npt.NDArray[np.int64]:
    """Highest level that the envelope reaches anywhere within each gate: the functional quantiser.

    Source: Kuzmin 1967, § 2.3.2; with one threshold, (2.47) is the probability of a one.

    Args:
        envelope: waveforms of sweeps, shape (sweeps, samples).
        thresholds: increasing, shape (m,).
        samples_per_gate: samples of one period of the clock, the gate being as long.

    Returns:
        Thresholds exceeded, 0 to m, shape (sweeps, whole gates).

    Raises:
        ValueError: a gate has no sample.
    """
    peak = _gates(envelope, samples_per_gate).max(axis=-1)
    return np.searchsorted(np.asarray(thresholds, dtype=float), peak, side="left")


def circuit_ones(
    envelope: npt.NDArray[np.floating], threshold: float, samples_per_gate: int
) -> BoolArray:
    """Ones of the quantiser circuit: threshold, a short pulse at each rise over it, two triggers, two clocks.

    A rise sets the first trigger; the clock at a gate's start passes it on to the second, which is the output; the
    clock at the gate's middle resets both. So a one comes one gate late, and two things differ from `gate_levels`: an
    envelope that is already over the threshold at a gate's start makes no one there, and a rise in the first half of a
    gate is lost where the gate before made a one.

    Source: Kuzmin 1967, § 2.4.4.

    Args:
        envelope: waveforms of sweeps, shape (sweeps, samples); what came before counts as below the threshold only if
            the first sample is.
        threshold: U_0.
        samples_per_gate: samples of one period of the clock, an even number.

    Returns:
        Whether the output is on from the start of each gate to its middle, shape (sweeps, whole gates + 1): the last
        gate's rises come out behind it.

    Raises:
        ValueError: a gate has no whole number of samples in each half.
    """
    if samples_per_gate % 2:
        raise ValueError(f"a gate of {samples_per_gate} samples has no middle")
    over: BoolArray = np.asarray(envelope > threshold)
    rises = np.zeros_like(over)
    rises[:, 1:] = over[:, 1:] & ~over[:, :-1]
    halves: BoolArray = _gates(rises, samples_per_gate // 2).max(axis=-1)
    gates = halves.shape[1] // 2
    early, late = halves[:, : 2 * gates : 2], halves[:, 1 : 2 * gates : 2]
    return np.concatenate([np.zeros((len(over), 1), dtype=bool), _triggers(early, late)], axis=1)


def threshold_step(
    threshold: float, crossings: int, allowed: float, responsiveness: float = 0.5
) -> float:
    """Threshold for the next interval, from the rises of noise that were counted in this one.

    The book's automatic control compares them with an allowed number and gives no law. This takes the step that noise
    asks for, or a share of it, so that the scatter of the count moves the threshold less.

    Source: Kuzmin 1967, § 2.4.4, for the purpose.

    Args:
        threshold: x_0 in units of the noise's sigma as it was taken to be.
        crossings: counted.
        allowed: mean number wanted, over 0.
        responsiveness: share of the step, in (0, 1].

    Returns:
        x_0 for the next interval.
    """
    # Noise rises over x about exp(-x^2 / 2) times; one count more on both sides makes no count harmless.
    excess = math.log((crossings + 1.0) / (allowed + 1.0))
    return math.sqrt(max(threshold**2 + 2.0 * responsiveness * excess, 0.0))


def _triggers(early: BoolArray, late: BoolArray) -> BoolArray:
    """Output after each gate: on after a rise in its second half, else after one in its first half if it was off."""
    gate = np.arange(early.shape[1])
    toggles = early & ~late
    # The state is known at once wherever there was a late rise, or none; from there it alternates.
    known = np.maximum.accumulate(np.where(toggles, -1, gate), axis=1)
    start = np.take_along_axis(late, np.maximum(known, 0), axis=1) & (known >= 0)
    return start ^ ((gate - known) % 2 == 1)


def _gates(samples: npt.NDArray, length: int) -> npt.NDArray:
    if length < 1:
        raise ValueError("a gate needs at least one sample")
    sweeps, points = samples.shape
    return samples[:, : points // length * length].reshape(sweeps, -1, length)
