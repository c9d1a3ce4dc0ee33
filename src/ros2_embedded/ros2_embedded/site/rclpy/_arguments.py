# SPDX-License-Identifier: Apache-2.0
"""The ROS arguments of a command line: parameters, remappings, log levels."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

from rclpy._names import expand_name, full_name_problem, node_name_problem
from rclpy._parameter_yaml import Values, parse_file, parse_value
from rclpy._rclpy_pybind11 import RCLInvalidROSArgsError, UnknownROSArgsError

_BEGIN, _END = "--ros-args", "--"
_SWITCHES = {"rosout", "stdout", "external-lib"}
#: Options that are read but change nothing here.
_WITHOUT_EFFECT = {"--log-config-file", "--log-file-name", "-e", "--enclave"}
_PARAMETER = re.compile(r"(?:([A-Za-z_]\w*):)?([A-Za-z_/][\w/]*(?:\.[A-Za-z_/][\w/]*)*)")
_SEVERITIES = {"debug": 10, "info": 20, "warn": 30, "error": 40, "fatal": 50, "unset": 0}


@dataclass(frozen=True, slots=True)
class Remapping:
    """One remapping rule.

    Attributes:
        node: Name of the node it is for, or empty for all.
        kind: ``topic``, ``service`` or empty for both.
        source: Name to replace, ``__node`` or ``__ns``.
        target: The new name.
    """

    node: str
    kind: str
    source: str
    target: str


@dataclass(slots=True)
class RosArguments:
    """What the ROS arguments ask for.

    Attributes:
        parameters: Values by node name or pattern.
        remappings: Rules in order.
        log_levels: Severities by logger name, empty for the default.
        switches: Which of ``rosout``, ``stdout`` and ``external-lib`` logs were switched on
            or off.
    """

    parameters: dict[str, Values] = field(default_factory=dict)
    remappings: list[Remapping] = field(default_factory=list)
    log_levels: dict[str, int] = field(default_factory=dict)
    switches: dict[str, bool] = field(default_factory=dict)

    def parameters_of(self, full_name: str) -> Values:
        """Select the parameters of a node.

        Args:
            full_name: Namespace and name of the node.

        Returns:
            Its values; of several for the same parameter, that of the later pattern.
        """
        found: Values = {}
        for pattern, values in self.parameters.items():
            rooted = pattern if pattern.startswith("/") else f"/{pattern}"
            if re.fullmatch(rooted.replace("/*", r"(/\w+)"), full_name):
                found |= values
        return found


def remap_node(rules: Iterable[Remapping], name: str, namespace: str) -> tuple[str, str]:
    """Apply ``__node`` and ``__ns`` rules.

    Args:
        rules: The rules, those of the node first.
        name: Name of the node.
        namespace: Its namespace.

    Returns:
        The new name and namespace.
    """
    rules = list(rules)
    for source, kind in (("__node", "name"), ("__ns", "namespace")):
        rule = next((r for r in rules if r.source == source and r.node in ("", name)), None)
        if rule is not None and kind == "name":
            name = rule.target
        elif rule is not None:
            namespace = rule.target
    return name, namespace


def remap_name(
    rules: Iterable[Remapping], full_name: str, node: str, namespace: str, kind: str
) -> str:
    """Apply the remapping rules to an absolute name.

    Args:
        rules: The rules, those of the node first.
        full_name: Name of a topic or service.
        node: Node that uses it.
        namespace: Namespace of the node.
        kind: ``topic`` or ``service``.

    Returns:
        The new name; the first rule that fits decides.
    """
    for rule in rules:
        applies = rule.node in ("", node) and rule.kind in ("", kind) and rule.source[:2] != "__"
        if applies and expand_name(rule.source, node, namespace) == full_name:
            return expand_name(rule.target, node, namespace)
    return full_name


def split_arguments(arguments: Sequence[str]) -> tuple[list[str], list[str]]:
    """Part the ROS arguments from the others.

    Args:
        arguments: The command line.

    Returns:
        The other arguments and the ROS arguments.
    """
    others: list[str] = []
    ros: list[str] = []
    inside = False
    for argument in arguments:
        if argument == _BEGIN:
            inside = True
        elif inside and argument == _END:
            inside = False
        else:
            (ros if inside else others).append(argument)
    return others, ros


def parse_arguments(arguments: Sequence[str]) -> RosArguments:
    """Read the ROS arguments of a command line.

    Args:
        arguments: The command line; all before ``--ros-args`` is not looked at.

    Returns:
        What they ask for.

    Raises:
        RCLInvalidROSArgsError: An argument has a wrong value or none.
        UnknownROSArgsError: There is an argument that is none of ROS.
    """
    parsed = RosArguments()
    unknown = []
    rest = iter(split_arguments(arguments)[1])
    for option in rest:
        if match := re.fullmatch(r"--(enable|disable)-(\S+)-logs", option):
            if match[2] not in _SWITCHES:
                unknown.append(option)
            parsed.switches[match[2]] = match[1] == "enable"
            continue
        if option not in _OPTIONS and option not in _WITHOUT_EFFECT:
            unknown.append(option)
            continue
        value = next(rest, None)
        if value is None:
            raise RCLInvalidROSArgsError(f"Couldn't parse trailing {option} flag. No value found.")
        if option in _OPTIONS:
            _OPTIONS[option](parsed, value)
    if unknown:
        raise UnknownROSArgsError(f"Found unknown ROS arguments: {unknown}")
    return parsed


def _read_parameter(parsed: RosArguments, text: str) -> None:
    target, assigned, value = text.partition(":=")
    match = _PARAMETER.fullmatch(target)
    if not assigned or match is None:
        raise RCLInvalidROSArgsError(f"Couldn't parse parameter override rule: '-p {text}'")
    parsed.parameters.setdefault(match[1] or "/**", {})[match[2]] = parse_value(value)


def _read_parameter_file(parsed: RosArguments, path: str) -> None:
    for node, values in parse_file(path).items():
        parsed.parameters.setdefault(node, {}).update(values)


def _read_remapping(parsed: RosArguments, text: str) -> None:
    left, assigned, target = text.partition(":=")
    match = re.fullmatch(r"(?:(\w+):(?!//))?(?:(rostopic|rosservice)://)?(\S+)", left)
    if not assigned or not target or match is None:
        raise RCLInvalidROSArgsError(f"Couldn't parse remap rule: '-r {text}'")
    node, scheme, source = match.groups(default="")
    source = "__node" if source == "__name" else source
    problem = None
    if source == "__node":
        problem = node_name_problem(target)
    elif source == "__ns":
        problem = full_name_problem(target, "namespace")
    else:
        try:
            expand_name(source, "node", "/")
            expand_name(target, "node", "/")
        except ValueError as error:
            problem = (str(error), 0)
    if problem is not None:
        raise RCLInvalidROSArgsError(f"Couldn't parse remap rule: '-r {text}': {problem[0]}")
    parsed.remappings.append(Remapping(node, scheme.removeprefix("ros"), source, target))


def _read_log_level(parsed: RosArguments, text: str) -> None:
    logger, _, level = text.rpartition(":=")
    if level.lower() not in _SEVERITIES:
        raise RCLInvalidROSArgsError(f"Couldn't parse log level rule: '--log-level {text}'")
    parsed.log_levels[logger] = _SEVERITIES[level.lower()]


_OPTIONS = {
    "-p": _read_parameter,
    "--param": _read_parameter,
    "--params-file": _read_parameter_file,
    "-r": _read_remapping,
    "--remap": _read_remapping,
    "--log-level": _read_log_level,
}
