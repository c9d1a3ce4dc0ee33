# SPDX-License-Identifier: Apache-2.0
"""What signals do to a program."""

from __future__ import annotations

import os
import signal
import subprocess
import sys

import pytest

PROGRAM = """
import sys
import rclpy
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node

rclpy.init(args=[])
node = Node("signalled")
{extra}
once = node.create_timer(0.001, lambda: (once.cancel(), print("spinning", flush=True)))
try:
    {spin}
    print("returned")
except KeyboardInterrupt:
    print("interrupted")
except ExternalShutdownException:
    print("shut down")
print("ok" if rclpy.ok() else "not ok")
node.destroy_node()
rclpy.try_shutdown()
"""

SPIN = "rclpy.spin(node)"
MULTI = "executor = MultiThreadedExecutor(2); executor.add_node(node); executor.spin()"


def run(number, domain_id, spin=SPIN, extra=""):
    environment = dict(os.environ, ROS_DOMAIN_ID=str(domain_id))
    program = subprocess.Popen(
        [sys.executable, "-u", "-c", PROGRAM.format(spin=spin, extra=extra)],
        stdout=subprocess.PIPE,
        text=True,
        env=environment,
    )
    try:
        assert program.stdout.readline() == "spinning\n"
        program.send_signal(number)
        output, _ = program.communicate(timeout=30)
    finally:
        program.kill()
    return output.splitlines(), program.returncode


@pytest.mark.parametrize("spin", [SPIN, "node.create_rate(1); " + SPIN])
def test_sigint_interrupts(spin, domain_id):
    output, code = run(signal.SIGINT, domain_id, spin)
    assert output[0] == "interrupted"
    assert code == 0


def test_sigterm_shuts_down(domain_id):
    output, code = run(signal.SIGTERM, domain_id)
    # It returns if the signal comes while it is not waiting.
    assert output[0] in ("returned", "shut down")
    assert output[1] == "not ok"
    assert code == 0


def test_sigterm_ends_several_threads(domain_id):
    output, code = run(signal.SIGTERM, domain_id, MULTI)
    assert output[-1] == "not ok"
    assert output[0] in ("returned", "shut down")
    assert code == 0


def test_sigint_ends_several_threads(domain_id):
    output, code = run(signal.SIGINT, domain_id, MULTI)
    assert output[0] == "interrupted"
    assert code == 0


def test_own_handler_is_called(domain_id):
    extra = (
        "import signal; seen = []; "
        "signal.signal(signal.SIGUSR1, lambda *_: seen.append(print('mine')))"
    )
    spin = "exec('while not seen: rclpy.spin_once(node, timeout_sec=0.05)')"
    output, code = run(signal.SIGUSR1, domain_id, spin, extra)
    assert output == ["mine", "returned", "ok"]
    assert code == 0


def test_without_handlers_sigterm_kills(domain_id):
    extra = "from rclpy.signals import uninstall_signal_handlers; uninstall_signal_handlers()"
    output, code = run(signal.SIGTERM, domain_id, extra=extra)
    assert output == []
    assert code == -signal.SIGTERM
