# SPDX-License-Identifier: Apache-2.0
"""The published results that can be reproduced, by name."""

from __future__ import annotations

from radar_eval.errors import EvaluationError
from radar_eval.published.alpha_beta import alpha_beta
from radar_eval.published.azimuth_accuracy import azimuth_accuracies
from radar_eval.published.cfar_thresholds import cfar_thresholds
from radar_eval.published.detection_probability import detection_probabilities
from radar_eval.published.false_tracks import false_tracks
from radar_eval.published.gates import gate_probabilities
from radar_eval.published.program_detectors import program_detectors
from radar_eval.published.required_snr import required_snr
from radar_eval.published.result import PublishedResult

_BOOK = "S. Z. Kuzmin, Digital Processing of Radar Information (in Russian), Moscow 1967"

RESULTS = {
    result.name: result
    for result in (
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
            f"{_BOOK}, § 3.3.6, (3.92)-(3.103), figures 3.29-3.30",
            azimuth_accuracies,
        ),
        PublishedResult(
            "kuzmin-4-alpha-beta",
            f"{_BOOK}, § 4.4.3 and 4.5.2, (4.49)-(4.55), (4.82)-(4.87), figures 4.6 and 4.10",
            alpha_beta,
        ),
        PublishedResult(
            "kuzmin-4-false-tracks",
            f"{_BOOK}, § 4.3.3, (4.16)-(4.25), figure 4.2",
            false_tracks,
        ),
        PublishedResult("kuzmin-4-gates", f"{_BOOK}, § 4.7.2", gate_probabilities),
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
