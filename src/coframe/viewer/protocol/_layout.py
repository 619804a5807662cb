# SPDX-License-Identifier: Apache-2.0
"""The binary layout of headers and records, derived from the classes in `messages`."""

from __future__ import annotations

import re
import struct
from typing import TYPE_CHECKING, Any, Generic, NamedTuple, TypeVar, get_args, get_type_hints

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["BinaryField", "Layout", "binary_fields"]

R = TypeVar("R", bound=tuple[Any, ...])


class BinaryField(NamedTuple):
    """A field of a binary record: its letter in the struct module, and how many values it has, or None for a scalar."""

    name: str
    letter: str
    length: int | None


class Layout(Generic[R]):
    """The little-endian layout of a binary record.

    Args:
        record: A NamedTuple in `messages`.
    """

    def __init__(self, record: type[R]) -> None:
        self._record = record
        self._fields = tuple(binary_fields(record))
        self._struct = struct.Struct("<" + "".join(f"{field.length or ''}{field.letter}" for field in self._fields))
        self.size = self._struct.size
        self.pack = self._struct.pack
        """Pack all numbers of a record, with those of arrays one after another."""

    def unpack(self, data: bytes | bytearray | memoryview, offset: int = 0) -> R:
        """Return the record at an offset in bytes."""
        numbers = iter(self._struct.unpack_from(data, offset))
        values = [
            next(numbers) if field.length is None else tuple(next(numbers) for _ in range(field.length))
            for field in self._fields
        ]
        return self._record(*values)


def binary_fields(record: type[Any]) -> Iterator[BinaryField]:
    """Yield the fields of a binary record, in order."""
    for name, hint in get_type_hints(record, include_extras=True).items():
        count, letter = re.fullmatch(r"(\d*)(\w)", get_args(hint)[1]).groups()  # type: ignore[union-attr]
        yield BinaryField(name, letter, int(count) if count else None)
