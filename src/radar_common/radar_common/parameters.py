# SPDX-License-Identifier: Apache-2.0
"""One frozen dataclass per pipeline is the only definition of its parameters.

ROS parameters with ranges, the YAML file, the offline runner and the table in the docs are all read off it:

    @dataclass(frozen=True, kw_only=True)
    class GateParameters(Parameters):
        gate_sigmas: float = parameter(3.0, "half size of a gate", unit="sigma", low=1.0, high=10.0)
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Self, cast, get_type_hints

import yaml


class ParameterError(ValueError):
    """A parameter has a value that it cannot have; the text says which, and why."""


@dataclass(frozen=True, slots=True)
class Description:
    """What a user may know about one parameter."""

    name: str
    kind: type
    default: bool | float | str
    text: str
    unit: str
    low: float | None
    high: float | None
    choices: tuple[str, ...]
    read_only: bool


def parameter(
    default: bool | float | str,
    text: str,
    *,
    unit: str = "",
    low: float | None = None,
    high: float | None = None,
    choices: tuple[str, ...] = (),
    read_only: bool = False,
) -> Any:
    """Declare a field of a `Parameters` class.

    Args:
        default: value if the user says nothing.
        text: what it is and why one would change it.
        unit: as printed, empty for a number without one.
        low: smallest value allowed, None for no limit.
        high: largest value allowed, None for no limit.
        choices: names allowed, for a string.
        read_only: whether it is fixed once the node runs.

    Returns:
        A dataclass field.
    """
    metadata = {
        "text": text,
        "unit": unit,
        "low": low,
        "high": high,
        "choices": choices,
        "read_only": read_only,
    }
    return dataclasses.field(default=default, metadata=metadata)


@dataclass(frozen=True, kw_only=True)
class Parameters:
    """Base of all parameter sets: checks every value against its declaration."""

    def __post_init__(self) -> None:
        """Check types, ranges, choices, then what must hold between the values."""
        for description in describe(type(self)):
            _check(description, getattr(self, description.name))
        self.check()

    def check(self) -> None:
        """Check what must hold between several values; raise ParameterError with the reason."""

    def changed(self, values: Mapping[str, Any]) -> Self:
        """Copy with some values changed, all checked again.

        Args:
            values: name and new value.

        Returns:
            The new set.

        Raises:
            ParameterError: a name is unknown or a value impossible.
        """
        known = {field.name for field in dataclasses.fields(self)}
        unknown = sorted(set(values) - known)
        if unknown:
            raise ParameterError(f"unknown parameter {', '.join(unknown)}")
        return dataclasses.replace(self, **values)


def describe(cls: type[Parameters]) -> list[Description]:
    """List the parameters of a set in order of declaration.

    Args:
        cls: the set.

    Returns:
        One description a field.
    """
    kinds = get_type_hints(cls)
    return [
        Description(
            name=field.name,
            kind=kinds[field.name],
            # `parameter` always gives a default, which a field in general need not have.
            default=cast(bool | float | str, field.default),
            **field.metadata,
        )
        for field in dataclasses.fields(cls)
    ]


def from_file(cls: type[Parameters], path: str | Path, node: str) -> Any:
    """Read a set from a ROS 2 parameter file.

    Args:
        cls: the set.
        path: YAML file with `node: ros__parameters: …` sections; `/**` applies to every node.
        node: name whose section is taken.

    Returns:
        An instance of `cls`.

    Raises:
        ParameterError: the file is not of that form, or a value is impossible.
    """
    try:
        content = yaml.safe_load(Path(path).read_text(encoding="utf-8")) or {}
    except (OSError, yaml.YAMLError) as error:
        raise ParameterError(f"parameter file {path}: {error}") from error
    if not isinstance(content, dict):
        raise ParameterError(f"parameter file {path}: no sections by node name")
    values: dict[str, Any] = {}
    for section in ("/**", f"/**/{node}", node, f"/{node}"):
        try:
            values |= (content.get(section) or {}).get("ros__parameters") or {}
        except (AttributeError, TypeError) as error:
            raise ParameterError(
                f"parameter file {path}: section {section} has no ros__parameters"
            ) from error
    values.pop("use_sim_time", None)
    return cls().changed({k: v for k, v in values.items() if not k.startswith("qos_overrides")})


def to_yaml(cls: type[Parameters], node: str) -> str:
    """Write the defaults as a ROS 2 parameter file, each with its description, for the node in any namespace.

    Args:
        cls: the set.
        node: name of the section.

    Returns:
        Text of the file.
    """
    lines = [f"/**/{node}:", "  ros__parameters:"]
    for item in describe(cls):
        lines.append(f"    # {item.text}{_limits(item)}")
        lines.append(f"    {item.name}: {_scalar(item.default)}")
    return "\n".join(lines) + "\n"


def to_markdown(cls: type[Parameters]) -> str:
    """Write the set as a table for the docs.

    Args:
        cls: the set.

    Returns:
        Markdown, one row a parameter.
    """
    rows = ["| parameter | default | unit | allowed | meaning |", "| --- | --- | --- | --- | --- |"]
    for item in describe(cls):
        fixed = " (fixed at start)" if item.read_only else ""
        rows.append(
            f"| `{item.name}` | `{_scalar(item.default)}` | {item.unit} "
            f"| {_range(item)} | {item.text}{fixed} |"
        )
    return "\n".join(rows) + "\n"


def _check(item: Description, value: Any) -> None:
    if item.kind is float and isinstance(value, int | float) and not isinstance(value, bool):
        value = float(value)
    if type(value) is not item.kind:
        raise ParameterError(f"{item.name} must be {item.kind.__name__}, got {value!r}")
    if item.choices and value not in item.choices:
        raise ParameterError(f"{item.name} must be one of {', '.join(item.choices)}, got {value!r}")
    if isinstance(value, float) and not math.isfinite(value):
        raise ParameterError(f"{item.name} must be finite, got {value}")
    if isinstance(value, int | float) and not _within(value, item.low, item.high):
        raise ParameterError(f"{item.name} must be in {_range(item)}, got {value}")


def _within(value: float, low: float | None, high: float | None) -> bool:
    return (low is None or value >= low) and (high is None or value <= high)


def _range(item: Description) -> str:
    if item.choices:
        return ", ".join(item.choices)
    if item.low is None and item.high is None:
        return ""
    low = "-inf" if item.low is None else f"{item.low:.10g}"
    high = "inf" if item.high is None else f"{item.high:.10g}"
    return f"[{low}, {high}]"


def _limits(item: Description) -> str:
    parts = [part for part in (item.unit, _range(item)) if part]
    return f" ({'; '.join(parts)})" if parts else ""


def _scalar(value: bool | float | str) -> str:
    return (
        str(yaml.safe_dump(value, default_flow_style=True)).removesuffix("\n").removesuffix("\n...")
    )
