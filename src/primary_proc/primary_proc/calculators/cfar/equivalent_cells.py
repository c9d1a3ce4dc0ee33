# SPDX-License-Identifier: Apache-2.0
"""The cell averaging that would lose as much as another way to find the noise level."""

from __future__ import annotations

import math

from scipy.optimize import brentq

from primary_proc.calculators.cfar.cfar_loss import averaging_loss_db

_FEWEST, _MOST = 2.0, 2000.0
_PRECISION = 0.02


def equivalent_cells(probability: float, loss_db: float) -> float:
    """Number of reference cells from the loss.

    Args:
        probability: p_N of the threshold that the loss was computed for.
        loss_db: dB of signal-to-noise ratio lost against a known noise level.

    Returns:
        Number of cells, 2 or more; infinite for a noise level that is as good as known.
    """
    if loss_db <= averaging_loss_db(probability, _MOST):
        return math.inf
    if loss_db >= averaging_loss_db(probability, _FEWEST):
        return _FEWEST

    def excess(logarithm: float) -> float:
        return averaging_loss_db(probability, math.exp(logarithm)) - loss_db

    return math.exp(brentq(excess, math.log(_FEWEST), math.log(_MOST), xtol=_PRECISION))
