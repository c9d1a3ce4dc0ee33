# SPDX-License-Identifier: Apache-2.0
"""Constants of the client library."""

from __future__ import annotations

#: Nanoseconds of a second.
S_TO_NS = 1_000_000_000
