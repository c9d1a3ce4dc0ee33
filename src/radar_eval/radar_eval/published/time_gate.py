# SPDX-License-Identifier: Apache-2.0
"""Noise in a time gate, and the quantiser circuit (Kuzmin 1967, § 2.4.2 and 2.4.4)."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from primary_proc.calculators.quantisation.noise_excursions import (
    crossing_rate,
    false_detection_in_gate,
    long_excursions,
    mean_excursion,
    video_model,
)
from primary_proc.quantisers.time_gate import circuit_ones, gate_levels
from radar_eval.published.gate_video import SWEEPS, gate_video, scatter
from radar_eval.published.result import Row
from radar_sim.waveform import WaveformGenerator

_SEED = 5
_PLACES = 0.51e-4
_FALSE = {
    1.5: ((0.3247, 0.5614, 0.7151), 0.849),
    2.0: ((0.1353, 0.3197, 0.4648), 0.528),
    2.5: ((0.0439, 0.1326, 0.2131), 0.225),
    3.0: ((0.0111, 0.0399, 0.0678), 0.069),
}


def time_gate() -> Iterator[Row]:
    """Compute how often noise enters a gate.

    Yields:
        Rows 26-28 and 40 of the chapter's numbers, and the table of § 2.4.2.
    """
    yield from _noise()
    yield from _excursions()
    yield from _circuit()


def _noise() -> Iterator[Row]:
    for x, (values, simulated) in _FALSE.items():
        for gate, expected in zip((0.0, 0.5, 1.0), values, strict=True):
            formula = float(false_detection_in_gate(x, gate))
            yield Row(
                f"§ 2.4.2, (2.59): P_fa, x_0 = {x:g}, nu = {gate:g}",
                None,
                expected,
                formula,
                1.01e-4,
            )
        ours = gate_video("book").detected(0.0, 1.0, 0.0, x)
        yield Row(
            f"§ 2.4.2: the same by simulated video, x_0 = {x:g}, nu = 1",
            None,
            simulated,
            ours,
            scatter(simulated),
        )
    for x, published, expected in ((1.5, 2.0, 2.2), (3.0, 6.0, 6.11)):
        ours = float(false_detection_in_gate(x, 1.0) / false_detection_in_gate(x, 0.0))
        label = f"§ 2.4.2, figure 2.13: growth of P_fa from nu = 0 to 1, x_0 = {x:g}"
        yield Row(label, published, expected, ours, 6e-3,
                  "read from a curve; with white noise it would be 1.61 and 3.07")  # fmt: skip
    for model in ("book", "physical"):
        video = video_model(model)
        for x in (1.0, 2.0, 3.0):
            envelope = gate_video(model).envelope[0.0]
            over = envelope > x
            rises = np.count_nonzero(over[:, 1:] & ~over[:, :-1], axis=1) / 2.0
            error = 4.0 * rises.std() / np.sqrt(SWEEPS) + 0.01 * rises.mean()
            formula = video.bandwidth / np.sqrt(2.0 * np.pi) * x * np.exp(-(x**2) / 2.0)
            yield Row(
                f"§ 2.4.2, (2.62), {model}: crossing rate of simulated video, x_0 = {x:g}",
                None,
                float(formula),
                float(rises.mean()),
                float(error),
            )
    simple = np.sqrt(np.pi) * 2.0 * np.exp(-2.0)
    yield Row(
        "§ 2.4.2, (2.62a): crossing rate, x_0 = 2",
        float(simple),
        float(simple),
        float(crossing_rate(2.0)),
        1e-9,
    )
    stay = float(mean_excursion(2.0))
    yield Row("§ 2.4.2, (2.63a): mean excursion, x_0 = 2", 0.2821, 0.2821, stay, _PLACES)


def _excursions() -> Iterator[Row]:
    yield Row(
        "§ 2.4.2, (2.65): share of excursions over 0.2, x_0 = 3", float(long_excursions(0.2, 3.0, law="kuzmin")), 0.411,
        float(long_excursions(0.2, 3.0)), 6e-4,
        "(2.65) has the mean 1 / N, the time between excursions, against (2.63); this is the parabolic form",
    )  # fmt: skip
    # A longer stretch than one pulse length, for excursions that its ends do not cut.
    generator = WaveformGenerator(
        video_model("book"), 0.0, 20.0, 0.01, np.random.default_rng(_SEED)
    )
    envelope = np.abs(generator.noise(2000))
    for x, expected in ((3.0, 0.4), (2.0, 0.64)):
        edges = np.diff((envelope > x).astype(np.int8), axis=1, prepend=0, append=0)
        samples = np.nonzero(edges == -1)[1] - np.nonzero(edges == 1)[1]
        # Twenty samples are as often from a shorter excursion as from a longer one.
        share = float(np.mean(samples > 20) + np.mean(samples == 20) / 2.0)
        error = 4.0 * float(np.sqrt(0.25 / len(samples))) + 5e-3
        label = f"§ 2.4.2: share of excursions over 0.2 in simulated video, x_0 = {x:g}"
        yield Row(label, None, expected, share, error)


def _circuit() -> Iterator[Row]:
    both_clocks = 2.0 / 2e-6
    yield Row(
        "§ 2.4.4: triggers of 2 MHz follow both clocks of a gate of 2 us (1 = yes)", 1.0, 1.0,
        float(both_clocks <= 2e6), 0.0, "hardware of its time, 10 MHz of the limiter included: not checkable further",
    )  # fmt: skip
    grid = np.arange(40)
    envelope = np.where((grid >= 3) & (grid < 33), 3.0, 0.0)[None]
    whole, rises = gate_levels(envelope, [2.0], 10).sum(), circuit_ones(envelope, 2.0, 10).sum()
    yield Row(
        "§ 2.4.4: ones of a level that stays over the threshold for four gates: functional quantiser",
        None,
        4.0,
        float(whole),
        0.0,
    )
    yield Row(
        "§ 2.4.4: the same of the circuit", 4.0, 1.0, float(rises), 0.0,
        "the circuit registers rises only, (2.47) and § 2.3.2 whatever is over the threshold",
    )  # fmt: skip
