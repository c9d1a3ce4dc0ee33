# SPDX-License-Identifier: Apache-2.0
"""What all tests share: a DDS domain of their own, and where things stand in the tree."""

from __future__ import annotations

import os
import shutil
import signal
import sys
from pathlib import Path

import pytest
from hypothesis import settings

# How long an example takes is the machine's business; benchmarks measure time, tests do not. A run repeats the last
# one example by example; HYPOTHESIS_PROFILE=explore looks for new ones.
settings.register_profile("project", deadline=None, derandomize=True)
settings.register_profile("explore", deadline=None)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "project"))

# Every process of a parallel run takes a domain of its own, whatever it inherits; those from 60 on are the command's,
# and 102 and above collide with ephemeral ports.
os.environ["ROS_DOMAIN_ID"] = str(1 + os.getpid() % 50)

if shutil.which("ros2") is None:
    # Without a sourced ROS 2 the command stands beside the interpreter of the environment.
    os.environ["PATH"] = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])

# A run started in the background ignores SIGINT, and would hand that on to every process it interrupts.
signal.signal(signal.SIGINT, signal.default_int_handler)

ROOT = Path(__file__).resolve().parents[1]


@pytest.fixture(scope="session")
def repository() -> Path:
    """Root of the repository."""
    return ROOT


@pytest.fixture(scope="session")
def realdata() -> Path:
    """Folder of the real recordings beside the repository; skips where it is absent."""
    folder = ROOT.parent / "shared" / "realdata"
    if not folder.is_dir():
        pytest.skip("the real recordings (../shared/realdata) are not on this machine")
    return folder
