# SPDX-License-Identifier: Apache-2.0
"""Packages and executables are found where colcon and pip put them."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from ros2_embedded.cli.packages import (
    PackageNotFoundError,
    executables,
    package_names,
    package_prefix,
)

ROS2 = [sys.executable, "-m", "ros2_embedded.cli.main"]


def install(prefix: Path, package: str, **scripts: str) -> None:
    """Lay out a package as colcon does."""
    marker = prefix / "share" / "ament_index" / "resource_index" / "packages" / package
    marker.parent.mkdir(parents=True, exist_ok=True)
    marker.touch()
    for name, text in scripts.items():
        script = prefix / "lib" / package / name
        script.parent.mkdir(parents=True, exist_ok=True)
        script.write_text(text)
        script.chmod(0o755)


def install_distribution(site: Path, name: str, module: str, entry_points: str) -> None:
    """Lay out a distribution as pip does."""
    info = site / f"{name.replace('-', '_')}-1.0.dist-info"
    info.mkdir(parents=True)
    (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {name}\nVersion: 1.0\n")
    (info / "entry_points.txt").write_text(f"[console_scripts]\n{entry_points}\n")
    marker = f"../../../share/ament_index/resource_index/packages/{name.replace('-', '_')}"
    (info / "RECORD").write_text(f"{marker},,\n")
    (site / "sonar_nodes.py").write_text(module)


@pytest.fixture
def isolated(tmp_path, monkeypatch):
    """Two packages, each in a prefix of its own."""
    for package in ("alpha", "beta"):
        install(tmp_path / package, package, talker=f'#!/bin/sh\necho {package} "$@"\n')
    joined = os.pathsep.join(str(tmp_path / package) for package in ("alpha", "beta"))
    monkeypatch.setenv("AMENT_PREFIX_PATH", joined)
    return tmp_path


@pytest.fixture
def merged(tmp_path, monkeypatch):
    """Two packages in one prefix."""
    for package in ("alpha", "beta"):
        install(tmp_path, package, talker=f'#!/bin/sh\necho {package} "$@"\n')
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(tmp_path))
    return tmp_path


@pytest.fixture
def distribution(tmp_path, monkeypatch):
    """A package installed by pip, with a node that reports and one that fails."""
    module = (
        "import sys\n"
        "def report():\n    print('ping', *sys.argv)\n"
        "def fail():\n    return 7\n"
        "def wait():\n"
        "    import signal\n"
        "    signal.signal(signal.SIGTERM, lambda *_: sys.exit(5))\n"
        "    print('ready', flush=True)\n"
        "    signal.pause()\n"
    )
    entry_points = "ping = sonar_nodes:report\nfail = sonar_nodes:fail\nwait = sonar_nodes:wait"
    install_distribution(tmp_path / "site", "sonar-nodes", module, entry_points)
    monkeypatch.syspath_prepend(tmp_path / "site")
    monkeypatch.setenv(
        "PYTHONPATH", os.pathsep.join([str(tmp_path / "site"), os.environ.get("PYTHONPATH", "")])
    )


@pytest.mark.parametrize("layout", ["isolated", "merged"])
def test_packages_of_both_colcon_layouts_are_found(layout, request):
    prefix = request.getfixturevalue(layout)
    assert {"alpha", "beta"} <= set(package_names())
    expected = prefix / "beta" if layout == "isolated" else prefix
    assert package_prefix("beta") == expected
    (talker,) = executables("beta")
    assert talker.path == str(expected / "lib" / "beta" / "talker")


def test_only_executable_files_count_and_hidden_folders_do_not(merged):
    folder = merged / "lib" / "alpha"
    (folder / "data.txt").write_text("no program")
    (folder / ".hidden").mkdir()
    hidden = folder / ".hidden" / "tool"
    hidden.write_text("#!/bin/sh\n")
    hidden.chmod(0o755)
    assert [entry.name for entry in executables("alpha")] == ["talker"]


def test_the_nearest_overlay_wins(tmp_path, monkeypatch):
    for prefix in ("overlay", "underlay"):
        install(tmp_path / prefix, "alpha", talker="#!/bin/sh\n")
    joined = os.pathsep.join(str(tmp_path / prefix) for prefix in ("overlay", "underlay"))
    monkeypatch.setenv("AMENT_PREFIX_PATH", joined)
    assert package_prefix("alpha") == tmp_path / "overlay"


@pytest.mark.parametrize("name", ["sonar_nodes", "sonar-nodes"])
def test_a_distribution_is_found_under_either_spelling(distribution, name):
    assert [entry.name for entry in executables(name)] == ["fail", "ping", "wait"]
    assert "sonar_nodes" in package_names()


def test_an_editable_distribution_is_a_package_by_its_source(distribution, tmp_path):
    info = tmp_path / "site" / "sonar_nodes-1.0.dist-info"
    (info / "RECORD").unlink()
    source = tmp_path / "my source"
    source.mkdir()
    (info / "direct_url.json").write_text(json.dumps({"url": source.as_uri()}))
    assert "sonar_nodes" not in package_names()
    (source / "package.xml").touch()
    assert "sonar_nodes" in package_names()


def test_an_unknown_package_is_an_error():
    with pytest.raises(PackageNotFoundError):
        executables("no_such_package")


def test_run_passes_arguments_on_untouched(merged):
    words = [*ROS2, "run", "beta", "talker", "--ros-args", "-p", "x:=1", "--help"]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    assert done.stdout == "beta --ros-args -p x:=1 --help\n"
    assert done.returncode == 0


def test_run_with_a_prefix(merged):
    words = [
        *ROS2,
        "run",
        "--prefix",
        "env GREETING=hello sh -c 'echo $GREETING'",
        "beta",
        "talker",
    ]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    assert done.stdout == "hello\n"


def test_run_of_an_entry_point_sees_its_own_name_and_arguments(distribution):
    words = [*ROS2, "run", "sonar_nodes", "ping", "-a", "b"]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    assert done.stdout == "ping ping -a b\n"


def test_run_returns_the_exit_code_of_the_executable(distribution):
    done = subprocess.run([*ROS2, "run", "sonar_nodes", "fail"], check=False)
    assert done.returncode == 7


def test_the_executable_gets_the_signals(distribution):
    words = [*ROS2, "run", "sonar_nodes", "wait"]
    with subprocess.Popen(words, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout.readline() == "ready\n"
        process.send_signal(signal.SIGTERM)
        assert process.wait(timeout=10) == 5


def test_errors_of_run_name_what_there_is(merged):
    words = [*ROS2, "run", "gamma", "talker"]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert done.stderr.startswith("Package 'gamma' not found")
    assert "alpha" in done.stderr
    done = subprocess.run([*ROS2, "run", "beta", "x"], capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert done.stderr.startswith("No executable found")
    assert "talker" in done.stderr


def test_two_executables_of_one_name_are_refused(merged):
    deeper = merged / "lib" / "beta" / "old" / "talker"
    deeper.parent.mkdir()
    deeper.write_text("#!/bin/sh\n")
    deeper.chmod(0o755)
    words = [*ROS2, "run", "beta", "talker"]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert done.stderr.startswith("Multiple executables found:\n- ")


def test_pkg_verbs(merged):
    def ros2(*words):
        return subprocess.run([*ROS2, "pkg", *words], capture_output=True, text=True, check=False)

    assert "beta" in ros2("list").stdout.split()
    assert ros2("prefix", "beta").stdout == f"{merged}\n"
    assert ros2("prefix", "--share", "beta").stdout == f"{merged}/share/beta\n"
    assert ros2("executables", "beta").stdout == "beta talker\n"
    assert ros2("executables", "--full-path", "beta").stdout == f"{merged}/lib/beta/talker\n"
    missing = ros2("prefix", "gamma")
    assert (missing.returncode, missing.stderr) == (1, "Package not found\n")
