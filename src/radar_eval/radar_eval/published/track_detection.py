# SPDX-License-Identifier: Apache-2.0
"""Detection of a plot against range and of a track by scans (Kuzmin 1967, § 4.3.5, figures 4.4 and 4.5)."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from radar_eval.published.result import Row, to_digits
from secondary_proc.calculators.hit_sequence import wald_bounds
from secondary_proc.calculators.plot_detection import (
    burst_threshold,
    farthest_range,
    many_pulse_detection,
    plot_detection,
    strong_signal_detection,
)
from secondary_proc.calculators.track_detection import (
    approach,
    printed_track_detection,
    scans_until,
    track_detection,
)

_FALSE_ALARM = 1e-4
_THRESHOLDS = {8: 6.7768, 14: 8.0413, 22: 9.3636}
# d: steady and kappa = 1/2; fast as printed, kappa = 1; fast and kappa = 1/2.
_PLOTS = {
    0.6: (0.9999, 1.0, 0.9914),
    0.7: (0.9062, 0.9948, 0.8263),
    0.8: (0.4046, 0.9045, 0.4066),
    0.9: (0.1048, 0.5941, 0.1257),
    1.0: (0.0265, 0.2612, 0.0340),
}
_ERRORS = {
    "(4.31)": (strong_signal_detection, (0.0055, 0.040, 0.097, 0.218, 0.404)),
    "(4.32)": (many_pulse_detection, (0.047, 0.036, 0.030, 0.025, 0.022)),
}
_PULSES = (1, 4, 8, 14, 22)
_SCANS = (3, 4, 6, 9, 15)
_TRACKS = {
    (0.3, 3, 3): (0.0270, 0.0459, 0.0837, 0.1378, 0.2366),
    (0.5, 3, 3): (0.1250, 0.1875, 0.3125, 0.4648, 0.6762),
    (0.8, 3, 3): (0.5120, 0.6144, 0.8192, 0.9377, 0.9929),
    (0.3, 3, 4): (0.0270, 0.0837, 0.1591, 0.2605, 0.4286),
    (0.5, 3, 4): (0.1250, 0.3125, 0.4844, 0.6758, 0.8712),
    (0.8, 3, 4): (0.5120, 0.8192, 0.9257, 0.9880, 0.9996),
}
_RULES = ((2, 2), (3, 4), (3, 3))
# v_d T_0: ranges of probability 0.5 and 0.9 for 2/2, 3/4, 3/3.
_FIGURE = {
    0.01: ((0.79, 0.74), (0.76, 0.72), (0.74, 0.70)),
    0.02: ((0.76, 0.70), (0.72, 0.68), (0.70, 0.66)),
    0.05: ((0.70, 0.65), (0.65, 0.60), (0.65, 0.60)),
}


def track_detections() -> Iterator[Row]:
    """Compute both probabilities.

    Yields:
        Thresholds, bounds of the sequential test,
        plots against range, errors of the approximations, tracks by scans, ranges of detection.
    """
    # A ratio of 16 in power is a ratio of 2 in range.
    ratio = farthest_range(16e6, 3e3, 0.1, 10.0, 1e-13) / farthest_range(1e6, 3e3, 0.1, 10.0, 1e-13)
    yield Row("range gained by 16 times the power (4.29)", None, 2.0, ratio, 1e-9)
    for pulses, expected in _THRESHOLDS.items():
        label = f"threshold x_0 for N_0 = {pulses}, P_fa = 1e-4 (4.30)"
        yield Row(label, None, expected, burst_threshold(_FALSE_ALARM, pulses), to_digits(expected))
    for name, bound, expected in zip("AB", wald_bounds(0.01, 0.1), (0.1 / 0.99, 90.0), strict=True):
        label = f"bound {name} of the sequential test, errors 0.01 and 0.1, after (4.14)"
        yield Row(label, None, expected, bound, 1e-9)
    yield from _plots()
    yield from _approximations()
    yield from _tracks()
    yield from _ranges()


def _plots() -> Iterator[Row]:
    finding = (
        "(4.34) has twice the mean power of (4.33b) in it, so the curves of figure 4.4 never cross"
    )
    for distance, (steady, fast, equal) in _PLOTS.items():
        place = f"d = {distance:g}, N_0 = 14"
        ours = float(plot_detection(distance, 14, _FALSE_ALARM))
        yield Row(f"{place}, steady target, figure 4.4", None, steady, ours, 5.1e-5)
        ours = float(plot_detection(distance, 14, _FALSE_ALARM, "fast", 1.0))
        yield Row(f"{place}, fluctuating target (4.34)", None, fast, ours, 5.1e-5)
        ours = float(plot_detection(distance, 14, _FALSE_ALARM, "fast"))
        label = f"{place}, fluctuating target of the same mean power"
        yield Row(label, None, equal, ours, 5.1e-5, finding)


def _approximations() -> Iterator[Row]:
    distance = np.linspace(0.5, 1.0, 501)
    for equation, (approximation, errors) in _ERRORS.items():
        for pulses, expected in zip(_PULSES, errors, strict=True):
            exact = plot_detection(distance, pulses, _FALSE_ALARM)
            error = np.abs(approximation(distance, pulses, _FALSE_ALARM) - exact).max()
            label = f"largest error of {equation} over d = 0.5 to 1, N_0 = {pulses}"
            yield Row(label, None, expected, float(error), 6e-4)


def _tracks() -> Iterator[Row]:
    finding = (
        "(4.37) is right up to the sixth scan and too large from then on, up to values above one: its first term "
        "needs 1 - P_(i-5) and its second has no finite form"
    )
    for (probability, hits, window), values in _TRACKS.items():
        found = np.full(max(_SCANS), probability)
        exact = track_detection(found, hits, window)
        book = printed_track_detection(found, hits, window)
        for scans, expected in zip(_SCANS, values, strict=True):
            label = f"{hits}/{window}, p = {probability:g}: track detected after {scans} scans"
            printed = round(float(book[scans - 1]), 4)
            wrong = abs(printed - expected) > 1e-4
            yield Row(
                f"{label}, {'(4.36)' if hits == window else '(4.37)'}",
                printed,
                expected,
                float(exact[scans - 1]),
                5.1e-5,
                finding if wrong else "",
            )
    # The probability that rises as the target comes nearer: the recurrence of m/m stays exact.
    rising = plot_detection(approach(0.02, 30), 14, _FALSE_ALARM)
    for length in (2, 3):
        difference = track_detection(rising, length, length)
        difference -= printed_track_detection(rising, length, length)
        label = f"{length}/{length}, rising p: largest difference of (4.36) from the automaton"
        yield Row(label, 0.0, 0.0, float(np.abs(difference).max()), 1e-12)


def _ranges() -> Iterator[Row]:
    for speed, values in _FIGURE.items():
        ranges = approach(speed, 60)
        found = plot_detection(ranges, 14, _FALSE_ALARM)
        for (hits, window), expected in zip(_RULES, values, strict=True):
            confirmed = track_detection(found, hits, window)
            for probability, distance in zip((0.5, 0.9), expected, strict=True):
                scan = scans_until(confirmed, probability)
                ours = float("nan") if scan is None else float(ranges[scan])
                label = (
                    f"{hits}/{window}, v_d T_0 = {speed:g}: range where the track is detected with "
                    f"{probability:g}, figure 4.5"
                )
                yield Row(label, None, distance, ours, 1e-9)
