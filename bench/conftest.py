# SPDX-License-Identifier: Apache-2.0
"""Ratios against a peer measured in the same run, printed as one table after the benchmarks."""

from __future__ import annotations

import pytest

_ROWS: list[tuple[str, float, str]] = []


@pytest.fixture
def ratio():
    """Record how many times faster ours is: ratio(name, peer_seconds / our_seconds, meaning)."""

    def record(name: str, value: float, meaning: str) -> None:
        _ROWS.append((name, value, meaning))

    return record


def pytest_terminal_summary(terminalreporter):
    if not _ROWS:
        return
    terminalreporter.section("ratios")
    width = max(len(name) for name, _, _ in _ROWS)
    for name, value, meaning in _ROWS:
        terminalreporter.write_line(f"{name:<{width}}  {value:10.3g}  {meaning}")
