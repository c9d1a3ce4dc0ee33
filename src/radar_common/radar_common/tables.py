# SPDX-License-Identifier: Apache-2.0
"""The tables that travel between the nodes: one documented numpy dtype each.

A table is the content of one message. Rows carry `time_offset`, seconds after the message's stamp, so every pulse,
plot and track has a time of its own and no step is ever assumed. Angles are radians clockwise from north, lengths
metres; `x`, `y`, `z` are ENU metres and float32 because viewers of point clouds expect exactly that.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum

import numpy as np
import numpy.typing as npt

SWEEPS_TOPIC = "radar/sweeps"
PLOTS_TOPIC = "radar/plots"
TRACKS_TOPIC = "radar/tracks"
BEARINGS_TOPIC = "passive/bearings"
FUSED_BEARINGS_TOPIC = "fused/bearings"
EMITTERS_TOPIC = "emitters"
PLATFORM_TOPIC = "platform/odometry"
TRUTH_TOPIC = "truth"
CHANNEL_TRUTH_TOPIC = "truth/channels"

SITE_FRAME = "map"
RADAR_FRAME = "radar"

NANOSECONDS = 1_000_000_000


class TrackStatus(IntEnum):
    """Where a track stands in its life; `ended` is published once and the id is never used again."""

    TENTATIVE = 0
    CONFIRMED = 1
    COASTING = 2
    ENDED = 3


class EndReason(IntEnum):
    """Why a track ended; `alive` while it has not."""

    ALIVE = 0
    MISSES = 1
    """Too many scans in a row without a plot."""
    SCORE = 2
    """Its score has fallen as far as a row of misses would bring it."""
    NOT_CONFIRMED = 3
    """The rule of initiation gave the candidate up."""
    TIME_WENT_BACK = 4
    """The clock of the plots jumped back and tracking began anew."""
    OUT_OF_COVERAGE = 5
    """It left the range that is processed."""


class BearingChannel(IntEnum):
    """Which sensor an angle came from."""

    ACTIVE = 0
    PASSIVE = 1
    FUSED = 2


PLOT = np.dtype(
    [
        ("x", "<f4"),  # east, m
        ("y", "<f4"),  # north, m
        ("z", "<f4"),  # up, m
        ("range", "<f8"),  # m
        ("azimuth", "<f8"),  # rad clockwise from north, [0, 2 pi)
        ("range_std", "<f4"),  # m
        ("azimuth_std", "<f4"),  # rad
        ("time_offset", "<f8"),  # s after the stamp, time of the burst's centre
        ("amplitude", "<f4"),  # peak of the burst over the local noise level (1 = noise rms)
        ("snr_db", "<f4"),  # power of the burst's peak over the noise power
        ("pulse_count", "<u2"),  # azimuth positions between start and end of the burst
        ("quality", "<f4"),  # 0 (as noise makes them) to 1
        ("radial_speed", "<f4"),  # m/s, positive away from the radar; NaN where not measured
        ("radial_speed_std", "<f4"),  # m/s; NaN where not measured
    ]
)

TRACK = np.dtype(
    [
        ("x", "<f4"),
        ("y", "<f4"),
        ("z", "<f4"),
        ("vx", "<f4"),  # m/s east
        ("vy", "<f4"),  # m/s north
        ("covariance", "<f4", (16,)),  # of (x, y, vx, vy), row by row
        ("id", "<u4"),  # never reused
        ("status", "u1"),  # TrackStatus
        ("end_reason", "u1"),  # EndReason
        ("time_offset", "<f8"),  # s after the stamp, the time that the state belongs to
        ("speed", "<f4"),  # m/s
        ("course", "<f4"),  # rad clockwise from north
        (
            "plot_range",
            "<f8",
        ),  # the last plot of the track, as it was received; NaN if this row is a prediction
        ("plot_azimuth", "<f8"),
        ("hits", "<u4"),  # plots in the track
        ("misses", "<u4"),  # scans without a plot since the last one
        ("age", "<f4"),  # s since the track's first plot
        (
            "score",
            "<f4",
        ),  # logarithmic likelihood ratio of target against false track; NaN if the rule keeps none
    ]
)

CHANNEL_STATES = 4
"""States of one angle channel that a row of bearings has room for."""

BEARING = np.dtype(
    [
        ("azimuth", "<f8"),  # rad clockwise from north, [0, 2 pi)
        ("azimuth_std", "<f4"),  # rad
        ("elevation", "<f4"),  # rad over the horizon; NaN where not measured
        ("elevation_std", "<f4"),  # rad; NaN where not measured
        ("rate", "<f4"),  # of the azimuth, rad/s; NaN where not estimated
        ("rate_std", "<f4"),  # rad/s; NaN where not estimated
        ("time_offset", "<f8"),  # s after the stamp
        ("id", "<u4"),  # source or target; 0 where the sensor gives no identity
        ("channel", "u1"),  # BearingChannel
        # Probability of each state of a channel, the undisturbed one first; NaN where not estimated or no such state.
        ("active_health", "<f4", (CHANNEL_STATES,)),
        ("passive_health", "<f4", (CHANNEL_STATES,)),
    ]
)

EMITTER = np.dtype(
    [
        ("x", "<f4"),  # m east; in the middle of what is possible while the range is unknown
        ("y", "<f4"),  # m north
        ("z", "<f4"),  # m up
        ("vx", "<f4"),  # m/s east
        ("vy", "<f4"),  # m/s north
        ("covariance", "<f4", (16,)),  # of (x, y, vx, vy), row by row
        ("id", "<u4"),  # of the sensor where it gives one, else its own; never reused
        ("status", "u1"),  # TrackStatus
        ("range_known", "u1"),  # 0 while only the direction is known: a ray, not an ellipse
        ("time_offset", "<f8"),  # s after the stamp, the time that the state belongs to
        ("azimuth", "<f8"),  # rad clockwise from north, from the platform
        ("azimuth_std", "<f4"),  # rad
        ("range", "<f4"),  # m from the platform
        ("range_std", "<f4"),  # m
        ("bound_std", "<f4"),  # m, Cramer-Rao bound of the position along the estimated geometry
        ("hits", "<u4"),  # bearings used
        ("rejected", "<u4"),  # bearings of this identity that did not fit
        ("age", "<f4"),  # s since the first bearing
    ]
)

TRUTH = np.dtype(
    [
        ("x", "<f4"),
        ("y", "<f4"),
        ("z", "<f4"),
        ("vx", "<f4"),
        ("vy", "<f4"),
        ("vz", "<f4"),
        ("id", "<u4"),
        ("time_offset", "<f8"),
        ("range", "<f8"),
        ("azimuth", "<f8"),
        (
            "snr_db",
            "<f4",
        ),  # mean power signal-to-noise ratio of one pulse at the beam's centre; NaN if unknown
    ]
)


def sweep_dtype(cells: int, sample: npt.DTypeLike = np.float32) -> np.dtype[np.void]:
    """Row layout of `radar/sweeps`: one pulse with its range cells.

    Args:
        cells: number of range cells N of a pulse.
        sample: type of one sample of the linear envelope: float32, uint8 or uint16.

    Returns:
        dtype with azimuth (rad), time_offset (s), range_start (m, near edge of cell 0), range_step (m) and video[N].

    Raises:
        ValueError: the pulse has no cell, or the sample type is none of the three.
    """
    sample = np.dtype(sample)
    if cells < 1:
        raise ValueError(f"a sweep needs at least one range cell, got {cells}")
    if sample not in (np.dtype(np.float32), np.dtype(np.uint8), np.dtype(np.uint16)):
        raise ValueError(f"video samples are float32, uint8 or uint16, not {sample}")
    return np.dtype(
        [
            ("azimuth", "<f8"),
            ("time_offset", "<f8"),
            ("range_start", "<f8"),
            ("range_step", "<f8"),
            ("video", sample.newbyteorder("<"), (cells,)),
        ]
    )


@dataclass(frozen=True, slots=True)
class Table:
    """Rows of one message with the time and the frame that they refer to.

    Attributes:
        stamp: nanoseconds since the epoch of the clock in use.
        rows: structured array, shape (n,).
        frame_id: frame of `x`, `y`, `z` and of the azimuth's north.
    """

    stamp: int
    rows: npt.NDArray[np.void]
    frame_id: str = RADAR_FRAME

    @property
    def times(self) -> npt.NDArray[np.float64]:
        """Time of each row in seconds since the epoch, shape (n,)."""
        return self.stamp / NANOSECONDS + self.rows["time_offset"]
