# SPDX-License-Identifier: Apache-2.0
"""What the README tells a reader to type works, as it stands there."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from radar_sim.scenario import scenario_names

ROOT = Path(__file__).resolve().parents[2]
TEXT = (ROOT / "README.md").read_text(encoding="utf-8")
BLOCKS = re.findall(r"```sh\n(.*?)```", TEXT, flags=re.DOTALL)
MAKE = [block for block in BLOCKS if block.startswith("make ")]
SHELL = [block for block in BLOCKS if block not in MAKE]


@pytest.mark.parametrize("block", SHELL, ids=lambda block: block.split("\n")[0])
def test_commands_run(block, tmp_path):
    (tmp_path / "out").mkdir()
    # Job control lets the block's own `kill %1` reach its background jobs, as in a terminal.
    done = subprocess.run(
        ["bash", "-m", "-e", "-c", block],
        cwd=tmp_path,
        env=dict(os.environ),
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        check=False,
        timeout=240,
    )
    assert done.returncode == 0, done.stdout + done.stderr


def test_the_recording_commands_run(tmp_path, realdata):
    (block,) = re.findall(r"```text\n(ros2 run radar_eval import_asterix.*?)```", TEXT, re.DOTALL)
    script = block.replace("FILE", str(realdata / "bcn_psr_modes_0800_0820.ast"))
    done = subprocess.run(
        ["bash", "-e", "-c", script],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
        timeout=280,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert (tmp_path / "report" / "index.html").is_file()


def test_the_two_commands_are_targets_that_do_their_own_set_up():
    makefile = (ROOT / "Makefile").read_text(encoding="utf-8")
    assert [block.strip() for block in MAKE] == ["make demo", "make test"]
    for target in ("demo", "lint", "types", "unit", "bench"):
        assert re.search(rf"^{target}: setup$", makefile, flags=re.MULTILINE)
    assert re.search(r"^test: lint types unit$", makefile, flags=re.MULTILINE)


def test_continuous_integration_runs_what_the_readme_says():
    assert "make test" in (ROOT / ".ci" / "run").read_text(encoding="utf-8").splitlines()


def test_the_demo_makes_its_page(tmp_path):
    ros2 = shutil.which("ros2")
    environment = dict(os.environ)
    if Path(ros2).parent == Path(sys.executable).parent:
        # As `make demo` starts it: by its path, in an environment that is not activated.
        environment["PATH"] = "/usr/bin:/bin"
    done = subprocess.run(
        [ros2, "run", "radar_eval", "demo", "--out", str(tmp_path), "--scans", "8"],
        env=environment,
        capture_output=True,
        text=True,
        check=False,
        timeout=240,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert (tmp_path / "report" / "index.html").stat().st_size > 100_000


def test_links_lead_somewhere():
    for target in re.findall(r"\]\(([^)#]+)\)", TEXT):
        assert (ROOT / target).exists(), target


def test_every_parameter_named_exists():
    table = (ROOT / "docs" / "parameters.md").read_text(encoding="utf-8")
    section = TEXT.split("those that matter first:")[1].split("## Topics")[0]
    for name in re.findall(r"`([a-z_]+)`", section):
        assert name in scenario_names() or name in table, name
