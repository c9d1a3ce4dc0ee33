# SPDX-License-Identifier: Apache-2.0
"""Where a multi-level quantiser of the envelope puts its thresholds, by name."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import numpy.typing as npt
from scipy.optimize import brentq

from primary_proc.calculators.pulse.amplitude_laws import AmplitudeLaw, envelope_law
from primary_proc.calculators.quantisation.lloyd_max import MOST_LEVELS, lloyd_max

FloatArray = npt.NDArray[np.float64]

NOISE = envelope_law(0.0)
"""Rayleigh's law, (1.35)."""

_LARGEST_POWER = 45.0


def level_thresholds(
    kind: str, levels: int, *, law: AmplitudeLaw = NOISE, step: float = 1.0
) -> FloatArray:
    """Thresholds between the levels of a quantiser of the envelope.

    Source: Kuzmin 1967, § 2.2.2: (2.14) for "uniform", (2.11)-(2.13) for "lloyd-max"; S. A. Kassam, IEEE Trans.
    COM-25, 1977, for "weak-signal".

    Args:
        kind: "uniform": multiples of the step. "equal-probability": every level as probable as any other.
            "lloyd-max": least mean squared error of the amplitude. "weak-signal": least error of the power, which
            is what a weak signal's likelihood ratio is made of; loses least in detection of weak signals.
        levels: number of levels, thresholds being one fewer; 2 is binary quantisation.
        law: of the amplitude, for "equal-probability" and "lloyd-max"; of noise if not given.
        step: of "uniform", in units of the noise's sigma.

    Returns:
        Increasing thresholds on x in units of the noise's sigma, shape (levels - 1,).

    Raises:
        ValueError: there is no such kind, the levels are not in [2, 64] or the step is not positive.
    """
    if kind not in LEVEL_KINDS:
        raise ValueError(f"level kind {kind!r} is none of {', '.join(LEVEL_KINDS)}")
    if not 2 <= levels <= MOST_LEVELS:
        raise ValueError(f"levels must be in [2, {MOST_LEVELS}], got {levels}")
    if not step > 0.0:
        raise ValueError(f"step must be positive, got {step:g}")
    return LEVEL_KINDS[kind](levels, law, step)


def _uniform(levels: int, law: AmplitudeLaw, step: float) -> FloatArray:
    return np.multiply(step, np.arange(1, levels), dtype=float)


def _equal_probability(levels: int, law: AmplitudeLaw, step: float) -> FloatArray:
    low, high = law.support

    def quantile(share: float) -> float:
        return float(brentq(lambda x: float(law.exceedance(x)) - share, low, high, xtol=1e-12))

    return np.array([quantile(1.0 - number / levels) for number in range(1, levels)])


def _lloyd_max(levels: int, law: AmplitudeLaw, step: float) -> FloatArray:
    return lloyd_max(law.density, law.support, levels).thresholds


def _weak_signal(levels: int, law: AmplitudeLaw, step: float) -> FloatArray:
    power = lloyd_max(lambda u: np.exp(-u), (0.0, _LARGEST_POWER), levels)
    return np.asarray(np.sqrt(2.0 * power.thresholds))


LEVEL_KINDS: dict[str, Callable[[int, AmplitudeLaw, float], FloatArray]] = {
    "uniform": _uniform,
    "equal-probability": _equal_probability,
    "lloyd-max": _lloyd_max,
    "weak-signal": _weak_signal,
}
"""Ways to place thresholds; each takes the number of levels, the law and the step."""
