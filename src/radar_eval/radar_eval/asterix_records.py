# SPDX-License-Identifier: Apache-2.0
"""Target reports (CAT048) and antenna directions (CAT034) of a recording as arrays.

Items are decoded by `libasterix` (MIT licence) after EUROCONTROL's category specifications; this module only picks
those that evaluation needs and gives them SI units.
"""

from __future__ import annotations

import gc
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import asterix.generated as categories
import numpy as np
import numpy.typing as npt
from asterix.base import Bits

from radar_common.health import Health
from radar_eval.recording_file import TARGET_REPORTS, DataBlock

NAUTICAL_MILE = 1852.0
DAY = 86400.0

REPORT = np.dtype(
    [
        ("radar", "<u2"),  # SAC and SIC of the sender, one octet each
        ("time", "<f8"),  # s after midnight of the recording's first day
        ("range", "<f8"),  # m, measured position
        ("azimuth", "<f8"),  # rad clockwise from north
        ("range_difference", "<f8"),  # m, primary minus secondary; NaN without both
        ("azimuth_difference", "<f8"),  # rad, primary minus secondary; NaN without both
        ("address", "<u4"),  # Mode S address, 0 without
        ("speed", "<f8"),  # m/s over ground; NaN without
        ("course", "<f8"),  # rad clockwise from north; NaN without
    ]
)

DIRECTION = np.dtype([("radar", "<u2"), ("time", "<f8"), ("azimuth", "<f8"), ("period", "<f8")])

# The specification's tables are a million objects which every full collection would walk through again.
gc.freeze()

_TARGET = categories.Cat_048_1_32
_SERVICE = categories.Cat_034_1_29
_NO_DETECTION = 0
_NORTH, _SECTOR = 1, 2
_NAN = float("nan")


@dataclass(frozen=True, slots=True)
class AsterixRecording:
    """What a recording holds of one or several radars.

    Attributes:
        reports: of dtype REPORT, in the order of the file.
        directions: of dtype DIRECTION: when the antenna passed which azimuth, and its period where it is told.
        captured: seconds since the epoch of the first block; NaN where the file does not tell.
    """

    reports: npt.NDArray[np.void]
    directions: npt.NDArray[np.void]
    captured: float


def decode_records(blocks: Iterable[DataBlock], health: Health) -> AsterixRecording:
    """Decode data blocks.

    Reports that are no detections (the radar's own predictions), simulated or test targets, and reports without
    position or time are left out and counted.

    Args:
        blocks: of categories 48 and 34.
        health: counts what was taken and what was left out.

    Returns:
        Reports and directions with times that run on over midnight.
    """
    reports: list[tuple[Any, ...]] = []
    directions: list[tuple[Any, ...]] = []
    captured = _NAN
    for block in blocks:
        if np.isnan(captured):
            captured = block.captured
        category = _TARGET if block.category == TARGET_REPORTS else _SERVICE
        records = category.cv_uap.parse(Bits.from_bytes(block.records))
        if isinstance(records, ValueError):
            health.drop("damaged data block")
            continue
        for record in records:
            if block.category == TARGET_REPORTS:
                _take_report(record, reports, health)
            else:
                _take_direction(record, directions)
    report_rows = np.array(reports, dtype=REPORT)
    direction_rows = np.array(directions, dtype=DIRECTION)
    origin = report_rows["time"][0] if len(report_rows) else 0.0
    for rows in (report_rows, direction_rows):
        rows["time"] = run_over_midnight(rows["time"], origin)
    return AsterixRecording(report_rows, direction_rows, captured)


def run_over_midnight(
    time_of_day: npt.NDArray[np.float64], origin: float
) -> npt.NDArray[np.float64]:
    """Let times of day run on where they start again at midnight.

    Args:
        time_of_day: seconds after midnight in order of arrival, shape (n,); neighbours are less than half a day apart.
        origin: time of day near the first of them, on the first day.

    Returns:
        Seconds after midnight of the first day, shape (n,).
    """
    steps = np.diff(time_of_day, prepend=origin)
    return time_of_day - DAY * np.cumsum(np.round(steps / DAY))


def _take_report(record: Any, reports: list[tuple[Any, ...]], health: Health) -> None:
    source, time, position = (record.get_item(item) for item in ("010", "140", "040"))
    descriptor = record.get_item("020")
    if source is None or time is None or position is None or descriptor is None:
        health.drop("target report without position or time")
        return
    if _flag(descriptor, "TYP") == _NO_DETECTION:
        health.drop("target report without detection")
        return
    if _flag(descriptor, "SIM") or _flag(descriptor, "TST"):
        health.drop("report of a simulated or test target")
        return
    health.count("target reports")
    characteristics, address = record.get_item("130"), record.get_item("220")
    velocity = record.get_item("200")
    reports.append(
        (
            source.as_uint(),
            _quantity(time, "s"),
            _part(position, "RHO", "NM") * NAUTICAL_MILE,
            np.radians(_part(position, "THETA", "°")),
            _part(characteristics, "RPD", "NM") * NAUTICAL_MILE,
            np.radians(_part(characteristics, "APD", "°")),
            address.as_uint() if address is not None else 0,
            _part(velocity, "GSP", "NM/s") * NAUTICAL_MILE,
            np.radians(_part(velocity, "HDG", "°")),
        )
    )


def _take_direction(record: Any, directions: list[tuple[Any, ...]]) -> None:
    source, time, kind = (record.get_item(item) for item in ("010", "030", "000"))
    if source is None or time is None or kind is None:
        return
    azimuth, period = record.get_item("020"), record.get_item("041")
    if kind.as_uint() == _NORTH:
        direction = 0.0
    elif kind.as_uint() == _SECTOR and azimuth is not None:
        direction = np.radians(_quantity(azimuth, "°"))
    else:
        return
    directions.append(
        (
            source.as_uint(),
            _quantity(time, "s"),
            direction,
            _NAN if period is None else _quantity(period, "s"),
        )
    )


def _quantity(item: Any, unit: str) -> float:
    return float(item.variation.content.as_quantity(unit))


def _part(item: Any, name: str, unit: str) -> float:
    part = None if item is None else item.variation.get_item(name)
    return _NAN if part is None else _quantity(part, unit)


def _flag(item: Any, name: str) -> int:
    part = item.variation.get_item(name)
    return 0 if part is None else int(part.as_uint())
