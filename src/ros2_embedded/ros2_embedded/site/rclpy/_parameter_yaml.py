# SPDX-License-Identifier: Apache-2.0
"""Parameter values and files as the ROS command line reads them.

The scalars follow the rules of rcl, not those of YAML 1.1: ``010`` is octal, ``1e3`` is a
double, and all elements of a sequence must have the type of the first.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import yaml
from rclpy._rclpy_pybind11 import RCLInvalidROSArgsError

#: Parameter values by name.
Values = dict[str, Any]

_TRUE = {"Y", "y", "yes", "Yes", "YES", "true", "True", "TRUE", "on", "On", "ON"}
_FALSE = {"N", "n", "no", "No", "NO", "false", "False", "FALSE", "off", "Off", "OFF"}
_INTEGER = re.compile(r"[+-]?(0[xX][0-9a-fA-F]+|0[0-7]*|[1-9][0-9]*)")
_PARAMETERS_KEY = "ros__parameters"


def parse_value(text: str) -> Any:
    """Read the value of a parameter.

    Args:
        text: A YAML scalar or sequence of scalars.

    Returns:
        bool, int, float, str or a list of one of these; None for an empty sequence.

    Raises:
        RCLInvalidROSArgsError: The text is not such a value.
    """
    node = _compose(text, text)
    if node is None:
        raise RCLInvalidROSArgsError("a parameter has no value")
    return _value(node, text)


def parse_file(path: str) -> dict[str, Values]:
    """Read a parameter file.

    Args:
        path: The YAML file.

    Returns:
        Values by node name or pattern, in the order of the file.

    Raises:
        RCLInvalidROSArgsError: The file cannot be read or is not a parameter file.
    """
    try:
        text = Path(path).read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise RCLInvalidROSArgsError(f"cannot read parameter file {path!r}: {error}") from error
    nodes: dict[str, Values] = {}
    root = _compose(text, path)
    if root is not None:
        _collect(root, "", path, nodes)
    return nodes


def _compose(text: str, where: str) -> yaml.Node | None:
    try:
        if any(isinstance(event, yaml.AliasEvent) for event in yaml.parse(text)):
            raise RCLInvalidROSArgsError(f"{where}: aliases are not supported")
        return yaml.compose(text, Loader=yaml.SafeLoader)
    except yaml.YAMLError as error:
        raise RCLInvalidROSArgsError(f"{where}: {error}") from error


def _collect(node: yaml.Node, name: str, where: str, nodes: dict[str, Values]) -> None:
    if not isinstance(node, yaml.MappingNode):
        raise RCLInvalidROSArgsError(
            f"{where}: '{name}' has a value outside of '{_PARAMETERS_KEY}'"
        )
    for key, value in node.value:
        if key.value == _PARAMETERS_KEY:
            if not name or not isinstance(value, yaml.MappingNode):
                raise RCLInvalidROSArgsError(f"{where}: '{_PARAMETERS_KEY}' is misplaced")
            _flatten(value, "", where, nodes.setdefault(name, {}))
        else:
            _collect(value, f"{name}/{key.value}" if name else key.value, where, nodes)


def _flatten(node: yaml.MappingNode, prefix: str, where: str, values: Values) -> None:
    for key, value in node.value:
        name = prefix + key.value
        if isinstance(value, yaml.MappingNode):
            _flatten(value, f"{name}.", where, values)
        else:
            values[name] = _value(value, where)


def _value(node: yaml.Node, where: str) -> Any:
    if isinstance(node, yaml.ScalarNode):
        return _scalar(node, where)
    if not isinstance(node, yaml.SequenceNode):
        raise RCLInvalidROSArgsError(f"{where}: a mapping is not a parameter value")
    if not all(isinstance(item, yaml.ScalarNode) for item in node.value):
        raise RCLInvalidROSArgsError(f"{where}: sequences must be of scalars")
    values = [_scalar(item, where) for item in node.value]
    if len({type(value) for value in values}) > 1:
        raise RCLInvalidROSArgsError(f"{where}: the elements of a sequence differ in type")
    return values or None


def _scalar(node: yaml.ScalarNode, where: str) -> bool | int | float | str:
    text: str = node.value
    if node.style in ("'", '"'):
        return text
    if not text:
        raise RCLInvalidROSArgsError(f"{where}: no value at line {node.start_mark.line + 1}")
    if text in _TRUE or text in _FALSE:
        return text in _TRUE
    if _INTEGER.fullmatch(text):
        digits = text.lstrip("+-")
        base = 16 if digits[:2] in ("0x", "0X") else 8 if digits[0] == "0" else 10
        number = int(text, base)
        if -(2**63) <= number < 2**63:
            return number
    special = re.fullmatch(r"([+-]?)\.(nan|NaN|NAN|inf|Inf|INF)", text)
    # Python, unlike C, would read underscores between digits.
    if special or "_" not in text:
        try:
            return float(special[1] + special[2] if special else text)
        except ValueError:
            pass
    return text
