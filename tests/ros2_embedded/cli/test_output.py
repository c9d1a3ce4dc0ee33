# SPDX-License-Identifier: Apache-2.0
"""A reader of the output that leaves early."""

from __future__ import annotations

import subprocess
import sys

ROS2 = [sys.executable, "-m", "ros2_embedded.cli.main"]
PUB = [*ROS2, "topic", "pub", "-r", "200", "/flood", "std_msgs/msg/String", "data: x"]


def test_a_closed_pipe_ends_the_command_without_a_traceback():
    with subprocess.Popen(PUB, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as pub:
        assert pub.stdout.readline() == "publisher: beginning loop\n"
        pub.stdout.close()
        errors = pub.stderr.read()
        assert pub.wait(timeout=30) == 1
    assert errors == ""
