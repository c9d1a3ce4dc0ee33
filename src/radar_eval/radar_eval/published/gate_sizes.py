# SPDX-License-Identifier: Apache-2.0
"""Sizes of gates and the probabilities that go with them (Kuzmin 1967, § 4.7.2, (4.137)-(4.139))."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from radar_eval.published.result import Row
from secondary_proc.calculators.alpha_beta_dynamics import random_variance
from secondary_proc.calculators.gate_size import (
    alpha_beta_gate,
    hit_probability,
    line_gate,
    sigmas_for_hits,
)
from secondary_proc.calculators.line_estimator import line_position_variance

_EXACT = 1e-9
_HITS = {
    "coordinate": (0.6827, 0.9545, 0.9973),
    "rectangle": (0.4661, 0.9111, 0.9946),
    "ellipse": (0.3935, 0.8647, 0.9889),
}
_BOOK = (0.68, 0.92, 0.997)
# n: variance of the difference over that of a plot.
_LINE = {2: 6.0, 3: 3.3333, 4: 2.5, 5: 2.1, 6: 1.8667, 10: 1.4667}
_FILTERS = {(0.1, 0.01): 1.1082, (0.5, 0.3): 1.9259, (0.8, 0.8): 3.75}


def gate_sizes() -> Iterator[Row]:
    """Compute probabilities and sizes.

    Yields:
        Hits by size and shape, gates of lines and filters, growth by misses.
    """
    finding = (
        "0.68 and 0.997 are probabilities of one coordinate, 0.92 is nearly that of a rectangle"
    )
    for shape, values in _HITS.items():
        for sigmas, (printed, expected) in enumerate(zip(_BOOK, values, strict=True), start=1):
            label = f"hits in a gate of {sigmas} sigma, {shape}"
            ours = float(hit_probability(sigmas, shape))
            yield Row(label, printed, expected, ours, 5.1e-5, finding)
        for probability in (0.9, 0.99):
            ours = float(hit_probability(sigmas_for_hits(probability, shape), shape))
            label = f"hits in the gate computed for {probability:g}, {shape}"
            yield Row(label, None, probability, ours, _EXACT)
    for n, expected in _LINE.items():
        label = f"line of {n} plots: variance that the gate is made for (4.138)"
        yield Row(label, None, expected, float(line_gate(n, sigmas=1.0)) ** 2, 5.1e-5)
    for (alpha, beta), expected in _FILTERS.items():
        ours = alpha_beta_gate(alpha, beta, sigmas=1.0) ** 2
        label = f"alpha = {alpha:g}, beta = {beta:g}: variance that the gate is made for"
        yield Row(label, None, expected, ours, 5.1e-5)
        label += ", less that of the residual"
        yield Row(label, 0.0, 0.0, ours - float(random_variance("residual", alpha, beta)), _EXACT)
        wider = alpha_beta_gate(alpha, beta, intensity=1.0) - alpha_beta_gate(alpha, beta)
        label = f"alpha = {alpha:g}, beta = {beta:g}: widening by a manoeuvre, gamma / beta (4.106)"
        yield Row(label, None, 1.0 / beta, wider, 1e-6)
    for ahead, printed, expected in ((2, 2.0, 2.0714), (3, 4.0, 3.5714)):
        ours = float(line_position_variance(3, ahead) / line_position_variance(3, 1))
        finding = (
            "'four times' does not follow from (4.66): it is 3.57, and 2.80 with the error of the measurement"
            if ahead == 3
            else "the book says 'more than twice'"
        )
        label = f"line of 3 plots: variance {ahead} scans ahead over that of one"
        yield Row(label, printed, expected, ours, 5.1e-5, finding)
    ours = float(np.square(line_gate(3, 2) / line_gate(3)))
    yield Row("line of 3 plots: the same of the gate after 2 misses", None, 2.8, ours, _EXACT)
