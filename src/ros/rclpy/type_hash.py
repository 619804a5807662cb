# SPDX-License-Identifier: Apache-2.0
"""Hashes of message types, which endpoints of ROS 2 Iron and later announce."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial

from rclpy import _absent

__all__ = ["TypeHash"]

_LENGTH = 32


@dataclass(frozen=True, repr=False)
class TypeHash:
    """Hash of a type. `str` returns its form in files and on the wire, for example `RIHS01_df66...`.

    Attributes:
        version: Version of the hash, -1 if the hash is unknown.
        value: The 32 bytes of the hash.
    """

    version: int = -1
    value: bytes = bytes(_LENGTH)

    @classmethod
    def from_text(cls, text: str | None) -> TypeHash:
        """Return the hash that a string such as `RIHS01_df66...` describes, or an unknown hash for any other text."""
        prefix, _, digits = (text or "").partition("_")
        if not prefix.startswith("RIHS") or len(digits) != 2 * _LENGTH:
            return cls()
        try:
            return cls(int(prefix.removeprefix("RIHS"), 16), bytes.fromhex(digits))
        except ValueError:
            return cls()

    def __repr__(self) -> str:
        return f"TypeHash(version={self.version}, value={self.value.hex()})"

    def __str__(self) -> str:
        return "INVALID" if self.version < 0 else f"RIHS{self.version:02x}_{self.value.hex()}"


__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports
