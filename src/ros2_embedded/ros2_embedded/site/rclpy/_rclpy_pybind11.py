# SPDX-License-Identifier: Apache-2.0
"""Exceptions under the name of the C extension, from where programs import them."""

from __future__ import annotations


class RCLError(RuntimeError):
    """An operation of the client library failed."""


class RMWError(RuntimeError):
    """An operation of the middleware failed."""


class RCLInvalidROSArgsError(RCLError):
    """The ROS arguments of a command line cannot be understood."""


class UnknownROSArgsError(RuntimeError):
    """A command line has ROS arguments that do not exist."""


class NodeNameNonExistentError(RCLError):
    """There is no node of that name."""


class UnsupportedEventTypeError(RCLError):
    """The middleware does not have this event."""


class InvalidHandle(RuntimeError):
    """The entity has been destroyed."""
