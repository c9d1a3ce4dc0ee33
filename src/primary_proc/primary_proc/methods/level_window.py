# SPDX-License-Identifier: Apache-2.0
"""A sliding window over a few levels of the envelope, each with its log-likelihood ratio."""

from __future__ import annotations

import math

import numpy as np

from primary_proc.calculators.integration.burst_weights import level_weights
from primary_proc.calculators.pulse.burst_shape import burst_shape
from primary_proc.calculators.quantisation.level_thresholds import level_thresholds
from primary_proc.methods.amplitude_window import threshold_fit, whole_channels
from primary_proc.methods.requirements import Requirements
from primary_proc.methods.window_method import Fit, WindowMethod

_HIGHEST = 4.2


class MultiLevelMethod(WindowMethod):
    """Levels weighted by their log-likelihood ratio at each place of the burst (Kuzmin 1967, (3.11))."""

    def fit(self, requirements: Requirements) -> Fit:
        """Place the levels and round their weights to whole numbers; see `WindowMethod.fit`.

        Args:
            requirements: what is asked.

        Returns:
            What sets the threshold of the sum.
        """
        levels = requirements.levels
        step = _HIGHEST / (levels - 1)
        edges = level_thresholds(requirements.level_kind, levels, step=step)
        shape = burst_shape(requirements.pattern, requirements.pulses)
        amplitude = math.sqrt(2.0) * 10.0 ** (requirements.snr_db / 20.0) * shape
        weights = level_weights(edges, amplitude, requirements.target)
        taps, table = whole_channels(weights - weights[:, :1], 1)
        return threshold_fit(edges, np.maximum.accumulate(table, axis=1), taps)
