# SPDX-License-Identifier: Apache-2.0
"""The command line before any verb runs: help, unknown words and what is not offered."""

from __future__ import annotations

import subprocess
import sys

import pytest

from ros2_embedded.cli.catalogue import COMMANDS
from ros2_embedded.cli.main import main

VERBS = [(name, verb) for name, command in COMMANDS.items() for verb in command.verbs]


@pytest.mark.parametrize("words", [[], ["--help"]])
def test_help_lists_every_command(words):
    done = subprocess.run(
        [sys.executable, "-m", "ros2_embedded.cli.main", *words],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0
    assert all(name in done.stdout for name in COMMANDS)


@pytest.mark.parametrize("name", [name for name, command in COMMANDS.items() if command.verbs])
def test_a_command_without_a_verb_prints_its_verbs(name, capsys):
    assert main([name]) == 0
    printed = capsys.readouterr().out
    assert all(verb in printed for verb in COMMANDS[name].verbs)


@pytest.mark.parametrize(("name", "verb"), VERBS)
def test_every_verb_has_its_module_and_help(name, verb, capsys):
    with pytest.raises(SystemExit) as exit_:
        main([name, verb, "--help"])
    assert exit_.value.code == 0
    assert f"usage: ros2 {name} {verb}" in capsys.readouterr().out


@pytest.mark.parametrize(
    "words", [["nonsense"], ["topic", "nonsense"], ["topic", "list", "--nonsense"]]
)
def test_unknown_words_are_a_usage_error(words, capsys):
    with pytest.raises(SystemExit) as exit_:
        main(words)
    assert exit_.value.code == 2
    assert "usage: ros2" in capsys.readouterr().err


@pytest.mark.parametrize(
    "words", [["launch", "radar_sim", "demo.launch.py"], ["bag", "convert", "-i"]]
)
def test_what_ros_has_and_the_runtime_has_not_says_so(words):
    message = main(words)
    assert isinstance(message, str)
    assert "not offered by the embedded runtime" in message


def test_run_does_without_rclpy():
    script = (
        "import sys; from ros2_embedded.cli.main import main; main(['run', 'x', 'y'])\n"
        "assert not {'rclpy', 'numpy', 'rosbags'} & set(sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, check=False)
    assert done.returncode == 0, done.stderr
