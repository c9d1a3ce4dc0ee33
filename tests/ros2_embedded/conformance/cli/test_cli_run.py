# SPDX-License-Identifier: Apache-2.0
"""`ros2 run` and `ros2 pkg` of a package in an ament prefix."""

from __future__ import annotations

import os
import sys

import pytest

TALKER = """#!{python}
import sys
import rclpy
rclpy.init()
node = rclpy.create_node("talker")
node.declare_parameter("rate", 1)
print(node.get_fully_qualified_name(), node.get_parameter("rate").value, flush=True)
sys.exit(5)
"""


@pytest.fixture
def prefix(tmp_path, monkeypatch):
    """A package with one executable, put before all others."""
    marker = tmp_path / "share" / "ament_index" / "resource_index" / "packages" / "lab"
    marker.parent.mkdir(parents=True)
    marker.touch()
    script = tmp_path / "lib" / "lab" / "talker"
    script.parent.mkdir(parents=True)
    script.write_text(TALKER.format(python=sys.executable))
    script.chmod(0o755)
    path = os.pathsep.join(filter(None, [str(tmp_path), os.environ.get("AMENT_PREFIX_PATH")]))
    monkeypatch.setenv("AMENT_PREFIX_PATH", path)
    return tmp_path


def test_ros_arguments_reach_the_node_and_its_exit_code_comes_back(ros2, prefix):
    arguments = ("--ros-args", "-r", "__ns:=/field", "-r", "__node:=speaker", "-p", "rate:=7")
    done = ros2("run", "lab", "talker", *arguments)
    assert done.stdout.startswith("/field/speaker 7\n")
    assert done.returncode == 5


def test_what_cannot_be_run(ros2, prefix):
    done = ros2("run", "no_such_package", "talker")
    assert done.returncode == 1
    assert "Package 'no_such_package' not found" in done.stderr
    done = ros2("run", "lab", "no_such_executable")
    assert done.returncode == 1
    assert "No executable found" in done.stderr


def test_pkg(ros2, prefix):
    assert "lab" in ros2("pkg", "list").stdout.split()
    assert ros2("pkg", "prefix", "lab").stdout == f"{prefix}\n"
    assert ros2("pkg", "executables", "lab").stdout == "lab talker\n"
