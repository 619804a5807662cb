"""Buffers as files that are used where they lie, by any number of processes.

A frozen file is little endian throughout:

    header    ``_HEADER``: what it is, where its two parts are and their checksums, padded to a page
    samples   chunks of 256 stamps (int64) and 256 records of 64 bytes (x, y, z, w of the quaternion, x, y, z of the
              translation, the parent's number); each frame begins a chunk of its own
    table     names of authorities and frames; of each frame its kind, its counts, how many samples it has, and from when
              to when

Opening reads the header and the table only and checks both; the samples are mapped into memory, and the system reads
what look-ups touch. A number in there never leads outside the file, whatever it is.
"""

from __future__ import annotations

import contextlib
import mmap
import os
import struct
import uuid
import zlib
from pathlib import Path
from typing import TYPE_CHECKING, Any, BinaryIO, NamedTuple

from coframe import _core
from coframe.buffer import Buffer
from coframe.dispatcher import Dispatcher
from coframe.errors import FrozenFileError

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["FrozenBuffer", "load", "save"]

_MAGIC = b"\x89CFZ\r\n\x1a\n"
_VERSION = 1
_PAGE = 4096
_CHUNK = 256 * (8 + 64)
_BLOCK = 256  # chunks that are written together
_CRC = struct.Struct("<I")


class _Header(NamedTuple):
    """What stands at the file's beginning, before the CRC-32 of these bytes.

    Attributes:
        magic: That it is a frozen file, and that nobody took it for text on its way.
        version: Of the layout.
        table_crc: CRC-32 of the table.
        samples_crc: CRC-32 of the samples.
        reserved: Zero.
        cache: How far back the buffer kept transforms, in nanoseconds; negative: everything.
        samples: Where they begin.
        samples_size: Bytes.
        table: Where it begins.
        table_size: Bytes.
    """

    magic: bytes
    version: int
    table_crc: int
    samples_crc: int
    reserved: int
    cache: int
    samples: int
    samples_size: int
    table: int
    table_size: int


_HEADER = struct.Struct("<8sIIIIqQQQQ")


class FrozenBuffer(Buffer):
    """What :func:`load` gives: a :class:`coframe.Buffer` that only answers, on a file that is mapped into memory.

    Pickled, it is the path alone, so that worker processes open the file themselves and share its memory.
    """

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self._path = Path(path).absolute()
        with _opened(self._path) as file:
            size = os.fstat(file.fileno()).st_size
            header = _read_header(self._path, file.read(_HEADER.size + _CRC.size), size)
            self._memory = mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ)
        if zlib.crc32(memoryview(self._memory)[header.table : header.table + header.table_size]) != header.table_crc:
            raise _damaged(self._path, "the checksum of its table differs")
        _core.Buffer.__init__(self, header.cache)
        places = (header.table, header.table_size, header.samples, header.samples_size)
        if reason := _core.become_frozen(self, self._memory, *places):
            raise _damaged(self._path, reason)
        self.dispatcher = Dispatcher()
        self._header = header

    @property
    def path(self) -> Path:
        """The file."""
        return self._path

    def verify(self) -> None:
        """Reads the whole file and compares its samples with their checksum.

        Raises:
            FrozenFileError: They differ.
        """
        start, end = self._header.samples, self._header.samples + self._header.samples_size
        crc = 0
        with memoryview(self._memory) as memory:
            for at in range(start, end, _BLOCK * _CHUNK):
                crc = zlib.crc32(memory[at : min(at + _BLOCK * _CHUNK, end)], crc)
        if crc != self._header.samples_crc:
            raise _damaged(self._path, "the checksum of its samples differs")

    def __reduce__(self) -> tuple[Any, ...]:
        return load, (str(self._path),)

    def __repr__(self) -> str:
        return f"FrozenBuffer({str(self._path)!r}, frames={len(self.frame_names())})"


def load(path: str | os.PathLike[str], *, verify: bool = False) -> FrozenBuffer:
    """A buffer out of a file that :meth:`coframe.Buffer.save` wrote; nothing is read before it is asked for.

    Args:
        path: The file. Nobody may change it while it is open; :meth:`coframe.Buffer.save` puts a new one in its place.
        verify: Read all of it first and compare it with its checksum; else only its header and table are.

    Raises:
        FrozenFileError: It is no such file, of another version, cut off or damaged.

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


def save(buffer: Buffer, path: str | os.PathLike[str]) -> None:
    """Writes what is in a buffer now; see :meth:`coframe.Buffer.save`."""
    target = Path(path)
    snapshot = buffer.snapshot()
    table, chunks = _core.frozen_parts(snapshot)
    with _replacing(target) as file:
        file.write(bytes(_PAGE))
        crc = 0
        for first in range(0, chunks, _BLOCK):
            block = _core.frozen_chunks(snapshot, first, _BLOCK)
            crc = zlib.crc32(block, crc)
            file.write(block)
        size = chunks * _CHUNK
        file.write(table)
        header = _HEADER.pack(
            _MAGIC, _VERSION, zlib.crc32(table), crc, 0, buffer.cache_ns, _PAGE, size, _PAGE + size, len(table)
        )
        file.seek(0)
        file.write(header + _CRC.pack(zlib.crc32(header)))


@contextlib.contextmanager
def _replacing(target: Path) -> Iterator[BinaryIO]:
    """A new file that takes the target's place once it is whole."""
    temporary = target.with_name(f".{target.name}.{uuid.uuid4().hex}")
    try:
        with temporary.open("xb") as file:
            yield file
            file.flush()
            os.fsync(file.fileno())
        temporary.replace(target)
    except OSError as error:
        raise FrozenFileError(
            f"{target} cannot be written: {error.strerror or error}",
            hint="Does the folder exist, may you write there, and is there room? On Windows nobody may have it open.",
        ) from None
    finally:
        temporary.unlink(missing_ok=True)


@contextlib.contextmanager
def _opened(path: Path) -> Iterator[BinaryIO]:
    try:
        with path.open("rb") as file:
            yield file
    except (OSError, ValueError) as error:
        if isinstance(error, FrozenFileError):
            raise
        reason = getattr(error, "strerror", None) or error
        raise FrozenFileError(f"{path} cannot be opened: {reason}", hint="Buffer.save() writes such files.") from None


def _read_header(path: Path, data: bytes, size: int) -> _Header:
    if not data.startswith(_MAGIC):
        raise FrozenFileError(
            f"{path} is no frozen buffer", hint="Buffer.save() writes them; open_bag() reads recordings."
        )
    if len(data) < _HEADER.size + _CRC.size:
        raise _damaged(path, "it is cut off")
    header = _Header(*_HEADER.unpack_from(data))
    if header.version != _VERSION:
        raise FrozenFileError(
            f"{path} has the version {header.version} of the format, and this coframe knows {_VERSION}",
            hint="Save it again with this coframe, or install the one that wrote it.",
        )
    if zlib.crc32(data[: _HEADER.size]) != _CRC.unpack_from(data, _HEADER.size)[0]:
        raise _damaged(path, "the checksum of its header differs")
    if header.samples % _PAGE or header.samples < _PAGE:
        raise _damaged(path, "its samples lie at an odd place")
    if max(header.samples + header.samples_size, header.table + header.table_size) > size:
        raise _damaged(path, "it is cut off")
    return header


def _damaged(path: Path, reason: str) -> FrozenFileError:
    return FrozenFileError(f"{path} is damaged: {reason}", hint="Save the buffer again.")
