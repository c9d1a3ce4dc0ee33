# SPDX-License-Identifier: Apache-2.0
"""What the command offers, by name, so that help and errors need no import of the verbs."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field


@dataclass(frozen=True, kw_only=True)
class Command:
    """A command of `ros2`.

    Attributes:
        summary: One line for the help.
        verbs: Summary by verb name; empty for a command that has no verbs.
        not_offered: Verbs of the full `ros2` that this one does not have.
    """

    summary: str
    verbs: Mapping[str, str] = field(default_factory=dict)
    not_offered: frozenset[str] = frozenset()


COMMANDS: Mapping[str, Command] = {
    "bag": Command(
        summary="Record, play and inspect bags",
        verbs={
            "info": "Print information about a bag to the screen.",
            "play": "Play back ROS data from a bag.",
            "record": "Record ROS data to a bag.",
            "reindex": "Reconstruct the metadata file of a bag.",
        },
        not_offered=frozenset({"burst", "convert", "list"}),
    ),
    "node": Command(
        summary="Look at the nodes of the graph",
        verbs={
            "info": "Output information about a node.",
            "list": "Output a list of available nodes.",
        },
    ),
    "param": Command(
        summary="Read and change the parameters of a node",
        verbs={
            "describe": "Show descriptive information about declared parameters.",
            "dump": "Show all of the parameters of a node in a YAML file format.",
            "get": "Get parameter.",
            "list": "Output a list of available parameters.",
            "load": "Load parameter file for a node.",
            "set": "Set parameter.",
        },
        not_offered=frozenset({"delete"}),
    ),
    "pkg": Command(
        summary="Find packages and their executables",
        verbs={
            "executables": "Output a list of package specific executables.",
            "list": "Output a list of available packages.",
            "prefix": "Output the prefix path of a package.",
        },
        not_offered=frozenset({"create", "xml"}),
    ),
    "run": Command(summary="Run a package specific executable"),
    "service": Command(
        summary="Look at and call services",
        verbs={
            "call": "Call a service.",
            "list": "Output a list of available services.",
            "type": "Output a service's type.",
        },
        not_offered=frozenset({"echo", "find", "info"}),
    ),
    "topic": Command(
        summary="Look at topics, listen and publish",
        verbs={
            "bw": "Display bandwidth used by topic.",
            "echo": "Output messages from a topic.",
            "hz": "Print the average publishing rate to screen.",
            "info": "Print information about a topic.",
            "list": "Output a list of available topics.",
            "pub": "Publish a message to a topic.",
            "type": "Print a topic's type.",
        },
        not_offered=frozenset({"delay", "find"}),
    ),
}

NOT_OFFERED_COMMANDS = frozenset(
    {
        "action",
        "component",
        "control",
        "daemon",
        "doctor",
        "interface",
        "launch",
        "lifecycle",
        "multicast",
        "security",
        "test",
        "trace",
        "wtf",
    }
)
