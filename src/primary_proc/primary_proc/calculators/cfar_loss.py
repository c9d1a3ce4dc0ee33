# SPDX-License-Identifier: Apache-2.0
"""What it costs that the noise level is estimated and not known."""

from __future__ import annotations

import numpy as np
from scipy.optimize import brentq
from scipy.special import gammaincinv

from primary_proc.calculators.single_pulse import steady_probability, threshold_for

_NODES = 64
_LARGEST_AMPLITUDE = 100.0


def averaging_loss_db(probability: float, count: float) -> float:
    """Loss of an average over reference cells, for one pulse of a steady target at a detection probability of one half.

    Source: P. P. Gandhi, S. A. Kassam, IEEE Trans. AES 24, 1988, (7), for the threshold.

    Args:
        probability: p_N of the threshold.
        count: reference cells N.

    Returns:
        dB of signal-to-noise ratio.
    """
    node, weight = np.polynomial.legendre.leggauss(_NODES)
    total = gammaincinv(count, (node + 1.0) / 2.0)
    level = np.sqrt(2.0 * np.expm1(-np.log(probability) / count) * total)

    def excess(amplitude: float) -> float:
        return float(steady_probability(level, amplitude) @ weight) / 2.0 - 0.5

    def ideal(amplitude: float) -> float:
        return float(steady_probability(threshold_for(probability), amplitude)) - 0.5

    needed, least = (brentq(function, 0.0, _LARGEST_AMPLITUDE) for function in (excess, ideal))
    return float(20.0 * np.log10(needed / least))
