# SPDX-License-Identifier: Apache-2.0
"""What a design will do, as numbers to print before the radar is switched on."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from primary_proc.calculators.integration.required_ratio import required_snr_db
from primary_proc.calculators.pulse.single_pulse import threshold_for
from primary_proc.calculators.pulse.target_models import TARGETS
from primary_proc.choices import NORMALISERS
from primary_proc.design import settled
from primary_proc.methods.designed_method import choose_program
from primary_proc.methods.detection_method import SettledMethod
from primary_proc.methods.requirements import Requirements
from primary_proc.parameters import ExtractorParameters

_WANTED = (0.5, 0.9)
_SNR_DB = np.arange(0.0, 25.0)


@dataclass(frozen=True, slots=True)
class Quality:
    """What to expect at one signal-to-noise ratio.

    Attributes:
        snr_db: power over the mean noise power at the beam's axis.
        detection: probability of detection, by model of the target.
        azimuth_std: of the start-end estimate, in azimuth steps.
        azimuth_std_deg: the same, deg.
    """

    snr_db: float
    detection: dict[str, float]
    azimuth_std: float
    azimuth_std_deg: float


@dataclass(frozen=True, slots=True)
class Prediction:
    """The predicted quality of a design.

    Attributes:
        detector: its name; what was chosen where the choice was left open.
        pulses_in_burst: N_0.
        noise_probability: p_N, probability that noise exceeds the first threshold.
        first_threshold: x_0, over the noise's sigma, at a noise level that is known.
        false_starts: probability per azimuth position and ring that noise starts a burst.
        false_plots: false plots in one turn of the whole coverage.
        normaliser_loss_db: what it costs to estimate the noise level; the ratios below include it.
        required_snr_db: for each probability of detection, by model of the target; null where none is enough.
        quality: against the signal-to-noise ratio.
    """

    detector: str
    pulses_in_burst: float
    noise_probability: float
    first_threshold: float
    false_starts: float
    false_plots: float
    normaliser_loss_db: float
    required_snr_db: dict[str, dict[str, float | None]]
    quality: list[Quality]

    def as_dict(self) -> dict[str, Any]:
        """Write for machines.

        Returns:
            Nested names and numbers.
        """
        return asdict(self)


def predict_extractor(
    parameters: ExtractorParameters, requirements: Requirements, cells: int
) -> Prediction:
    """Design an extractor and work out its quality.

    Args:
        parameters: what the user wants.
        requirements: what that and the radar ask of the detector.
        cells: range cells of a pulse.

    Returns:
        The prediction.

    Raises:
        ValueError: the requirements are out of reach.
    """
    name = parameters.detector
    if name == "auto":
        name, method = choose_program(requirements)
    else:
        method = settled(name, requirements)
    normaliser = NORMALISERS[parameters.normaliser](parameters, cells)
    return predict(name, method, requirements, normaliser.loss_db(method.noise_probability))


def predict(
    name: str, method: SettledMethod, requirements: Requirements, loss_db: float
) -> Prediction:
    """Work out the quality of a detector that is set up.

    Args:
        name: of the detector.
        method: the detector.
        requirements: that it was set up for.
        loss_db: of the normaliser at the method's noise probability.

    Returns:
        The prediction.
    """
    step_deg = 360.0 / requirements.pulses_per_scan
    found = {target: method.detection_probability(_SNR_DB - loss_db, target) for target in TARGETS}
    std = method.accuracy.std_at(_SNR_DB - loss_db)
    return Prediction(
        detector=name,
        pulses_in_burst=requirements.pulses,
        noise_probability=method.noise_probability,
        first_threshold=float(threshold_for(method.noise_probability)),
        false_starts=method.false_starts,
        false_plots=method.false_plots,
        normaliser_loss_db=loss_db,
        required_snr_db={
            target: {
                f"{wanted:g}": _finite(required_snr_db(method, wanted, target) + loss_db)
                for wanted in _WANTED
            }
            for target in TARGETS
        },
        quality=[
            Quality(
                float(snr_db),
                {target: float(found[target][row]) for target in TARGETS},
                float(std[row]),
                float(std[row]) * step_deg,
            )
            for row, snr_db in enumerate(_SNR_DB)
        ],
    )


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None
