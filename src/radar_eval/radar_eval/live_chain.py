# SPDX-License-Identifier: Apache-2.0
"""The chain as a user starts it: one process a node, joined by topics, recorded by `ros2 bag record`."""

from __future__ import annotations

import os
import re
import shutil
import signal
import subprocess
import sys
import threading
from collections.abc import Mapping, Sequence
from contextlib import ExitStack
from pathlib import Path
from types import TracebackType
from typing import Self

from radar_eval.errors import EvaluationError

STOP_TIMEOUT = 15.0
START_TIMEOUT = 60.0
RUN_TIMEOUT = 600.0
SECTORS = 32


class ChainError(EvaluationError):
    """A process of the chain did not start or failed."""


class RosProcess:
    """A `ros2` command in the background whose output is kept in a log, as a context manager."""

    def __init__(self, arguments: Sequence[str], log: Path) -> None:
        """Remember what to start.

        Args:
            arguments: command line after `ros2`.
            log: file that takes the output.

        Raises:
            ChainError: there is no `ros2` command.
        """
        self._command = [_ros2(), *arguments]
        self._log = log
        self._lines: list[str] = []
        self._ended = False
        self._changed = threading.Condition()

    def __enter__(self) -> Self:
        """Start the process in a group of its own, so that an interrupt reaches it only from here."""
        self._process = subprocess.Popen(
            self._command,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            start_new_session=True,
        )
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Ask the process and its children to end, and kill what does not."""
        if self._process.poll() is None:
            # Not SIGINT, which a job started in the background inherits as ignored.
            os.killpg(self._process.pid, signal.SIGTERM)
        try:
            self._process.wait(STOP_TIMEOUT)
        except subprocess.TimeoutExpired:
            os.killpg(self._process.pid, signal.SIGKILL)
            self._process.wait()
        self._reader.join(STOP_TIMEOUT)

    def wait_for(self, pattern: str, timeout: float = START_TIMEOUT) -> None:
        """Wait until a line of the output matches.

        Args:
            pattern: regular expression.
            timeout: seconds.

        Raises:
            ChainError: the process ended or the time passed before.
        """

        def seen() -> bool:
            return any(re.search(pattern, line) for line in self._lines)

        with self._changed:
            self._changed.wait_for(lambda: seen() or self._ended, timeout)
            if not seen():
                raise ChainError(f"{' '.join(self._command)}: no {pattern!r}; see {self._log}")

    def wait(self, timeout: float) -> None:
        """Wait for the process to end by itself.

        Args:
            timeout: seconds.

        Raises:
            ChainError: it failed or took longer.
        """
        try:
            code = self._process.wait(timeout)
        except subprocess.TimeoutExpired as error:
            raise ChainError(
                f"{' '.join(self._command)}: still running; see {self._log}"
            ) from error
        if code:
            raise ChainError(f"{' '.join(self._command)}: exit code {code}; see {self._log}")

    def _read(self) -> None:
        assert self._process.stdout is not None
        with self._log.open("w", encoding="utf-8") as log:
            for line in self._process.stdout:
                log.write(line)
                log.flush()
                with self._changed:
                    self._lines.append(line)
                    self._changed.notify_all()
        with self._changed:
            self._ended = True
            self._changed.notify_all()


def record_live_chain(
    bag: Path,
    logs: Path,
    *,
    scenario: str,
    scans: int,
    rate: float,
    seed: int,
    extractor: Mapping[str, object] | None = None,
) -> None:
    """Run simulator, extractor and tracker as three processes and record what they say.

    Args:
        bag: folder of the new bag with plots, tracks and truth.
        logs: folder for the output of each process.
        scenario: name or file of the simulator's scenario.
        scans: antenna turns to run.
        rate: simulated seconds a second.
        seed: of the simulator.
        extractor: parameters of the extractor that differ from its defaults.

    Raises:
        ChainError: a process did not start or failed.
    """
    logs.mkdir(parents=True, exist_ok=True)
    # The simulator outruns real time here: what a busy machine is late for has to wait, not to be lost.
    sweeps = "qos_overrides./radar/sweeps.subscription"
    extraction = {f"{sweeps}.reliability": "reliable", f"{sweeps}.depth": scans * SECTORS}
    topics = ["/radar/plots", "/radar/tracks", "/truth"]
    simulator = {
        "scenario": scenario,
        "scans": scans,
        "rate": rate,
        "seed": seed,
        "sectors": SECTORS,
        "sample": "uint8",
        "wait_for_subscribers": 1,
        "wait_for_truth_subscribers": 1,
    }
    with ExitStack() as stack:
        recorder = stack.enter_context(
            RosProcess(["bag", "record", "-o", str(bag), *topics], logs / "recorder.log")
        )
        for package, node, settings in (
            ("secondary_proc", "tracker", {}),
            ("primary_proc", "plot_extractor", extraction | dict(extractor or {})),
        ):
            stack.enter_context(
                RosProcess(["run", package, node, *_ros_args(settings)], logs / f"{node}.log")
            )
        recorder.wait_for("'/radar/tracks'")
        recorder.wait_for("'/radar/plots'")
        source = stack.enter_context(
            RosProcess(
                ["run", "radar_sim", "radar_simulator", *_ros_args(simulator)],
                logs / "radar_simulator.log",
            )
        )
        source.wait(timeout=RUN_TIMEOUT)


def _ros2() -> str:
    # In an environment that is not activated the command stands beside the interpreter.
    places = os.pathsep.join([os.environ.get("PATH", ""), str(Path(sys.executable).parent)])
    command = shutil.which("ros2", path=places)
    if command is None:
        raise ChainError("there is no ros2 command; source ROS 2 or install ros2_embedded")
    return command


def _ros_args(settings: Mapping[str, object]) -> list[str]:
    if not settings:
        return []
    return ["--ros-args", *(part for k, v in settings.items() for part in ("-p", f"{k}:={v}"))]
