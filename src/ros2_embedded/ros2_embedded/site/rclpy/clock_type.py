# SPDX-License-Identifier: Apache-2.0
"""The kinds of clocks."""

from __future__ import annotations

from enum import IntEnum


class ClockType(IntEnum):
    """What a clock follows."""

    UNINITIALIZED = 0
    #: Simulated time if ``use_sim_time`` is set, else system time.
    ROS_TIME = 1
    SYSTEM_TIME = 2
    STEADY_TIME = 3
