# SPDX-License-Identifier: Apache-2.0
"""The statistics of `topic hz` and `topic bw`, and the pace of `bag play`."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ros2_embedded.cli.bag.pace import Pace
from ros2_embedded.cli.topic.bw import describe_bandwidth
from ros2_embedded.cli.topic.rate_meter import RateMeter

SECOND = 1_000_000_000


def test_a_steady_topic_shows_its_rate():
    meter = RateMeter(window=100)
    reports = []
    for index in range(31):
        meter.record(5 * SECOND + index * SECOND // 10)
        reports.append(meter.report())
    due = [index for index, report in enumerate(reports) if report is not None]
    assert due == [11, 21]
    assert str(reports[11]) == (
        "average rate: 10.000\n\tmin: 0.100s max: 0.100s std dev: 0.00000s window: 11"
    )


def test_the_window_forgets():
    meter = RateMeter(window=5)
    times = [index * SECOND for index in range(1, 5)]
    times += [4 * SECOND + index * SECOND // 4 for index in range(1, 13)]
    last = None
    for now in times:
        meter.record(now)
        last = meter.report() or last
    assert last.window == 5
    assert last.mean == pytest.approx(SECOND / 4)


def test_time_that_jumps_back_starts_anew():
    meter = RateMeter(window=100)
    for now in (10 * SECOND, 11 * SECOND, 12 * SECOND):
        meter.record(now)
        meter.report()
    meter.record(1 * SECOND)
    assert meter.report() is None


def test_silence_is_not_reported():
    meter = RateMeter(window=10)
    meter.record(SECOND)
    assert meter.report() is None


@pytest.mark.parametrize(
    ("size", "text"),
    [
        (10, "40 B/s from 4 messages\n\tMessage size mean: 10 B min: 10 B max: 10 B"),
        (
            5000,
            "20.00 KB/s from 4 messages\n\tMessage size mean: 5.00 KB min: 5.00 KB max: 5.00 KB",
        ),
        (
            2_000_000,
            "8.00 MB/s from 4 messages\n\tMessage size mean: 2.00 MB min: 2.00 MB max: 2.00 MB",
        ),
    ],
)
def test_bandwidth(size, text):
    received = [(index * SECOND // 4, size) for index in range(4)]
    assert describe_bandwidth(received, SECOND) == text


def test_one_message_has_no_bandwidth():
    assert describe_bandwidth([(0, 5)], SECOND) is None


@given(
    bag_start=st.integers(0, 2**61),
    wall_start=st.integers(0, 2**50),
    rate=st.floats(0.01, 100.0),
    offset=st.integers(0, 10_000 * SECOND),
)
def test_pace_goes_there_and_back(bag_start, wall_start, rate, offset):
    pace = Pace(bag_start, wall_start, rate)
    wall = pace.wall_time(bag_start + offset)
    # Rounding of the wall time to nanoseconds, and floats of 53 bits on the way.
    tolerance = rate + 2e-15 * offset * max(1.0, rate) + 1
    assert abs(pace.bag_time(wall) - bag_start - offset) <= tolerance
    assert wall - wall_start == pytest.approx(offset / rate, abs=1)
