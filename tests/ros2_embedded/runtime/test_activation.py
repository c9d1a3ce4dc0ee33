# SPDX-License-Identifier: Apache-2.0
"""Who supplies rclpy: another installation if there is one, else this runtime."""

from __future__ import annotations

import os
import subprocess
import sys
import sysconfig
from pathlib import Path

import pytest

PACKAGE = Path(__file__).parents[3] / "src" / "ros2_embedded"


def run(source, python=sys.executable, **environment):
    return subprocess.run(
        [str(python), "-c", source],
        capture_output=True,
        text=True,
        timeout=60,
        env={**os.environ, **environment},
        check=False,
    )


@pytest.fixture
def foreign(tmp_path):
    """A directory with another rclpy."""
    (tmp_path / "rclpy.py").write_text("origin = 'foreign'\n")
    return str(tmp_path)


def test_rclpy_is_supplied():
    result = run("import rclpy; print(rclpy.__file__)")
    assert "ros2_embedded" in result.stdout, result.stderr


def test_another_rclpy_wins(foreign):
    result = run("import rclpy; print(rclpy.origin)", PYTHONPATH=foreign)
    assert result.stdout == "foreign\n", result.stderr


def test_messages_are_not_supplied_beside_another_rclpy(foreign):
    result = run("import std_msgs.msg", PYTHONPATH=foreign)
    assert "ModuleNotFoundError" in result.stderr


def test_another_message_package_wins(tmp_path):
    (tmp_path / "std_msgs").mkdir()
    (tmp_path / "std_msgs" / "__init__.py").write_text("origin = 'foreign'\n")
    result = run("import std_msgs; print(std_msgs.origin)", PYTHONPATH=str(tmp_path))
    assert result.stdout == "foreign\n", result.stderr


@pytest.mark.parametrize(
    "name", ["rclpy.nothing", "std_msgs.nothing", "std_msgs.msg._nothing", "geometry_msgs.srv"]
)
def test_what_is_not_there_is_not_found(name):
    result = run(f"import {name}")
    assert "ModuleNotFoundError" in result.stderr


def test_unknown_message_is_no_attribute():
    result = run("from std_msgs.msg import Strange")
    assert "ImportError" in result.stderr


def test_module_of_a_type():
    result = run(
        "from std_msgs.msg._string import String as a; from std_msgs.msg import String as b;"
        "from std_srvs.srv import SetBool, SetBool_Request as r; print(a is b, SetBool.Request is r)"
    )
    assert result.stdout == "True True\n", result.stderr


def test_interpreter_start_imports_no_library():
    libraries = {"rclpy", "numpy", "rosbags", "cyclonedds", "yaml"}
    result = run(f"import sys; print(*({libraries} & set(sys.modules)))")
    assert result.stdout == "\n", result.stderr


def test_rclpy_import_leaves_dds_alone():
    result = run("import rclpy, sys; print('cyclonedds' in sys.modules, 'numpy' in sys.modules)")
    assert result.stdout == "False False\n", result.stderr


@pytest.mark.parametrize("options", [[], ["--editable"]], ids=["normal", "editable"])
def test_installation_activates_the_finder(options, tmp_path):
    environment = tmp_path / "environment"
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", environment], check=True)
    python = environment / "bin" / "python"
    libraries = sysconfig.get_path("purelib")
    before = run("import rclpy", python, PYTHONPATH="")
    assert "ModuleNotFoundError" in before.stderr
    pip = [sys.executable, "-m", "pip", "--python", str(python), "install", "--quiet"]
    # The libraries of this environment serve the new one; its .pth files do not.
    subprocess.run(
        [*pip, "--no-deps", "--no-build-isolation", *options, str(PACKAGE)],
        check=True,
        env={**os.environ, "PYTHONPATH": libraries},
    )
    source = "import rclpy; from std_msgs.msg import String; print(String(data='x').data)"
    result = run(source, python, PYTHONPATH=libraries)
    assert result.stdout == "x\n", result.stderr


def test_finder_stands_last_and_once():
    source = (
        "import sys; from ros2_embedded.activation import EmbeddedFinder, activate; activate();"
        "print([isinstance(f, EmbeddedFinder) for f in sys.meta_path].index(True)"
        " == len(sys.meta_path) - 1)"
    )
    assert run(source).stdout == "True\n"
