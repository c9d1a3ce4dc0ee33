# SPDX-License-Identifier: Apache-2.0
"""What one detector loses against the ideal integrator."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Loss:
    """Sensitivity of one detector to one kind of target.

    Attributes:
        detector: its name.
        target: fluctuation.
        required_snr_db: ratio at which 90 % are detected, as predicted.
        loss_db: that ratio over the ideal integrator's.
        found: share of the targets of that ratio that the extractor found.
        targets: how many there were.
        measured_loss_db: the loss that this share means.
    """

    detector: str
    target: str
    required_snr_db: float
    loss_db: float
    found: float
    targets: int
    measured_loss_db: float
