# SPDX-License-Identifier: Apache-2.0
"""colcon builds the workspace, and what it installs is found and started by `ros2 run`."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PACKAGES = [
    "radar_common",
    "radar_sim",
    "primary_proc",
    "secondary_proc",
    "bearing_tracker",
    "radar_eval",
]


def test_the_workspace_holds_the_packages_by_a_relative_link():
    link = ROOT / "ros2_ws" / "src"
    assert link.is_symlink()
    assert link.readlink() == Path("../src")


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    if colcon_is_missing():
        pytest.skip("colcon is not installed")
    folder = tmp_path_factory.mktemp("workspace")
    subprocess.run(
        [
            *[sys.executable, "-m", "colcon", "--log-base", str(folder / "log"), "build"],
            *["--base-paths", str(ROOT / "ros2_ws" / "src")],
            *["--build-base", str(folder / "build"), "--install-base", str(folder / "install")],
        ],
        check=True,
        capture_output=True,
        cwd=folder,
    )
    return folder / "install"


def colcon_is_missing():
    return subprocess.run(
        [sys.executable, "-m", "colcon", "--help"], capture_output=True
    ).returncode


def test_every_package_is_installed_with_its_marker(built):
    assert sorted(p.name for p in built.iterdir() if (p / "share").is_dir()) == sorted(PACKAGES)
    for package in PACKAGES:
        share = built / package / "share"
        assert (share / "ament_index" / "resource_index" / "packages" / package).is_file()
        assert (share / package / "package.xml").is_file()


def test_executables_parameters_and_launch_files_are_installed(built):
    for package, node in [
        ("radar_sim", "radar_simulator"),
        ("primary_proc", "plot_extractor"),
        ("secondary_proc", "tracker"),
    ]:
        assert os.access(built / package / "lib" / package / node, os.X_OK)
        assert (built / package / "share" / package / "config" / f"{node}.yaml").is_file()
        assert (built / package / "share" / package / "launch" / f"{node}.launch.py").is_file()


def test_ros2_run_starts_what_colcon_installed(built, tmp_path):
    environment = dict(os.environ)
    environment["AMENT_PREFIX_PATH"] = os.pathsep.join(
        [*(str(built / p) for p in PACKAGES), os.environ.get("AMENT_PREFIX_PATH", "")]
    )
    done = subprocess.run(
        [
            *[shutil.which("ros2"), "run", "radar_sim", "radar_simulator"],
            *["--bag", str(tmp_path / "bag"), "--ros-args"],
            *["-p", "scenario:=tiny", "-p", "scans:=1"],
        ],
        env=environment,
        capture_output=True,
        text=True,
        check=False,
        timeout=120,
    )
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "bag" / "metadata.yaml").is_file()
