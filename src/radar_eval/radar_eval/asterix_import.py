# SPDX-License-Identifier: Apache-2.0
"""A recording of target reports as plots and truth, ready for a bag."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from heapq import merge
from typing import Any

import numpy as np
import numpy.typing as npt

from radar_common.frames import enu_from_polar
from radar_common.tables import (
    NANOSECONDS,
    PLOT,
    PLOTS_TOPIC,
    RADAR_FRAME,
    SITE_FRAME,
    TRUTH,
    TRUTH_TOPIC,
    Table,
)
from radar_eval.antenna import Rotation, estimate_rotation
from radar_eval.asterix_records import DAY, NAUTICAL_MILE, AsterixRecording
from radar_eval.errors import RecordingError
from radar_eval.false_plots import draw_false_plots
from radar_eval.primary_positions import (
    PrimaryOffset,
    estimate_offset,
    has_primary,
    primary_positions,
)
from radar_eval.sectors import cut_into_sectors

FloatArray = npt.NDArray[np.float64]

FALSE_PLOTS_REACH = 60 * NAUTICAL_MILE
# What EUROCONTROL's surveillance standard (SUR.ET1.ST01.1000-STD-01-01, 1997) allows a secondary radar.
SECONDARY_RANGE_STD = 70.0
SECONDARY_AZIMUTH_STD = float(np.radians(0.08))

_UNMEASURED = ("amplitude", "snr_db", "quality", "radial_speed", "radial_speed_std")


@dataclass(frozen=True, kw_only=True, slots=True)
class ImportOptions:
    """What to make of a recording.

    Attributes:
        primary: take the primary positions of combined reports instead of the reports' own.
        keep_offset: leave the constant offset of primary from secondary positions in.
        radar: SAC * 256 + SIC of the radar to take; None if the recording holds only one.
        nearest: m, nothing nearer is taken.
        false_plots: mean number of false plots to add to a scan.
        seed: of the false plots.
        midnight: nanoseconds since the epoch of the midnight that times of day count from; None takes the day of the
            capture, or day 0 where the file tells none.
    """

    primary: bool = False
    keep_offset: bool = False
    radar: int | None = None
    nearest: float = 0.0
    false_plots: float = 0.0
    seed: int = 0
    midnight: int | None = None


@dataclass(frozen=True, slots=True)
class ImportedRecording:
    """Plots and truth with what was learned about the radar.

    Attributes:
        plots: of dtype PLOT, in order of time; `time_offset` is not filled in.
        plot_time: nanoseconds since the epoch.
        truth: of dtype TRUTH, in order of time; `time_offset` is not filled in.
        truth_time: nanoseconds since the epoch.
        rotation: of the antenna, in seconds since the epoch.
        offset: of primary from secondary positions; None without primary positions.
        false_plots: number added.
    """

    plots: npt.NDArray[np.void]
    plot_time: npt.NDArray[np.int64]
    truth: npt.NDArray[np.void]
    truth_time: npt.NDArray[np.int64]
    rotation: Rotation
    offset: PrimaryOffset | None
    false_plots: int


def import_recording(recording: AsterixRecording, options: ImportOptions) -> ImportedRecording:
    """Turn target reports into plots and truth.

    The truth is the secondary position under the Mode S address, at the time of the report, also where there was no
    primary plot. Without `primary` plots and truth are the same positions: the truth then only tells targets apart.

    Args:
        recording: decoded reports.
        options: what to make of it.

    Returns:
        Plots and truth.

    Raises:
        RecordingError: nothing to import, or several radars and none chosen.
        RotationError: too few reports to tell how the antenna turned.
        EvaluationError: impossible false plots.
    """
    reports, directions = _one_radar(recording, options.radar)
    midnight = _midnight(recording.captured) if options.midnight is None else options.midnight
    rotation = estimate_rotation(
        np.concatenate([reports["time"], directions["time"]]) + midnight / NANOSECONDS,
        np.concatenate([reports["azimuth"], directions["azimuth"]]),
        period=_told_period(directions),
    )
    ranges, azimuths, offset = _positions(reports, options)
    taken = ranges >= options.nearest
    if not taken.any():
        raise RecordingError(f"no plot beyond {options.nearest:g} m")
    labelled = (reports["address"] != 0) & (taken | (reports["range"] >= options.nearest))
    time = midnight + np.round(reports["time"] * NANOSECONDS).astype(np.int64)

    plots, plot_time = _plots(ranges[taken], azimuths[taken], offset), time[taken]
    added, added_time = _false_plots(options, rotation, plot_time, offset)
    plots, plot_time = np.concatenate([plots, added]), np.concatenate([plot_time, added_time])
    by_time = np.argsort(plot_time, kind="stable")
    truth, truth_time = _truth(reports[labelled]), time[labelled]
    truth_by_time = np.argsort(truth_time, kind="stable")
    return ImportedRecording(
        plots[by_time],
        plot_time[by_time],
        truth[truth_by_time],
        truth_time[truth_by_time],
        rotation,
        offset,
        len(added),
    )


def messages(imported: ImportedRecording) -> Iterator[tuple[str, Table]]:
    """Cut an imported recording into messages.

    Args:
        imported: plots and truth.

    Yields:
        (topic, table) in order of time.
    """
    both = np.concatenate([imported.plot_time, imported.truth_time])
    window: dict[str, Any] = {
        "start": int(both.min()),
        "stop": int(both.max()),
        "period": imported.rotation.period,
    }
    plots = cut_into_sectors(imported.plots, imported.plot_time, frame_id=RADAR_FRAME, **window)
    truth = cut_into_sectors(imported.truth, imported.truth_time, frame_id=SITE_FRAME, **window)
    yield from merge(
        ((TRUTH_TOPIC, table) for table in truth if len(table.rows)),
        ((PLOTS_TOPIC, table) for table in plots),
        key=lambda message: message[1].stamp,
    )


def _one_radar(
    recording: AsterixRecording, wanted: int | None
) -> tuple[npt.NDArray[np.void], npt.NDArray[np.void]]:
    reports, directions = recording.reports, recording.directions
    radars, numbers = np.unique(reports["radar"], return_counts=True)
    if not len(radars):
        raise RecordingError("no target report of category 48 could be decoded")
    listing = ", ".join(
        f"{radar >> 8}/{radar & 255} ({number} reports)"
        for radar, number in zip(radars, numbers, strict=True)
    )
    if wanted is None:
        if len(radars) > 1:
            raise RecordingError(f"several radars in one recording, choose one: {listing}")
        wanted = int(radars[0])
    if wanted not in radars:
        raise RecordingError(f"no radar {wanted >> 8}/{wanted & 255} among {listing}")
    return reports[reports["radar"] == wanted], directions[directions["radar"] == wanted]


def _midnight(captured: float) -> int:
    return 0 if np.isnan(captured) else int(captured // DAY) * int(DAY) * NANOSECONDS


def _told_period(directions: npt.NDArray[np.void]) -> float | None:
    told = directions["period"][np.isfinite(directions["period"]) & (directions["period"] > 0.0)]
    # A short excerpt cannot give the period itself; a long one gives it better than the radar tells it.
    short = len(told) and np.ptp(directions["time"]) < 10.0 * told[0]
    return float(np.median(told)) if short else None


def _positions(
    reports: npt.NDArray[np.void], options: ImportOptions
) -> tuple[FloatArray, FloatArray, PrimaryOffset | None]:
    if not options.primary:
        return reports["range"], reports["azimuth"], None
    combined = has_primary(reports)
    if not combined.any():
        raise RecordingError("no report holds a primary position and a Mode S address")
    offset = estimate_offset(reports[combined])
    removed = replace(offset, range_bias=0.0, azimuth_bias=0.0) if options.keep_offset else offset
    ranges, azimuths = primary_positions(reports, removed)
    return np.where(combined, ranges, np.nan), azimuths, offset


def _plots(
    ranges: FloatArray,
    azimuths: FloatArray,
    offset: PrimaryOffset | None,
) -> npt.NDArray[np.void]:
    rows = np.zeros(len(ranges), PLOT)
    rows["range"], rows["azimuth"] = ranges, azimuths
    rows["x"], rows["y"] = enu_from_polar(ranges, azimuths)
    rows["range_std"] = SECONDARY_RANGE_STD if offset is None else offset.range_std
    rows["azimuth_std"] = SECONDARY_AZIMUTH_STD if offset is None else offset.azimuth_std
    for name in _UNMEASURED:
        rows[name] = np.nan
    return rows


def _false_plots(
    options: ImportOptions,
    rotation: Rotation,
    plot_time: npt.NDArray[np.int64],
    offset: PrimaryOffset | None,
) -> tuple[npt.NDArray[np.void], npt.NDArray[np.int64]]:
    if not options.false_plots:
        return np.zeros(0, PLOT), np.zeros(0, np.int64)
    time, ranges, azimuths = draw_false_plots(
        rotation,
        plot_time.min() / NANOSECONDS,
        plot_time.max() / NANOSECONDS,
        per_scan=options.false_plots,
        nearest=options.nearest,
        farthest=FALSE_PLOTS_REACH,
        generator=np.random.default_rng(options.seed),
    )
    return _plots(ranges, azimuths, offset), np.round(time * NANOSECONDS).astype(np.int64)


def _truth(reports: npt.NDArray[np.void]) -> npt.NDArray[np.void]:
    rows = np.zeros(len(reports), TRUTH)
    rows["range"], rows["azimuth"] = reports["range"], reports["azimuth"]
    rows["x"], rows["y"] = enu_from_polar(reports["range"], reports["azimuth"])
    rows["vx"], rows["vy"] = enu_from_polar(reports["speed"], reports["course"])
    rows["vz"], rows["snr_db"] = np.nan, np.nan
    rows["id"] = reports["address"]
    return rows
