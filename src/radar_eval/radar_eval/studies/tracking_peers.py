# SPDX-License-Identifier: Apache-2.0
"""Stone Soup's trackers on the plots of a scene, with models comparable to ours, their tracks in our tables.

Stone Soup is wanted for this comparison alone, so it is imported only when one of its trackers is asked for.
"""

from __future__ import annotations

import datetime
import time
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from radar_common.frames import TWO_PI, enu_covariance, enu_from_polar, polar_from_enu
from radar_common.tables import NANOSECONDS, SITE_FRAME, TRACK, Table, TrackStatus
from radar_eval.errors import EvaluationError
from radar_eval.studies.tracking_stone_soup import (
    PeerSettings,
    build_tracker,
    require_stone_soup,
)

FloatArray = npt.NDArray[np.float64]
Rows = npt.NDArray[np.void]

PEERS = ("Stone Soup GNN", "Stone Soup JPDA")

_EPOCH = datetime.datetime(2024, 1, 1)


def run_peer(
    name: str,
    plots: Sequence[Table],
    *,
    period: float,
    false_plots: float,
    reach: float,
    settings: PeerSettings | None = None,
) -> tuple[float, list[Table]]:
    """Run one of Stone Soup's trackers, scan by scan as it is made for.

    Every plot has a measurement model of its own, with the covariance that its errors have in x and y. The global
    nearest neighbour takes each plot at its own time. The mixtures of JPDA need one time a scan; as a target is seen
    at nearly the same azimuth in each, that time is set back to the plot's own in what is returned.

    Args:
        name: one of PEERS.
        plots: messages in order of time, the first one's stamp the begin of a scan.
        period: of the antenna, s.
        false_plots: mean number a scan, from which JPDA gets its density.
        reach: m, over which they are spread.
        settings: None for the defaults.

    Returns:
        (seconds, tracks): time that the tracker took, and its tracks as messages, one a scan.

    Raises:
        EvaluationError: Stone Soup is not installed, or has no such tracker.
    """
    if name not in PEERS:
        raise EvaluationError(f"no tracker {name!r}; there are {', '.join(PEERS)}")
    settings = PeerSettings() if settings is None else settings
    joint = name == PEERS[1]
    require_stone_soup()
    tracker = build_tracker(settings, joint=joint, density=false_plots / (np.pi * reach**2))
    scans = list(_scans(plots, period, own_time=not joint))
    publisher = _Publisher(period, plots[0].stamp, own_time=not joint)
    tracker.detector = [(when, detections) for when, detections in scans]
    messages, seconds, steps = [], 0.0, iter(tracker)
    for scan in range(len(scans)):
        begin = time.perf_counter()
        _, tracks = next(steps)
        seconds += time.perf_counter() - begin
        messages.append(publisher.publish(scan, tracks))
    return seconds, messages


def _scans(
    plots: Sequence[Table], period: float, *, own_time: bool
) -> Iterator[tuple[datetime.datetime, set[Any]]]:
    from stonesoup.models.measurement.linear import LinearGaussian
    from stonesoup.types.detection import Detection

    start = plots[0].stamp
    rows = np.concatenate([table.rows for table in plots])
    times = np.concatenate(
        [(table.stamp - start) / NANOSECONDS + table.rows["time_offset"] for table in plots]
    )
    x, y = enu_from_polar(rows["range"], rows["azimuth"])
    covariance = enu_covariance(
        rows["range"], rows["azimuth"], rows["range_std"], rows["azimuth_std"]
    )
    scan = np.floor(times / period).astype(int)
    for number in range(int(scan.max(initial=-1)) + 1):
        # What is missed is predicted to the end of the scan: a plot of the next one can only be later.
        at = (number + 1) * period
        end = _EPOCH + datetime.timedelta(seconds=at)
        yield (
            end,
            {
                Detection(
                    np.array([[x[i]], [y[i]]]),
                    timestamp=_EPOCH + datetime.timedelta(seconds=times[i]) if own_time else end,
                    measurement_model=LinearGaussian(4, (0, 2), covariance[i]),
                    metadata={
                        "time": times[i],
                        "range": rows["range"][i],
                        "azimuth": rows["azimuth"][i],
                    },
                )
                for i in np.flatnonzero(scan == number).tolist()
            },
        )


class _Publisher:
    """Writes the tracks of each scan as our tracker would."""

    def __init__(self, period: float, start: int, *, own_time: bool) -> None:
        self._period, self._start, self._own_time = period, start, own_time
        self._ids: dict[str, int] = {}
        self._written: dict[str, int] = {}

    def publish(self, scan: int, tracks: set[Any]) -> Table:
        """Write what is new.

        Args:
            scan: number of the scan.
            tracks: that are confirmed now.

        Returns:
            A row for each new state; the states before a track's confirmation are tentative.
        """
        stamp = self._start + round((scan + 1) * self._period * NANOSECONDS)
        since = (stamp - self._start) / NANOSECONDS
        rows = []
        for track in tracks:
            done = self._written.get(track.id, 0)
            new = not done
            number = self._ids.setdefault(track.id, len(self._ids) + 1)
            hits = sum(self._plot(state) is not None for state in track[:done])
            for index, state in enumerate(track[done:], start=done):
                hits += self._plot(state) is not None
                tentative = new and index < len(track) - 1
                rows.append(self._row(state, number, hits, since, tentative=tentative))
            self._written[track.id] = len(track)
        return Table(stamp, np.concatenate([np.zeros(0, TRACK), *rows], dtype=TRACK), SITE_FRAME)

    @staticmethod
    def _plot(state: Any) -> dict[str, float] | None:
        """The plot behind a state, the likeliest one where it is a mixture; None for a prediction."""
        hypothesis = getattr(state, "hypothesis", None)
        if hypothesis is None:
            return None
        several = getattr(hypothesis, "single_hypotheses", None)
        if several is not None:
            hypothesis = max(several, key=lambda single: float(single.probability))
        metadata: dict[str, float] = hypothesis.measurement.metadata
        return metadata if hypothesis else None

    def _row(self, state: Any, number: int, hits: int, since: float, *, tentative: bool) -> Rows:
        row = np.zeros(1, TRACK)
        x, vx, y, vy = (float(value) for value in np.asarray(state.state_vector).ravel())
        plot = self._plot(state)
        azimuth = float(polar_from_enu(x, y)[1])
        at = (state.timestamp - _EPOCH).total_seconds()
        if not self._own_time:
            at += self._period * (azimuth / TWO_PI - 1.0)
        row["x"], row["y"], row["vx"], row["vy"] = x, y, vx, vy
        order = [0, 2, 1, 3]
        row["covariance"] = np.asarray(state.covar, dtype=float)[np.ix_(order, order)].ravel()
        row["id"], row["hits"] = number, hits
        row["speed"], row["course"] = polar_from_enu(vx, vy)
        row["plot_range"] = row["plot_azimuth"] = row["score"] = np.nan
        row["status"] = TrackStatus.COASTING
        if plot is not None:
            at = plot["time"]
            row["plot_range"], row["plot_azimuth"] = plot["range"], plot["azimuth"]
            row["status"] = TrackStatus.CONFIRMED
        if tentative:
            row["status"] = TrackStatus.TENTATIVE
        row["time_offset"] = at - since
        return row
