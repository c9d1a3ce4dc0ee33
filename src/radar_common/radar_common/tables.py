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
TRUTH_TOPIC = "truth"

SITE_FRAME = "map"
RADAR_FRAME = "radar"

NANOSECONDS = 1_000_000_000


class TrackStatus(IntEnum):
    """Where a track stands in its life; `ended` is published once and the id is never used again."""

    TENTATIVE = 0
    CONFIRMED = 1
    COASTING = 2
    ENDED = 3


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

BEARING = np.dtype(
    [
        ("azimuth", "<f8"),
        ("azimuth_std", "<f4"),
        ("rate", "<f4"),  # rad/s; NaN where not estimated
        ("time_offset", "<f8"),
        ("id", "<u4"),  # source or target; 0 where the sensor gives no identity
        ("channel", "u1"),  # BearingChannel
        (
            "health",
            "<f4",
            (4,),
        ),  # probability of each state of the channel; NaN where not estimated
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
