# SPDX-License-Identifier: Apache-2.0
"""One row for every direction that a sensor reported, whichever table it came in; what cannot be used is refused here.

An azimuth outside [0, 2 pi) is dropped, not wrapped: a sensor that writes one speaks of degrees or of another circle,
and to wrap it would make a believable direction of it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from radar_common.frames import TWO_PI, polar_from_enu
from radar_common.health import Health
from radar_common.tables import BearingChannel, TrackStatus

FloatArray = npt.NDArray[np.float64]
BoolArray = npt.NDArray[np.bool_]
Rows = npt.NDArray[np.void]

LONGEST_OFFSET = 15.0
LARGEST_AZIMUTH_STD = 0.5

_NEAREST = 1.0
_FARTHEST = 1e7
_FASTEST = 1e4

SIGHTING = np.dtype(
    [
        ("time", "<f8"),  # s on the pipeline's own axis
        ("azimuth", "<f8"),  # rad, [0, 2 pi); NaN where `ended`
        ("azimuth_std", "<f8"),  # rad
        ("elevation", "<f8"),  # rad; NaN where not measured
        ("elevation_std", "<f8"),  # rad; NaN where not measured
        ("range", "<f8"),  # m; NaN where not measured
        ("closing_speed", "<f8"),  # m/s, positive where the range falls; NaN where not measured
        ("id", "<i8"),  # of the sensor; 0 where it gives none
        ("channel", "u1"),  # BearingChannel
        ("ended", "?"),  # the sensor has given this identity up
    ]
)


@dataclass(frozen=True, slots=True)
class Deviations:
    """What is believed of azimuth errors.

    Attributes:
        default: of sightings that tell none, or none above zero, rad.
        smallest: believed, rad.
    """

    default: float
    smallest: float

    def of(self, told: npt.ArrayLike) -> FloatArray:
        """Judge the deviations that a sensor tells.

        Args:
            told: radians, any shape; NaN, zero and negative ones tell nothing.

        Returns:
            Radians, same shape.
        """
        told = np.asarray(told, float)
        return np.maximum(np.where(told > 0.0, told, self.default), self.smallest)


def from_bearings(
    source: Rows, stamp: float, deviations: Deviations, most: int, health: Health
) -> Rows:
    """Take over the passive bearings that can be used; the others are dropped and counted by reason.

    Args:
        source: dtype BEARING, shape (n,).
        stamp: of their message, seconds.
        deviations: what is believed of azimuth errors.
        most: bearings that one message may hold.
        health: where refused bearings are counted.

    Returns:
        dtype SIGHTING, shape (m,), m <= n.
    """
    source = _at_most(source, most, "bearings over the limit of a message", health)
    rows = _empty(source, stamp, source["azimuth"], deviations.of(source["azimuth_std"]))
    rows["id"], rows["channel"] = source["id"], source["channel"]
    elevated = np.isfinite(source["elevation"]) & (source["elevation_std"] > 0.0)
    rows["elevation"] = np.where(elevated, source["elevation"], np.nan)
    rows["elevation_std"] = np.where(elevated, source["elevation_std"], np.nan)
    foreign = source["channel"] != BearingChannel.PASSIVE
    known = np.isin(source["channel"], [channel.value for channel in BearingChannel])
    return _sound(
        rows,
        source["time_offset"],
        [
            ("bearings of unknown channels", ~known),
            ("bearings of other than the passive channel", foreign),
        ],
        "bearings",
        health,
    )


def from_plots(
    source: Rows, stamp: float, deviations: Deviations, most: int, health: Health
) -> Rows:
    """Take over the directions of plots.

    Args:
        source: dtype PLOT, shape (n,).
        stamp: of their message, seconds.
        deviations: what is believed of azimuth errors.
        most: plots that one message may hold.
        health: where refused plots are counted.

    Returns:
        dtype SIGHTING, shape (m,), m <= n.
    """
    source = _at_most(source, most, "plots over the limit of a message", health)
    rows = _empty(source, stamp, source["azimuth"], deviations.of(source["azimuth_std"]))
    rows["channel"], rows["range"] = BearingChannel.ACTIVE, _believable(source["range"])
    rows["closing_speed"] = _believable_speed(-source["radial_speed"].astype(float))
    return _sound(rows, source["time_offset"], [], "plots", health)


def from_tracks(
    source: Rows,
    stamp: float,
    deviations: Deviations,
    most: int,
    health: Health,
    *,
    place: tuple[float, float],
    as_plots: bool,
) -> Rows:
    """Take over the directions of tracks that a plot has just confirmed, and the news of those that ended.

    Rows without a plot are predictions of the tracker, which measure nothing, and tentative tracks may be false.

    Args:
        source: dtype TRACK, shape (n,).
        stamp: of their message, seconds.
        deviations: what is believed of azimuth errors.
        most: tracks that one message may hold.
        health: where refused tracks are counted.
        place: (x, y) of the radar, m.
        as_plots: whether the azimuth is that of the track's last plot, else that of its smoothed position, whose
            deviation comes from the covariance.

    Returns:
        dtype SIGHTING, shape (m,), m <= n.
    """
    source = _at_most(source, most, "tracks over the limit of a message", health)
    ended = source["status"] == TrackStatus.ENDED
    steady = np.isin(source["status"], [TrackStatus.CONFIRMED, TrackStatus.COASTING])
    source = source[ended | (steady & ~np.isnan(source["plot_azimuth"]))]
    ended = source["status"] == TrackStatus.ENDED
    east, north = source["x"] - place[0], source["y"] - place[1]
    distance, azimuth = polar_from_enu(east, north)
    if as_plots:
        azimuth, told = source["plot_azimuth"], np.zeros(len(source))
    else:
        told = _across(source["covariance"], east, north)
    rows = _empty(source, stamp, azimuth, deviations.of(told))
    rows["range"], rows["id"] = _believable(distance), source["id"]
    receding = (east * source["vx"] + north * source["vy"]) / np.maximum(distance, _NEAREST)
    rows["closing_speed"] = _believable_speed(-receding)
    rows["channel"], rows["ended"] = BearingChannel.ACTIVE, ended
    rows["azimuth"][ended], rows["azimuth_std"][ended] = np.nan, 0.0
    lost = ~ended & np.isnan(rows["range"])
    return _sound(rows, source["time_offset"], [("tracks at no range", lost)], "tracks", health)


def _across(covariance: npt.NDArray[np.float32], east: FloatArray, north: FloatArray) -> FloatArray:
    matrix = covariance.reshape(-1, 4, 4)[:, :2, :2].astype(float)
    direction = np.stack([north, -east], axis=1) / np.maximum(np.hypot(east, north), 1.0)[:, None]
    variance = np.einsum("ni,nij,nj->n", direction, matrix, direction)
    determinant = matrix[:, 0, 0] * matrix[:, 1, 1] - matrix[:, 0, 1] * matrix[:, 1, 0]
    definite = (matrix[:, 0, 0] > 0.0) & (determinant > 0.0)
    across = np.sqrt(np.where(definite & (variance > 0.0), variance, 0.0))
    # A deviation of zero tells nothing, and the default will be taken.
    return across / np.maximum(np.hypot(east, north), 1.0)


def _believable(distance: npt.NDArray[np.floating]) -> FloatArray:
    return np.where((distance >= _NEAREST) & (distance <= _FARTHEST), distance, np.nan)


def _believable_speed(speed: FloatArray) -> FloatArray:
    return np.where(np.abs(speed) <= _FASTEST, speed, np.nan)


def _at_most(source: Rows, most: int, reason: str, health: Health) -> Rows:
    health.drop(reason, max(len(source) - most, 0))
    return source[:most]


def _empty(
    source: Rows, stamp: float, azimuth: npt.NDArray[np.float64], deviation: FloatArray
) -> Rows:
    rows = np.zeros(len(source), SIGHTING)
    rows["time"] = stamp + source["time_offset"]
    rows["azimuth"], rows["azimuth_std"] = azimuth, deviation
    for name in ("elevation", "elevation_std", "range", "closing_speed"):
        rows[name] = np.nan
    return rows


def _sound(
    rows: Rows,
    offset: FloatArray,
    special: list[tuple[str, BoolArray]],
    name: str,
    health: Health,
) -> Rows:
    pointing = ~rows["ended"]
    azimuth = rows["azimuth"]
    good = np.ones(len(rows), bool)
    for reason, bad in (
        *special,
        (
            f"{name} that are not finite",
            ~np.isfinite(offset) | (pointing & ~np.isfinite(azimuth)),
        ),
        (f"{name} outside [0, 2 pi)", pointing & ~((azimuth >= 0.0) & (azimuth < TWO_PI))),
        (f"{name} far from their message's time", ~(np.abs(offset) <= LONGEST_OFFSET)),
        (f"{name} with huge errors", ~(rows["azimuth_std"] <= LARGEST_AZIMUTH_STD)),
    ):
        health.drop(reason, int(np.count_nonzero(bad & good)))
        good &= ~bad
    return rows[good]
