# SPDX-License-Identifier: Apache-2.0
"""The published results that can be reproduced, by name."""

from __future__ import annotations

from radar_eval.errors import EvaluationError
from radar_eval.published.accumulators import accumulators
from radar_eval.published.alpha_beta import alpha_beta
from radar_eval.published.alpha_beta_dynamics import alpha_beta_dynamics
from radar_eval.published.amplitude_azimuth import amplitude_azimuth
from radar_eval.published.automata import automata
from radar_eval.published.azimuth_accuracy import azimuth_accuracies
from radar_eval.published.burst_detection import burst_detection
from radar_eval.published.cfar_thresholds import cfar_thresholds
from radar_eval.published.detection_probability import detection_probabilities
from radar_eval.published.detkov import detkov_table
from radar_eval.published.false_tracks import false_tracks
from radar_eval.published.gates import gate_probabilities
from radar_eval.published.khmarskiy import emitter_location
from radar_eval.published.level_quantisation import level_quantisation
from radar_eval.published.motion_models import motion_models
from radar_eval.published.polynomial_estimation import polynomial_estimation
from radar_eval.published.potential_accuracy import potential_accuracies
from radar_eval.published.program_detectors import program_detectors
from radar_eval.published.pulse_in_gate import pulse_in_gate
from radar_eval.published.required_snr import required_snr
from radar_eval.published.result import PublishedResult
from radar_eval.published.selection import selections
from radar_eval.published.sequential import sequential_tests
from radar_eval.published.time_gate import time_gate
from radar_eval.published.time_quantisation import time_quantisation
from radar_eval.published.track_detection import track_detections
from radar_eval.published.track_parameters import track_parameters
from radar_eval.published.weighted_detection import weighted_detection

_BOOK = "S. Z. Kuzmin, Digital Processing of Radar Information (in Russian), Moscow 1967"

RESULTS = {
    result.name: result
    for result in (
        PublishedResult(
            "kuzmin-1-detection",
            f"{_BOOK}, § 1.3, (1.34), (1.39), (1.45)-(1.51)",
            burst_detection,
        ),
        PublishedResult("kuzmin-1-azimuth", f"{_BOOK}, § 1.4.3, (1.68)-(1.77)", amplitude_azimuth),
        PublishedResult("kuzmin-1-sequential", f"{_BOOK}, § 1.3", sequential_tests),
        PublishedResult(
            "kuzmin-2-quantisation",
            f"{_BOOK}, § 2.2.2 and 2.3.4, (2.7)-(2.17), (2.28)-(2.37), figures 2.8 and 2.9",
            level_quantisation,
        ),
        PublishedResult(
            "kuzmin-2-sampling",
            f"{_BOOK}, § 2.2.1 and 2.3, (2.3)-(2.6), (2.18)-(2.27), (2.38)-(2.44)",
            time_quantisation,
        ),
        PublishedResult(
            "kuzmin-2-time-gate",
            f"{_BOOK}, § 2.4.2 and 2.4.4, (2.57)-(2.66), figure 2.13",
            time_gate,
        ),
        PublishedResult(
            "kuzmin-2-pulse-in-gate",
            f"{_BOOK}, § 2.4.3, (2.56), (2.67)-(2.73), figures 2.15-2.17",
            pulse_in_gate,
        ),
        PublishedResult(
            "kuzmin-3-weighted",
            f"{_BOOK}, § 3.1, (3.7)-(3.17), figures 3.3 and 3.4",
            weighted_detection,
        ),
        PublishedResult(
            "kuzmin-3-potential-accuracy",
            f"{_BOOK}, § 3.1.4-3.1.6, (3.18)-(3.35), figure 3.7",
            potential_accuracies,
        ),
        PublishedResult(
            "kuzmin-3-automata", f"{_BOOK}, § 3.2.3-3.2.5, Tables 3.6-3.11, (3.46)", automata
        ),
        PublishedResult(
            "kuzmin-3-accumulators",
            f"{_BOOK}, § 3.3.2-3.3.5, (3.47)-(3.63), (3.77)-(3.87), figure 3.19",
            accumulators,
        ),
        PublishedResult(
            "kuzmin-3-program-detectors",
            f"{_BOOK}, § 3.3.3, (3.64)-(3.74), figure 3.24",
            program_detectors,
        ),
        PublishedResult(
            "kuzmin-3-detection-probability",
            f"{_BOOK}, § 3.3.5, (3.86)-(3.91), figures 3.25-3.27",
            detection_probabilities,
        ),
        PublishedResult(
            "kuzmin-3-azimuth-accuracy",
            f"{_BOOK}, § 3.3.6, (3.92)-(3.103), figures 3.28-3.30",
            azimuth_accuracies,
        ),
        PublishedResult(
            "kuzmin-4-alpha-beta",
            f"{_BOOK}, § 4.4.3, 4.5.2, 4.5.3, (4.49)-(4.55), (4.82)-(4.91), figures 4.6, 4.10-4.12",
            alpha_beta,
        ),
        PublishedResult(
            "kuzmin-4-alpha-beta-dynamics",
            f"{_BOOK}, § 4.5.4, (4.92)-(4.112), figures 4.13-4.16",
            alpha_beta_dynamics,
        ),
        PublishedResult(
            "kuzmin-4-motion", f"{_BOOK}, § 4.2, (4.3)-(4.8), figure 4.1", motion_models
        ),
        PublishedResult(
            "kuzmin-4-false-tracks",
            f"{_BOOK}, § 4.3.3 and 4.3.4, (4.10), (4.16)-(4.28), figures 4.2 and 4.3",
            false_tracks,
        ),
        PublishedResult(
            "kuzmin-4-track-detection",
            f"{_BOOK}, § 4.3.2 and 4.3.5, (4.14), (4.29)-(4.37), figures 4.4 and 4.5",
            track_detections,
        ),
        PublishedResult(
            "kuzmin-4-estimation",
            f"{_BOOK}, § 4.4, (4.43)-(4.78), figures 4.6, 4.8 and 4.9",
            polynomial_estimation,
        ),
        PublishedResult(
            "kuzmin-4-track-parameters",
            f"{_BOOK}, § 4.6, (4.113)-(4.136), tables 4.1-4.3, figures 4.17-4.24",
            track_parameters,
        ),
        PublishedResult("kuzmin-4-gates", f"{_BOOK}, § 4.7.2, (4.137)-(4.139)", gate_probabilities),
        PublishedResult(
            "kuzmin-4-selection",
            f"{_BOOK}, § 4.7.3-4.7.5, (4.140)-(4.153), figures 4.26-4.29",
            selections,
        ),
        PublishedResult(
            "khmarskiy-filters",
            "Khmarskiy, Sushchinskiy 2015, bearings of a moving direction finder",
            emitter_location,
        ),
        PublishedResult(
            "cfar-thresholds",
            "P. P. Gandhi, S. A. Kassam, IEEE Trans. AES 24, 1988; H. Rohling, IEEE Trans. AES 19, 1983",
            cfar_thresholds,
        ),
        PublishedResult(
            "required-snr",
            "J. I. Marcum 1947, P. Swerling 1954; W. J. Albersheim, Proc. IEEE 69, 1981; "
            "D. A. Shnidman, IEEE Trans. AES 38, 2002",
            required_snr,
        ),
        PublishedResult(
            "detkov-table-1",
            "A. N. Detkov, Journal of Communications Technology and Electronics (Radiotekhnika i Elektronika) 67, "
            "2022, Table 1",
            detkov_table,
        ),
    )
}


def find_result(name: str) -> PublishedResult:
    """Find a result.

    Args:
        name: as listed.

    Returns:
        The result.

    Raises:
        EvaluationError: there is none of that name.
    """
    if name not in RESULTS:
        raise EvaluationError(f"no published result {name!r}; there are {', '.join(RESULTS)}")
    return RESULTS[name]
