# SPDX-License-Identifier: Apache-2.0
"""Buffers in files that are mapped into memory, and that any number of processes share."""

from __future__ import annotations

import mmap
import zlib
from pathlib import Path
from typing import TYPE_CHECKING, Any

from coframe import _core
from coframe.buffer import Buffer
from coframe.dispatcher import Dispatcher
from coframe.frozen_file import BLOCK_SIZE, damaged, opened, read_header

if TYPE_CHECKING:
    import os

__all__ = ["FrozenBuffer", "load"]


class FrozenBuffer(Buffer):
    """A read-only :class:`coframe.Buffer` on a file that is mapped into memory, as :func:`load` returns it.

    Pickling stores only the path, so worker processes open the file themselves and share its memory.
    """

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self._path = Path(path).absolute()
        with opened(self._path) as file:
            header = read_header(self._path, file)
            self._memory = mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ)
        if zlib.crc32(memoryview(self._memory)[header.table : header.table + header.table_size]) != header.table_crc:
            raise damaged(self._path, "the checksum of its table is wrong")
        _core.Buffer.__init__(self, header.cache)
        positions = (header.table, header.table_size, header.samples, header.samples_size)
        if reason := _core.become_frozen(self, self._memory, *positions):
            raise damaged(self._path, reason)
        self._dispatcher = Dispatcher()
        self._header = header

    @property
    def path(self) -> Path:
        """Absolute path of the file."""
        return self._path

    def verify(self) -> None:
        """Read the whole file and compare its samples with their checksum.

        Raises:
            FrozenFileError: The checksum is wrong.
        """
        start, end = self._header.samples, self._header.samples + self._header.samples_size
        crc = 0
        with memoryview(self._memory) as memory:
            for position in range(start, end, BLOCK_SIZE):
                crc = zlib.crc32(memory[position : min(position + BLOCK_SIZE, end)], crc)
        if crc != self._header.samples_crc:
            raise damaged(self._path, "the checksum of its samples is wrong")

    def __reduce__(self) -> tuple[Any, ...]:
        return load, (str(self._path),)

    def __repr__(self) -> str:
        return f"FrozenBuffer({str(self._path)!r}, frames={len(self.frame_names())})"


def load(path: str | os.PathLike[str], *, verify: bool = False) -> FrozenBuffer:
    """Open a file that :meth:`coframe.Buffer.save` wrote, as a read-only buffer; samples are read on first use.

    Args:
        path: The file. It must not change while it is open; :meth:`coframe.Buffer.save` replaces it by a new file.
        verify: Whether to read the whole file first and compare it with its checksums. By default only the header and
            the table are checked.

    Returns:
        The buffer.

    Raises:
        FrozenFileError: The file is not a frozen buffer, has another version, or is truncated or damaged.

    Example:
        >>> import coframe, tempfile, pathlib
        >>> buffer = coframe.Buffer(None)
        >>> _ = buffer.set("map", "base", coframe.Transform([1, 2, 3]), 1_000_000_000)
        >>> path = pathlib.Path(tempfile.mkdtemp()) / "run.cfz"
        >>> buffer.save(path)
        >>> coframe.load(path).lookup("map", "base").translation.tolist()
        [1.0, 2.0, 3.0]
    """
    buffer = FrozenBuffer(path)
    if verify:
        buffer.verify()
    return buffer
