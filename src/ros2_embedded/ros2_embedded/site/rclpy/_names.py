# SPDX-License-Identifier: Apache-2.0
"""Rules for names of nodes, namespaces, topics and services."""

from __future__ import annotations

import re
from collections.abc import Callable

MAX_NODE_NAME = 255

#: A reason and the index of the first offending character.
Problem = tuple[str, int]

_SUBSTITUTION = re.compile(r"\{([^{}]*)\}")


def node_name_problem(name: str) -> Problem | None:
    """Find what is wrong with the name of a node.

    Args:
        name: Name without namespace.

    Returns:
        The problem, or None.
    """
    if not name:
        return "node name must not be empty", 0
    if bad := re.search(r"[^A-Za-z0-9_]", name):
        return "node name must not contain characters other than alphanumerics or '_'", bad.start()
    if name[0].isdigit():
        return "node name must not start with a number", 0
    if len(name) > MAX_NODE_NAME:
        return "node name length must not exceed 255", MAX_NODE_NAME
    return None


def full_name_problem(name: str, kind: str) -> Problem | None:
    """Find what is wrong with an absolute name.

    Args:
        name: Name of a topic, service or namespace.
        kind: What to call it.

    Returns:
        The problem, or None.
    """
    if not name:
        return f"{kind} must not be empty", 0
    if name[0] != "/":
        return f"{kind} must be absolute, it must lead with a '/'", 0
    if len(name) > 1 and name.endswith("/"):
        return f"{kind} must not end with '/'", len(name) - 1
    if bad := re.search(r"[^A-Za-z0-9_/]", name):
        return (
            f"{kind} must not contain characters other than alphanumerics, '_', or '/'",
            bad.start(),
        )
    if bad := re.search("//", name):
        return f"{kind} must not contain repeated '/'", bad.start() + 1
    if bad := re.search(r"/\d", name):
        return f"{kind} must not have a token that starts with a number", bad.start() + 1
    return None


def topic_name_problem(name: str) -> Problem | None:
    """Find what is wrong with a topic or service name that may be relative.

    Args:
        name: Name with ``~`` and substitutions in braces.

    Returns:
        The problem, or None.
    """
    if not name:
        return "topic name must not be empty string", 0
    if name[0].isdigit():
        return "topic name tokens must not start with a number", 0
    if name.endswith("/"):
        return "topic name must not end with a forward slash", len(name) - 1
    if bad := re.search(r"[^A-Za-z0-9_/~{}]", name):
        return (
            "topic name must not contain characters other than alphanumerics, '_', '~', '{', "
            "or '}'",
            bad.start(),
        )
    if (tilde := name.find("~", 1)) > 0 or (name[0] == "~" and name[1:2] not in ("", "/")):
        return "topic name has '~' that is not the first token", max(tilde, 0)
    for found in _SUBSTITUTION.finditer(name):
        if not re.fullmatch(r"[A-Za-z_][A-Za-z0-9_]*", found.group(1)):
            return "substitution name has characters that are not allowed", found.start()
    rest = _SUBSTITUTION.sub(lambda found: "_" * len(found.group()), name)
    if bad := re.search(r"[{}]", rest):
        return "topic name contains unbalanced curly braces", bad.start()
    if bad := re.search(r"/\d", rest):
        return "topic name tokens must not start with a number", bad.start() + 1
    if bad := re.search("//", rest):
        return "topic name must not contain repeated '/'", bad.start() + 1
    return None


def expand_name(name: str, node_name: str, namespace: str) -> str:
    """Make a topic or service name absolute.

    Args:
        name: Absolute, relative or private (``~/...``) name.
        node_name: Node that uses it.
        namespace: Namespace of the node.

    Returns:
        The absolute name.

    Raises:
        ValueError: A name is not allowed or a substitution is unknown.
    """
    for problem in (
        topic_name_problem(name),
        node_name_problem(node_name),
        full_name_problem(namespace, "namespace"),
    ):
        if problem is not None:
            raise ValueError(f"cannot expand {name!r}: {problem[0]}")
    known = {"node": node_name, "ns": namespace, "namespace": namespace}

    def substitute(found: re.Match[str]) -> str:
        if found.group(1) not in known:
            raise ValueError(f"unknown substitution {found.group()} in {name!r}")
        return known[found.group(1)]

    prefix = "" if namespace == "/" else namespace
    if name.startswith("~"):
        name = f"{prefix}/{node_name}{name[1:]}"
    name = _SUBSTITUTION.sub(substitute, name)
    return name if name.startswith("/") else f"{prefix}/{name}"


def raise_problem(
    problem: Problem | None, name: str, exception: Callable[[str, str, int], Exception]
) -> None:
    """Raise if there is a problem.

    Args:
        problem: The problem, or None.
        name: The name in question.
        exception: Makes the exception of name, reason and index.

    Raises:
        Exception: The exception made.
    """
    if problem is not None:
        raise exception(name, *problem)
