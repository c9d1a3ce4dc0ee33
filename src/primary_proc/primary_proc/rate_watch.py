# SPDX-License-Identifier: Apache-2.0
"""Holds what the extractor sees against what its design predicts for noise alone."""

from __future__ import annotations

from primary_proc.design import Design
from radar_common.health import Health


class RateWatch:
    """Means since the design was last changed.

    Targets and clutter raise the observed values; a share of cells over the threshold far from its design value means
    that the noise is not what the normaliser takes it for.
    """

    def __init__(self, design: Design, cells: int, health: Health) -> None:
        """Start counting.

        Args:
            design: the predictions.
            cells: range cells of a pulse.
            health: where the watches go.
        """
        self._design = design
        self._cells = cells
        self._health = health
        self._pulses = self._ones = self._plots = 0

    def add(self, pulses: int, ones: int, plots: int) -> None:
        """Count what was processed.

        Args:
            pulses: pulses processed.
            ones: cells over the threshold among them.
            plots: plots completed.
        """
        self._pulses += pulses
        self._ones += ones
        self._plots += plots
        scans = self._pulses / self._design.requirements.pulses_per_scan
        self._health.watch(
            "share of cells over the threshold (expected: noise alone)",
            self._design.method.noise_probability,
            self._ones / (self._pulses * self._cells),
        )
        self._health.watch(
            "plots per scan (expected: noise alone)",
            self._design.method.false_plots,
            self._plots / scans,
        )
