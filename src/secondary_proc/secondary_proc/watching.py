# SPDX-License-Identifier: Apache-2.0
"""What the tracker has measured of itself and of the radar, held against what it was told: for diagnostics."""

from __future__ import annotations

from radar_common.health import Health
from secondary_proc.clutter import FalsePlotDensity
from secondary_proc.detection import DetectionByRange
from secondary_proc.gating import SelectionWatch
from secondary_proc.parameters import TrackerParameters
from secondary_proc.rotation import Rotation


def watch(
    health: Health,
    parameters: TrackerParameters,
    detection: DetectionByRange,
    clutter: FalsePlotDensity,
    selection: SelectionWatch,
    rotation: Rotation,
) -> None:
    """Write down the present rates.

    Args:
        health: where they are written.
        parameters: what the tracker was told.
        detection: probability of a plot by range.
        clutter: density of false plots.
        selection: how surely plots are their tracks' own.
        rotation: of the antenna.
    """
    counts, told = health.counts, parameters.detection_probability
    found = counts["plots of confirmed tracks"]
    if passed := found + counts["misses of confirmed tracks"]:
        health.watch("plots per passage of a confirmed track", told, found / passed)
    for band, share in detection.shares().items():
        health.watch(f"plots per passage, {band}", told, share)
    health.watch("densest patch of false plots over its ring's mean", 1.0, clutter.unevenness)
    if (shares := selection.shares) is not None:
        health.watch("plots of confirmed tracks that are their own", *shares)
    if rotation.known:
        hint = parameters.scan_period or rotation.period
        health.watch("scan period, s", hint, rotation.period)
