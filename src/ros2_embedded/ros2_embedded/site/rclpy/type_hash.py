# SPDX-License-Identifier: Apache-2.0
"""Hashes of message definitions."""

from __future__ import annotations


class TypeHash:
    """Tells two versions of a message definition apart (REP-2011)."""

    _SIZE = 32
    __slots__ = ["_value", "_version"]
    __hash__ = None  # type: ignore[assignment]

    def __init__(self, version: int = -1, value: bytes = bytes(_SIZE)) -> None:
        """Create a hash.

        Args:
            version: Version of the way to hash.
            value: 32 bytes.
        """
        self._version = version
        self._value = value

    @classmethod
    def from_text(cls, text: str) -> TypeHash:
        """Read a hash.

        Args:
            text: Such as ``RIHS01_...``.

        Returns:
            The hash; an invalid one if the text is none.
        """
        prefix, _, digits = text.partition("_")
        try:
            return cls(int(prefix.removeprefix("RIHS")), bytes.fromhex(digits))
        except ValueError:
            return cls()

    @property
    def version(self) -> int:
        """Version of the way to hash."""
        return self._version

    @property
    def value(self) -> bytes:
        """The 32 bytes."""
        return self._value

    def __eq__(self, other: object) -> bool:
        """Compare the values."""
        if not isinstance(other, TypeHash):
            return False
        return (self.version, self.value) == (other.version, other.value)

    def __str__(self) -> str:
        """Show it as text."""
        if self._version <= 0 or len(self._value) != self._SIZE:
            return "INVALID"
        return f"RIHS{self._version:02}_{self._value.hex()}"
