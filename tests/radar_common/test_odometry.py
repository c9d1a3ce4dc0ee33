# SPDX-License-Identifier: Apache-2.0
"""A platform's state survives the way through a message and a bag, and a message without sense is refused."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from radar_common.bag import ODOMETRY, BagWriter, read_messages, read_odometry, topics
from radar_common.cloud import TableError
from radar_common.frames import wrap_pi
from radar_common.odometry import PlatformState, decode_odometry, encode_odometry
from radar_common.ros.odometry import ODOMETRY_TYPES
from radar_common.tables import PLATFORM_TOPIC, PLOT, PLOTS_TOPIC, Table

METRES = st.floats(-1e6, 1e6)
STATES = st.builds(
    PlatformState,
    stamp=st.integers(0, 2**31 * 10**9 - 1),
    x=METRES,
    y=METRES,
    z=METRES,
    course=st.floats(0.0, 6.28),
    vx=st.floats(-1e3, 1e3),
    vy=st.floats(-1e3, 1e3),
    vz=st.floats(-1e3, 1e3),
    turn_rate=st.floats(-1.0, 1.0),
    position_variance=st.floats(0.0, 1e6),
)


@given(STATES)
def test_a_message_gives_back_the_state(state):
    back = decode_odometry(encode_odometry(state, ODOMETRY_TYPES))
    assert (back.stamp, back.frame_id) == (state.stamp, "map")
    assert float(wrap_pi(back.course - state.course)) == pytest.approx(0.0, abs=1e-9)
    for name in ("x", "y", "z", "vx", "vy", "vz", "turn_rate", "position_variance"):
        assert getattr(back, name) == pytest.approx(getattr(state, name), abs=1e-9)


def test_the_message_follows_rep_103():
    # East, then turning right: yaw 0 and the nose goes clockwise.
    east = PlatformState(0, 1.0, 2.0, 3.0, math.pi / 2, 10.0, 0.0, turn_rate=0.1)
    message = encode_odometry(east, ODOMETRY_TYPES)
    assert message.header.frame_id == "map"
    assert message.child_frame_id == "platform"
    assert message.pose.pose.orientation.w == pytest.approx(1.0)
    assert message.twist.twist.linear.x == pytest.approx(10.0)
    assert message.twist.twist.linear.y == pytest.approx(0.0)
    assert message.twist.twist.angular.z == -0.1
    north = dataclasses.replace(east, course=0.0)
    orientation = encode_odometry(north, ODOMETRY_TYPES).pose.pose.orientation
    assert (orientation.z, orientation.w) == pytest.approx((math.sqrt(0.5), math.sqrt(0.5)))


@pytest.mark.parametrize(
    ("spoil", "reason"),
    [
        (lambda m: setattr(m.pose.pose.position, "x", math.nan), "not finite"),
        (lambda m: setattr(m.twist.twist.linear, "y", math.inf), "not finite"),
        (lambda m: setattr(m.pose.pose.orientation, "w", 0.0), "length 0"),
    ],
)
def test_a_message_without_sense_is_refused(spoil, reason):
    north = PlatformState(0, 0.0, 0.0, 0.0, math.pi / 2, 0.0, 0.0)
    message = encode_odometry(north, ODOMETRY_TYPES)
    spoil(message)
    with pytest.raises(TableError, match=reason):
        decode_odometry(message)


def test_a_bag_gives_back_the_states(tmp_path):
    states = [PlatformState(k * 10**9, float(k), 0.0, 0.0, 0.0, 1.0, 0.0) for k in range(3)]
    with BagWriter(tmp_path / "bag") as bag:
        for state in states:
            bag.write_odometry(PLATFORM_TOPIC, state)
    assert topics(tmp_path / "bag") == {}
    assert [s.x for s in read_odometry(tmp_path / "bag", PLATFORM_TOPIC)] == [0.0, 1.0, 2.0]
    assert list(read_odometry(tmp_path / "bag", "elsewhere")) == []


@pytest.mark.parametrize(
    ("xx", "xy", "yy", "variance"),
    [
        (4.0, 1.0, 2.0, 3.0),
        (0.0, 0.0, 0.0, 0.0),
        (-1.0, 0.0, 3.0, 0.0),
        (1.0, 2.0, 1.0, 0.0),
        (math.nan, 0.0, 1.0, 0.0),
        (math.inf, 0.0, 1.0, 0.0),
    ],
)
def test_a_covariance_counts_only_if_positive_definite(xx, xy, yy, variance):
    message = encode_odometry(PlatformState(0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0), ODOMETRY_TYPES)
    message.pose.covariance[[0, 1, 6, 7]] = xx, xy, xy, yy
    assert decode_odometry(message).position_variance == variance


def test_tables_and_states_come_in_one_order(tmp_path):
    with BagWriter(tmp_path / "bag") as writer:
        for second in range(3):
            state = PlatformState(second * 10**9, float(second), 0.0, 0.0, 0.0, 0.0, 0.0)
            writer.write_odometry(PLATFORM_TOPIC, state)
            writer.write(PLOTS_TOPIC, Table(second * 10**9 + 5, np.zeros(second, PLOT)))
    read = list(read_messages(tmp_path / "bag", {PLOTS_TOPIC: PLOT}, odometry=PLATFORM_TOPIC))
    assert [topic for topic, _ in read] == [PLATFORM_TOPIC, PLOTS_TOPIC] * 3
    assert [content.stamp for _, content in read] == sorted(content.stamp for _, content in read)
    assert topics(tmp_path / "bag", ODOMETRY) == {PLATFORM_TOPIC: 3}
