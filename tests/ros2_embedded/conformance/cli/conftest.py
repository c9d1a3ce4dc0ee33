# SPDX-License-Identifier: Apache-2.0
"""Runs `ros2` as a user does: as a process whose output is waited for, never slept for."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest

DEADLINE = 30.0


def environment():
    """The environment, with a domain that parallel sessions and workers hardly share."""
    return {**os.environ, "ROS_DOMAIN_ID": str(60 + os.getpid() % 20)}


class RunningProcess:
    """A process in the background, its output collected line by line."""

    def __init__(self, words):
        self._process = subprocess.Popen(
            words,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            env=environment(),
        )
        self._output = ""
        self._ended = False
        self._changed = threading.Condition()
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def _read(self):
        for line in self._process.stdout:
            with self._changed:
                self._output += line
                self._changed.notify_all()
        with self._changed:
            self._ended = True
            self._changed.notify_all()

    def wait_for(self, pattern):
        """Wait until the output matches; the end of the process, or of patience, is a failure."""
        deadline = time.monotonic() + DEADLINE
        with self._changed:
            while (match := re.search(pattern, self._output, re.MULTILINE)) is None:
                remaining = deadline - time.monotonic()
                assert not self._ended, f"ended without {pattern!r}:\n{self._output}"
                assert remaining > 0, f"no {pattern!r} in time:\n{self._output}"
                self._changed.wait(remaining)
        return match

    def send(self, number):
        """Send a signal."""
        self._process.send_signal(number)

    def finish(self, number=None):
        """Wait for the end, after a signal if one is given; return exit code and output."""
        if number is not None:
            self.send(number)
        code = self._process.wait(DEADLINE)
        self._reader.join(DEADLINE)
        return code, self._output

    def kill(self):
        """End it if it still runs."""
        if self._process.poll() is None:
            self._process.kill()
        self._process.wait()
        self._reader.join(DEADLINE)


class Ros2:
    """The `ros2` command, to be run to its end or in the background."""

    def __init__(self):
        beside = str(Path(sys.executable).parent)
        found = shutil.which("ros2", path=os.pathsep.join([os.environ.get("PATH", ""), beside]))
        assert found is not None, "there is no `ros2` command"
        self._executable = found
        self._running = []

    def __call__(self, *words):
        """Run to the end."""
        return subprocess.run(
            [self._executable, *words],
            capture_output=True,
            text=True,
            timeout=DEADLINE,
            check=False,
            env=environment(),
        )

    def until(self, condition, *words):
        """Ask again until the output is as wanted: discovery takes the time it takes."""
        deadline = time.monotonic() + DEADLINE
        while True:
            done = self(*words)
            if condition(done.stdout):
                return done.stdout
            assert time.monotonic() < deadline, f"{words}: {done.stdout}{done.stderr}"

    def start(self, *words):
        """Start in the background."""
        return self._start([self._executable, *words])

    def script(self, source, *arguments):
        """Start a Python program in the background."""
        return self._start([sys.executable, "-u", "-c", source, *arguments])

    def _start(self, words):
        process = RunningProcess(words)
        self._running.append(process)
        return process

    def stop_all(self):
        """End what still runs."""
        for process in self._running:
            process.kill()


@pytest.fixture
def ros2():
    """The `ros2` command; what a test leaves running is ended after it."""
    command = Ros2()
    yield command
    command.stop_all()


@pytest.fixture(scope="module")
def ros2_of_module():
    """The same for fixtures that serve a whole module."""
    command = Ros2()
    yield command
    command.stop_all()


@pytest.fixture
def publisher(ros2):
    """Start a steady publisher of strings and return it once it publishes."""

    def start(topic, *options, data="hello", rate="20"):
        words = ("topic", "pub", topic, "std_msgs/msg/String", f"data: {data}", "-r", rate)
        process = ros2.start(*words, *options)
        process.wait_for("publishing #1")
        return process

    return start
