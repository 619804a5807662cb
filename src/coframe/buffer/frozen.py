# SPDX-License-Identifier: Apache-2.0
"""Buffers in files: small files are copied, large ones are mapped into memory that processes share."""

from __future__ import annotations

import io
import mmap
import os
import sys
import zlib
from pathlib import Path
from typing import TYPE_CHECKING, Any, BinaryIO

from coframe import _core
from coframe.buffer import Buffer
from coframe.buffer._covariances import unpack
from coframe.buffer._frozen_file import BLOCK_SIZE, Header, damaged_file_error, open_file, read_covariances, read_header
from coframe.buffer.dispatcher import Dispatcher

if TYPE_CHECKING:
    from coframe.transform.interpolation import Interpolation

__all__ = ["FrozenBuffer", "load", "restore_buffer"]

MAX_COPIED = 1 << 20  # bytes; copying them takes half a millisecond

_LOSS_TEXT = (
    "{path} was truncated by another program while it was in use. Load it again. To replace a file that is in use, "
    "save the buffer under its name, or use cp --remove-destination."
)


class FrozenBuffer(Buffer):
    """A read-only :class:`coframe.Buffer` backed by a file, returned by :func:`load`.

    Pickling stores only the path, so worker processes open the file themselves and share its memory.
    """

    def __init__(self, path: str | os.PathLike[str], *, content: bytes | None = None) -> None:
        self._path = Path(path)
        if content is not None:
            file = io.BytesIO(content)
            header = read_header(self._path, file, len(content))
            memory = mmap.mmap(-1, len(content))
            memory.write(content)
            self._use(memory, header, read_covariances(self._path, file, header))
            return
        self._path = self._path.absolute()
        with open_file(self._path) as opened_file:
            header = read_header(self._path, opened_file, os.fstat(opened_file.fileno()).st_size)
            covariances = read_covariances(self._path, opened_file, header)
            memory = self._copy(opened_file) or mmap.mmap(opened_file.fileno(), 0, access=mmap.ACCESS_READ)
        self._use(memory, header, covariances)

    def _use(self, memory: mmap.mmap, header: Header, covariances: bytes) -> None:
        """Read the samples from memory, and check its table.

        Raises:
            FrozenFileError: It is damaged.
        """
        self._memory = memory
        self._guard = _core.MemoryGuard(self._memory, _LOSS_TEXT.format(path=self._path))
        if zlib.crc32(memoryview(self._memory)[header.table : header.table + header.table_size]) != header.table_crc:
            self._guard.check()
            raise damaged_file_error(self._path, "the checksum of the table is wrong")
        _core.Buffer.__init__(self, header.cache)
        positions = (header.table, header.table_size, header.samples, header.samples_size)
        if reason := _core.become_frozen(self, self._guard, *positions):
            raise damaged_file_error(self._path, reason)
        self._dispatcher = Dispatcher()
        self._header = header
        try:
            unpack(self, covariances)
        except ValueError as error:
            raise damaged_file_error(self._path, str(error)) from None

    def _copy(self, file: BinaryIO) -> mmap.mmap | None:
        """Return a copy of a small file, which other programs cannot change, or None for one that can be mapped.

        On Windows, a mapped file cannot be replaced by :meth:`coframe.Buffer.save`.
        """
        size = os.fstat(file.fileno()).st_size
        if size > MAX_COPIED and sys.platform != "win32":
            return None
        memory = mmap.mmap(-1, size)
        file.seek(0)
        if memory.write(file.read(size)) != size:
            raise damaged_file_error(self._path, "the file was truncated while it was read")
        return memory

    @property
    def path(self) -> Path:
        """Absolute path of the file."""
        return self._path

    def verify(self) -> None:
        """Read the whole file and compare its samples with their checksum.

        Raises:
            FrozenFileError: The checksum is wrong, or the file was truncated since it was opened.
        """
        start, end = self._header.samples, self._header.samples + self._header.samples_size
        crc = 0
        with memoryview(self._memory) as memory:
            for position in range(start, end, BLOCK_SIZE):
                crc = zlib.crc32(memory[position : min(position + BLOCK_SIZE, end)], crc)
        if crc != self._header.samples_crc:
            self._guard.check()
            raise damaged_file_error(self._path, "the checksum of the samples is wrong")

    def __reduce__(self) -> tuple[Any, ...]:
        return load, (str(self._path),)

    def __repr__(self) -> str:
        return f"FrozenBuffer({str(self._path)!r}, frames={len(self.frame_names())})"


def restore_buffer(content: bytes, interpolation: Interpolation) -> Buffer:
    """Return the buffer that was pickled in another process, or at another time; it is frozen.

    Args:
        content: What its file would contain.
        interpolation: How it computes poses between two samples.
    """
    return FrozenBuffer("a pickled buffer", content=content).snapshot(interpolation=interpolation)


def load(path: str | os.PathLike[str], *, verify: bool = False) -> FrozenBuffer:
    """Open a file that :meth:`coframe.Buffer.save` wrote, as a read-only buffer; samples are read on first use.

    Args:
        path: The file. Files up to 1 MiB, and on Windows all files, are copied; larger ones are mapped, and must not
            change while they are open. :meth:`coframe.Buffer.save` never modifies a file, but replaces it with a new
            one. To replace it with a copy of another file, use ``cp --remove-destination`` or rename the copy.
        verify: Whether to read the whole file first and compare it with its checksums. By default only the header and
            the table are checked.

    Returns:
        The buffer.

    Raises:
        FrozenFileError: The file is not a frozen buffer, has another version, or is truncated or damaged. If a mapped
            file is truncated later, lookups in the buffer raise this error.

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
