# SPDX-License-Identifier: Apache-2.0
"""The tracker against Stone Soup's global-nearest-neighbour tracker on the same plots; its growth; idle messages."""

from __future__ import annotations

import datetime
import time

import numpy as np
import pytest
from stonesoup.dataassociator.neighbour import GNNWith2DAssignment
from stonesoup.deleter.time import UpdateTimeStepsDeleter
from stonesoup.hypothesiser.distance import DistanceHypothesiser
from stonesoup.initiator.simple import MultiMeasurementInitiator
from stonesoup.measures import Mahalanobis
from stonesoup.models.measurement.linear import LinearGaussian
from stonesoup.models.transition.linear import (
    CombinedLinearGaussianTransitionModel,
    ConstantVelocity,
)
from stonesoup.predictor.kalman import KalmanPredictor
from stonesoup.tracker.simple import MultiTargetTracker
from stonesoup.types.detection import Detection
from stonesoup.types.state import GaussianState
from stonesoup.updater.kalman import KalmanUpdater

from radar_common.tables import NANOSECONDS, PLOT, Table
from secondary_proc.parameters import TrackerParameters
from secondary_proc.tracker import Tracker

PERIOD = 4.0
SECTORS = 32
WARM_UP = 6
START = 1_700_000_000 * NANOSECONDS


def turns(targets, scans, seed=1, false_plots=0):
    """Plots of straight flights, one a turn and target: for each turn (time, range, azimuth), in order of time.

    False plots lie evenly in range and azimuth, so many a turn.
    """
    random = np.random.default_rng(seed)
    x, y = random.uniform(-90e3, 90e3, (2, targets))
    vx, vy = random.uniform(-200.0, 200.0, (2, targets))
    for scan in range(scans):
        azimuth = np.mod(np.arctan2(x + vx * scan * PERIOD, y + vy * scan * PERIOD), 2 * np.pi)
        when = PERIOD * (scan + azimuth / (2 * np.pi))
        east, north = x + vx * when, y + vy * when
        distance = np.hypot(east, north) + 20.0 * random.standard_normal(targets)
        azimuth = np.arctan2(east, north) + 0.002 * random.standard_normal(targets)
        if false_plots:
            places = random.uniform(0.0, 2 * np.pi, false_plots)
            when = np.concatenate([when, PERIOD * (scan + places / (2 * np.pi))])
            azimuth = np.concatenate([azimuth, places])
            distance = np.concatenate([distance, random.uniform(1e3, 127e3, false_plots)])
        order = np.argsort(when, kind="stable")
        yield when[order], distance[order], np.mod(azimuth, 2 * np.pi)[order]


def messages(targets, scans, sectors=SECTORS, false_plots=0):
    step = PERIOD / sectors
    for scan, (when, distance, azimuth) in enumerate(
        turns(targets, scans, false_plots=false_plots)
    ):
        edges = scan * PERIOD + step * np.arange(sectors + 1)
        cuts = np.searchsorted(when, edges)
        cuts[-1] = len(when)
        for edge, first, last in zip(edges[:-1], cuts[:-1], cuts[1:], strict=True):
            rows = np.zeros(last - first, PLOT)
            rows["range"], rows["azimuth"] = distance[first:last], azimuth[first:last]
            rows["time_offset"] = when[first:last] - edge
            rows["range_std"], rows["azimuth_std"] = 20.0, 0.002
            yield Table(START + round(edge * NANOSECONDS), rows)


def seconds_of_ours(benchmark, targets, scans, sectors=SECTORS, false_plots=0):
    """Shortest time that a settled tracker takes for some turns."""
    before = list(messages(targets, WARM_UP, sectors, false_plots))
    later = list(messages(targets, WARM_UP + scans, sectors, false_plots))[len(before) :]

    def settled():
        tracker = Tracker(TrackerParameters())
        for message in before:
            tracker.process(message)
        return (tracker,), {}

    def work(tracker):
        for message in later:
            tracker.process(message)

    benchmark.pedantic(work, setup=settled, rounds=5)
    return benchmark.stats.stats.min


def stone_soup(detections):
    motion = CombinedLinearGaussianTransitionModel([ConstantVelocity(0.4)] * 2)
    error = LinearGaussian(4, (0, 2), np.diag([100.0**2, 100.0**2]))
    predictor, updater = KalmanPredictor(motion), KalmanUpdater(error)
    associator = GNNWith2DAssignment(
        DistanceHypothesiser(predictor, updater, Mahalanobis(), missed_distance=3.5)
    )
    prior = GaussianState(np.zeros(4), np.diag([100.0, 200.0, 100.0, 200.0]) ** 2)
    deleter = UpdateTimeStepsDeleter(6)
    initiator = MultiMeasurementInitiator(
        prior, deleter, associator, updater, measurement_model=error, min_points=3
    )
    return MultiTargetTracker(initiator, deleter, detections, associator, updater), error


def detections_of(scans, error):
    origin = datetime.datetime(2024, 1, 1, tzinfo=datetime.UTC).replace(tzinfo=None)
    for scan, (_, distance, azimuth) in enumerate(scans):
        # One time a turn, as its scan-by-scan design expects.
        when = origin + datetime.timedelta(seconds=PERIOD * scan)
        east, north = distance * np.sin(azimuth), distance * np.cos(azimuth)
        yield (
            when,
            {
                Detection(np.array([[x], [y]]), timestamp=when, measurement_model=error)
                for x, y in zip(east, north, strict=True)
            },
        )


def seconds_of_stone_soup(targets, scans):
    tracker, error = stone_soup(None)
    tracker.detector = detections_of(turns(targets, WARM_UP + scans), error)
    steps = iter(tracker)
    for _ in range(WARM_UP):
        next(steps)
    begin = time.perf_counter()
    for _ in range(scans):
        next(steps)
    return time.perf_counter() - begin


@pytest.mark.parametrize("sectors", [1, SECTORS], ids=["a message a turn", "32 messages a turn"])
def test_against_stone_soup(benchmark, ratio, sectors):
    targets, scans = 100, 5
    ours = seconds_of_ours(benchmark, targets, scans, sectors)
    peer = min(seconds_of_stone_soup(targets, scans) for _ in range(2))
    ratio(
        f"tracker, 100 targets, {sectors} messages a turn",
        peer / ours,
        f"times Stone Soup's GNN; ours {targets * scans / ours:.0f}, "
        f"peer {targets * scans / peer:.0f} plots/s",
    )


def seconds_of_100_tracks():
    few, times = list(messages(100, WARM_UP + 5)), []
    for _ in range(3):
        tracker = Tracker(TrackerParameters())
        for message in few[: WARM_UP * SECTORS]:
            tracker.process(message)
        begin = time.perf_counter()
        for message in few[WARM_UP * SECTORS :]:
            tracker.process(message)
        times.append(time.perf_counter() - begin)
    return min(times)


def test_growth_from_100_to_4000_tracks(benchmark, ratio):
    small = seconds_of_100_tracks() / (100 * 5)
    large = seconds_of_ours(benchmark, 4000, 3) / (4000 * 3)
    ratio("tracker, time per plot, 100 over 4000 tracks", small / large, "above 1/3 is near-linear")
    ratio("tracker, 4000 tracks", PERIOD / (large * 4000), "times faster than real time")


def test_4000_tracks_among_as_many_false_plots(benchmark, ratio):
    turns_measured = 2
    seconds = seconds_of_ours(benchmark, 4000, turns_measured, false_plots=4000)
    ratio(
        "tracker, 4000 tracks, 2000 plots/s",
        turns_measured * PERIOD / seconds,
        "times faster than real time; half of the plots are false",
    )


def test_idle_message(benchmark, ratio):
    tracker = Tracker(TrackerParameters())
    for message in messages(100, WARM_UP):
        tracker.process(message)
    empty = Table(START + round(WARM_UP * PERIOD * NANOSECONDS), np.zeros(0, PLOT))
    benchmark(lambda: tracker.process(empty))
    ratio(
        "tracker, idle message",
        0.3e-3 / benchmark.stats.stats.median,
        "times faster than the 0.3 ms allowed",
    )
