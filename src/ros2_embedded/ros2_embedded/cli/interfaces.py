# SPDX-License-Identifier: Apache-2.0
"""Message and service classes by their name."""

from __future__ import annotations

import importlib
from typing import Any


class UnknownTypeError(RuntimeError):
    """No message or service has that name here."""


def message_class(name: str) -> type[Any]:
    """Return the class of a message.

    Args:
        name: `package/msg/Name`, or `package/Name`.

    Raises:
        UnknownTypeError: There is no such message.
    """
    return _interface_class(name, "msg", f"The message type '{name}' is invalid")


def requested_message_class(name: str) -> type[Any]:
    """Return the class of a message that the user has named.

    Args:
        name: `package/msg/Name`, or `package/Name`.

    Raises:
        UnknownTypeError: There is no such message.
    """
    return _interface_class(name, "msg", "The passed message type is invalid")


def service_class(name: str) -> type[Any]:
    """Return the class of a service.

    Args:
        name: `package/srv/Name`, or `package/Name`.

    Raises:
        UnknownTypeError: There is no such service.
    """
    return _interface_class(name, "srv", "The passed service type is invalid")


def _interface_class(name: str, kind: str, error: str) -> type[Any]:
    package, *middle, last = name.split("/")
    if middle not in ([], [kind]) or not package or not last:
        raise UnknownTypeError(error)
    try:
        found: type[Any] = getattr(importlib.import_module(f"{package}.{kind}"), last)
    except (ImportError, AttributeError, ValueError):
        raise UnknownTypeError(error) from None
    return found
