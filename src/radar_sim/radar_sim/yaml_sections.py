# SPDX-License-Identifier: Apache-2.0
"""Sections of a scenario's file: what YAML holds becomes parameter sets, with the place in every message."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, TypeVar

from radar_common.parameters import ParameterError, Parameters

SectionT = TypeVar("SectionT", bound=Parameters)


def read_entries(content: Mapping[str, Any], key: str, prefix: str = "") -> list[tuple[str, Any]]:
    """Take the entries of a list.

    Args:
        content: keys and values.
        key: of the list, which may be absent.
        prefix: where `content` stands.

    Returns:
        Where each entry stands, and the entry.

    Raises:
        ParameterError: it is no list.
    """
    entries = content.get(key) or []
    if not isinstance(entries, list):
        raise ParameterError(f"{prefix}{key}: must be a list")
    return [(f"{prefix}{key}[{number}]", entry) for number, entry in enumerate(entries)]


def read_section(cls: type[SectionT], entry: Any, where: str) -> SectionT:
    """Make a parameter set of keys and values.

    Args:
        cls: the set.
        entry: keys and values, None for the defaults.
        where: it stands.

    Returns:
        The set, every value checked.

    Raises:
        ParameterError: a key is unknown or a value impossible.
    """
    values = read_keys(entry, where)
    try:
        return cls().changed({str(key): value for key, value in values.items()})
    except ParameterError as error:
        raise ParameterError(f"{where}: {error}") from error


def read_keys(entry: Any, where: str) -> dict[Any, Any]:
    """Take keys and values.

    Args:
        entry: what stands there, None for nothing.
        where: it stands.

    Returns:
        A copy that may be changed.

    Raises:
        ParameterError: it is something else.
    """
    if entry is None:
        return {}
    if not isinstance(entry, dict):
        raise ParameterError(f"{where}: must be keys and values")
    return dict(entry)
