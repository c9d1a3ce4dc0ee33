# SPDX-License-Identifier: Apache-2.0
"""The drift of the book's tracker of speed and course, and its cure (Kuzmin 1967, § 4.6.7, figure 4.24)."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import numpy.typing as npt

from radar_eval.published.result import Row
from secondary_proc.calculators.speed_course_flowchart import Flowchart, run_flowchart

FloatArray = npt.NDArray[np.float64]

# So far away that the errors of range and azimuth are those of x and y all the way.
_FAR, _PERIOD, _ERROR, _SPEED = 1e7, 10.0, 100.0, 300.0
_TRACKS, _SCANS, _EARLY, _LATE = 1000, 402, 100, 400
_ZETA = 0.4


def flowchart_drift() -> Iterator[Row]:
    """Run the flowchart on straight flight and on a change of speed.

    Yields:
        Offsets and growth of the position's error without and with feedback.
    """
    finding = "the flowchart adds velocities and never returns to a measured position"
    change = 30.0
    # The velocity's lag, zeta / (1 - zeta) of the change in all, is never made good.
    offset = -_ZETA / (1.0 - _ZETA) * change * _PERIOD
    for feedback, expected in ((0.0, offset), (0.3, 0.0)):
        error = _after_change(change, feedback)
        label = f"offset in metres long after a change of 30 m/s, feedback {feedback:g}"
        yield Row(label, None, expected, error, 0.1, "" if feedback else finding)
    fixed = _errors(feedback=0.0, manoeuvre_zeta=_ZETA)
    way = _SPEED * _PERIOD
    # A path with errors across it is too long, and its smoothed course makes good a part of that only.
    drift = _ERROR**2 / way * (1.0 - (1.0 - _ZETA) ** 2 / (1.0 + _ZETA))
    ours = float((fixed[_LATE] - fixed[_EARLY])[:, 1].mean()) / (_LATE - _EARLY)
    label = "drift along the track in metres a scan, zeta fixed, 100 m errors, 3 km a scan"
    yield Row(label, None, drift, ours, 0.1, "the length of a path is biased by errors across it")
    for feedback, growth in ((0.0, 2.0), (0.3, 1.0), (1.0, 1.0)):
        errors = _errors(feedback=feedback, manoeuvre_zeta=0.1)[..., 0]
        ours = float(np.sqrt(np.mean(errors[_LATE] ** 2) / np.mean(errors[_EARLY] ** 2)))
        # A sample rms of n values scatters by 1 / sqrt(2 n); there are two, and four sigmas.
        tolerance = 4.0 * growth / np.sqrt(_TRACKS)
        label = f"zeta switched: rms error across after 400 scans over that after 100, feedback {feedback:g}"
        yield Row(label, None, growth, ours, tolerance, "" if feedback else finding)


def _after_change(change: float, feedback: float) -> float:
    way = np.cumsum(np.where(np.arange(80) < 20, _SPEED, _SPEED + change) * _PERIOD)
    settings = _settings(feedback, _ZETA)
    followed = run_flowchart(settings, _FAR + way, np.zeros(80))
    return float(followed.position[-1, 1] - _FAR - way[-1])


def _errors(*, feedback: float, manoeuvre_zeta: float) -> FloatArray:
    noise = _ERROR * np.random.default_rng(48).normal(size=(_SCANS, _TRACKS, 2))
    truth = np.zeros((_SCANS, 1, 2))
    truth[:, 0, 1] = _FAR + _SPEED * _PERIOD * np.arange(_SCANS)
    plots = truth + noise
    followed = run_flowchart(
        _settings(feedback, manoeuvre_zeta),
        np.hypot(plots[..., 0], plots[..., 1]),
        np.arctan2(plots[..., 0], plots[..., 1]),
    )
    return followed.position - truth[1:]


def _settings(feedback: float, manoeuvre_zeta: float) -> Flowchart:
    return Flowchart(
        period=_PERIOD,
        range_std=_ERROR,
        azimuth_std=_ERROR / _FAR,
        quiet_zeta=_ZETA,
        manoeuvre_zeta=manoeuvre_zeta,
        feedback=feedback,
    )
