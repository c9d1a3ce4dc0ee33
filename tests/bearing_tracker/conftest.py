# SPDX-License-Identifier: Apache-2.0
"""Made-up channels: straight flights seen by a radar's tracker and heard by a direction finder beside it."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
import pytest

from radar_common.tables import BEARING, NANOSECONDS, TRACK, BearingChannel, Table, TrackStatus

START = 1_700_000_000 * NANOSECONDS
ACTIVE_STD = 0.003
PASSIVE_STD = 0.01
JAM = 10.0


def bearing_rows(azimuth, *, std=PASSIVE_STD, identity=0, time_offset=0.0):
    rows = np.zeros(len(np.atleast_1d(azimuth)), BEARING)
    for name in ("elevation", "elevation_std", "rate", "rate_std"):
        rows[name] = np.nan
    rows["active_health"] = rows["passive_health"] = np.nan
    rows["azimuth"], rows["azimuth_std"], rows["id"] = azimuth, std, identity
    rows["channel"], rows["time_offset"] = BearingChannel.PASSIVE, time_offset
    return rows


def track_rows(position, identity, *, azimuth=None, time_offset=0.0, across=50.0):
    position = np.atleast_2d(position)
    rows = np.zeros(len(position), TRACK)
    rows["x"], rows["y"] = position.T
    rows["covariance"] = (np.eye(4) * across**2).ravel()
    rows["id"], rows["status"], rows["time_offset"] = identity, TrackStatus.CONFIRMED, time_offset
    rows["plot_range"] = np.hypot(*position.T)
    told = np.arctan2(*position.T) if azimuth is None else azimuth
    rows["plot_azimuth"] = np.mod(told, 2 * np.pi)
    return rows


@dataclass
class Flight:
    """A target on a straight line, with the times in which either channel reports of it."""

    position: tuple
    velocity: tuple
    track: int = 0
    source: int = 0
    seen: tuple = (0.0, 1e9)
    heard: tuple = (0.0, 1e9)

    def at(self, time):
        return np.array(self.position) + np.array(self.velocity) * time

    def azimuth(self, time):
        return np.mod(np.arctan2(*self.at(time)), 2 * np.pi)


@dataclass
class Channels:
    """Messages of both channels; the jam multiplies the radar's azimuth error."""

    flights: list
    seed: int = 0
    radar_period: float = 2.0
    finder_period: float = 1.0
    jam: tuple = (1e9, 1e9)
    end: float = 60.0
    messages: list = field(default_factory=list)

    def __post_init__(self):
        self.random = np.random.default_rng(self.seed)
        self._radar()
        self._finder()
        self.messages.sort(key=lambda message: message.stamp)

    def _radar(self):
        for time in np.arange(0.0, self.end, self.radar_period):
            rows = [track_rows(np.zeros((0, 2)), 0)]
            for flight in self.flights:
                if not flight.seen[0] <= time <= flight.seen[1]:
                    continue
                std = ACTIVE_STD * (JAM if self.jam[0] <= time < self.jam[1] else 1.0)
                azimuth = flight.azimuth(time) + std * self.random.standard_normal()
                distance = np.hypot(*flight.at(time))
                where = distance * np.array([np.sin(azimuth), np.cos(azimuth)])
                row = track_rows(where, flight.track, across=ACTIVE_STD * distance)
                if flight.seen[1] < time + self.radar_period < self.end:
                    row = np.concatenate([row, row])
                    row["status"][1], row["plot_azimuth"][1] = TrackStatus.ENDED, np.nan
                rows.append(row)
            self.messages.append(Table(START + round(time * NANOSECONDS), np.concatenate(rows)))

    def _finder(self):
        for time in np.arange(0.3, self.end, self.finder_period):
            rows = [bearing_rows(np.zeros(0))]
            for flight in self.flights:
                if flight.heard[0] <= time <= flight.heard[1]:
                    azimuth = flight.azimuth(time) + PASSIVE_STD * self.random.standard_normal()
                    rows.append(bearing_rows(np.mod(azimuth, 2 * np.pi), identity=flight.source))
            self.messages.append(Table(START + round(time * NANOSECONDS), np.concatenate(rows)))


def run_pipeline(pipeline, messages):
    """All rows that a pipeline gives, with their times since START."""
    tables = [pipeline.process(message) for message in messages]
    tables.append(pipeline.flush())
    rows = np.concatenate([table.rows for table in tables])
    times = [(t.stamp - START) / NANOSECONDS + t.rows["time_offset"] for t in tables]
    return rows, np.concatenate(times)


@pytest.fixture(scope="session")
def channels():
    return Channels


@pytest.fixture(scope="session")
def flight():
    return Flight


@pytest.fixture(scope="session")
def run():
    return run_pipeline


@pytest.fixture(scope="session")
def make_bearings():
    return bearing_rows


@pytest.fixture(scope="session")
def make_tracks():
    return track_rows


@pytest.fixture(scope="session")
def start():
    return START
