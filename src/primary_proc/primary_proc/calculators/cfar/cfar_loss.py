# SPDX-License-Identifier: Apache-2.0
"""What it costs that the noise level is an average and not known."""

from __future__ import annotations

from primary_proc.calculators.cfar.cfar_detection import loss_db
from primary_proc.calculators.cfar.cfar_laws import AverageLevel


def averaging_loss_db(probability: float, count: float) -> float:
    """Loss of an average over reference cells, for one pulse of a steady target at a detection probability of one half.

    Source: P. P. Gandhi, S. A. Kassam, IEEE Trans. AES 24, 1988, (7), for the threshold.

    Args:
        probability: p_N of the threshold.
        count: reference cells N; between whole numbers, the mean of a gamma law.

    Returns:
        dB of signal-to-noise ratio.
    """
    return loss_db(AverageLevel(count), probability)
