# SPDX-License-Identifier: Apache-2.0
"""The errors that a user can cause, under one name for the commands to catch."""

from __future__ import annotations


class EvaluationError(RuntimeError):
    """Something a user asked for cannot be done; the text says what and why in one line."""


class RecordingError(EvaluationError):
    """A recording cannot be read or holds nothing to import."""


class RotationError(EvaluationError):
    """Times and azimuths do not tell how the antenna turned."""


class ScoreError(EvaluationError):
    """A bag does not hold what a score needs."""
