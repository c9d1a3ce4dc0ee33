# SPDX-License-Identifier: Apache-2.0
"""What a user and a radar ask of a way to detect bursts."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class Requirements:
    """From these alone a method sets its thresholds and predicts what it will do.

    Attributes:
        false_plots: false plots that noise may make in one turn, over all cells.
        rings: range rings.
        pulses_per_scan: azimuth positions in one turn.
        gap: pulses between two bursts that still make one plot.
        pattern: antenna pattern's name.
        pulses: N_0, pulses in a burst (Kuzmin 1967, 1.27).
        target: what targets do, a name in `target_models.TARGETS`.
        snr_db: power over the mean noise power at the beam's axis that weights are made for.
        second_threshold: what the detector counts up to, where it counts; 0 lets the method choose.
        end_zeros: zeros in a row that end a burst, where the method's name does not say it.
        levels: of the envelope, where the detector has more than two.
        level_kind: how the thresholds between them are placed, a name in `level_thresholds.LEVEL_KINDS`.
    """

    false_plots: float
    rings: int
    pulses_per_scan: float
    gap: int
    pattern: str
    pulses: float
    target: str = "steady"
    snr_db: float = 10.0
    second_threshold: int = 0
    end_zeros: int = 2
    levels: int = 8
    level_kind: str = "weak-signal"
