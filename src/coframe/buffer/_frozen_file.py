# SPDX-License-Identifier: Apache-2.0
"""The file format of frozen buffers: write a buffer, and read and check a header.

A frozen file is little endian throughout:

    header    ``_HEADER``: signature, position and checksum of the two parts below, padded to a page
    samples   chunks of 256 stamps (int64) and 256 records of 64 bytes (x, y, z, w of the quaternion, x, y, z of
              the translation, index of the parent); each frame begins a new chunk
    table     names of authorities and frames; for each frame its kind, its counters, its number of samples, and
              its first and last stamp
    covariances  of edges, if there are any; see `coframe.buffer._covariances.pack`

Opening a file reads and checks only the header and the table. The samples are mapped into memory, and the system reads
the pages that lookups touch; small files are copied instead. No number in the file can make a lookup read outside it,
even if the file is damaged.
"""

from __future__ import annotations

import contextlib
import io
import os
import struct
import zlib
from typing import TYPE_CHECKING, BinaryIO, NamedTuple

from coframe import _core
from coframe._files.complete_files import complete_or_absent
from coframe._files.regular_files import open_regular
from coframe.buffer._covariances import pack
from coframe.errors import FrozenFileError

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from coframe.buffer import Buffer

__all__ = [
    "BLOCK_SIZE",
    "Header",
    "content_of",
    "damaged_file_error",
    "open_file",
    "read_covariances",
    "read_header",
    "save",
]

_MAGIC = b"\x89CFZ\r\n\x1a\n"
_VERSION = 1
_PAGE = 4096
_CHUNK = 256 * (8 + 64)
_WRONG_FILE_HINT = "Buffer.save() writes frozen buffers; open_bag() reads recordings."
_CHUNKS_PER_WRITE = 256  # number of chunks written at once
_CRC = struct.Struct("<I")
BLOCK_SIZE = _CHUNKS_PER_WRITE * _CHUNK  # bytes that are written or checked at once


class Header(NamedTuple):
    """The first bytes of a file. The CRC-32 of these bytes follows them.

    Attributes:
        magic: File signature; its line endings detect transfers in text mode.
        version: Version of the format.
        table_crc: CRC-32 of the table.
        samples_crc: CRC-32 of the samples.
        covariances_crc: CRC-32 of the covariances, which follow the table, or 0 if there are none.
        cache: Cache length of the buffer in nanoseconds; negative if it kept everything.
        samples: Position of the samples.
        samples_size: Size of the samples in bytes.
        table: Position of the table.
        table_size: Size of the table in bytes.
    """

    magic: bytes
    version: int
    table_crc: int
    samples_crc: int
    covariances_crc: int
    cache: int
    samples: int
    samples_size: int
    table: int
    table_size: int


_HEADER = struct.Struct("<8sIIIIqQQQQ")


def save(snapshot: Buffer, path: str | os.PathLike[str]) -> None:
    """Write a frozen buffer to a file. See :meth:`coframe.Buffer.save`."""
    try:
        with complete_or_absent(path) as part, part.open("wb") as file:
            _write(snapshot, file)
            file.flush()
            os.fsync(file.fileno())
    except OSError as error:
        raise FrozenFileError(
            f"{path} cannot be written: {error.strerror or error}",
            hint="Check that the folder exists, that you may write to it, and that the disk has space. "
            "On Windows, no other program may have the file open.",
        ) from None


def content_of(snapshot: Buffer) -> bytes:
    """Return the content of the file of a frozen buffer."""
    file = io.BytesIO()
    _write(snapshot, file)
    return file.getvalue()


def _write(snapshot: Buffer, file: BinaryIO) -> None:
    table, chunks = _core.frozen_parts(snapshot)
    file.write(bytes(_PAGE))  # The header is written last: it contains the checksums.
    crc = 0
    for first in range(0, chunks, _CHUNKS_PER_WRITE):
        block = _core.frozen_chunks(snapshot, first, _CHUNKS_PER_WRITE)
        crc = zlib.crc32(block, crc)
        file.write(block)
    size = chunks * _CHUNK
    file.write(table)
    covariances = pack(snapshot)
    file.write(covariances)
    covariances_crc = (zlib.crc32(covariances) or 1) if covariances else 0
    header = _HEADER.pack(
        _MAGIC,
        _VERSION,
        zlib.crc32(table),
        crc,
        covariances_crc,
        snapshot.cache_ns,
        _PAGE,
        size,
        _PAGE + size,
        len(table),
    )
    file.seek(0)
    file.write(header + _CRC.pack(zlib.crc32(header)))


def read_covariances(path: Path, file: BinaryIO, header: Header) -> bytes:
    """Return the bytes of the covariances; empty if there are none.

    Raises:
        FrozenFileError: The checksum is wrong.
    """
    if not header.covariances_crc:
        return b""
    file.seek(header.table + header.table_size)
    data = file.read()
    if (zlib.crc32(data) or 1) != header.covariances_crc:
        raise damaged_file_error(path, "the checksum of its covariances is wrong")
    return data


@contextlib.contextmanager
def open_file(path: Path) -> Iterator[BinaryIO]:
    """Open a file for reading.

    Raises:
        FrozenFileError: The file cannot be opened or read.
    """
    try:
        with open_regular(path) as file:
            yield file
    except (OSError, ValueError) as error:
        if isinstance(error, FrozenFileError):
            raise
        reason = getattr(error, "strerror", None) or error
        raise FrozenFileError(f"{path} cannot be opened: {reason}", hint=_WRONG_FILE_HINT) from None


def read_header(path: Path | str, file: BinaryIO, size: int) -> Header:
    """Read the header at the beginning of a file and check it.

    Args:
        path: The file, for error messages.
        file: The file, opened for reading.
        size: Its size in bytes.

    Raises:
        FrozenFileError: The file is not a frozen buffer, has another version, or is damaged.
    """
    data = file.read(_HEADER.size + _CRC.size)
    if not data.startswith(_MAGIC):
        raise FrozenFileError(
            f"{path} is not a frozen buffer",
            hint=_WRONG_FILE_HINT,
        )
    if len(data) < _HEADER.size + _CRC.size:
        raise damaged_file_error(path, "it is truncated")
    header = Header(*_HEADER.unpack_from(data))
    if header.version != _VERSION:
        raise FrozenFileError(
            f"{path} has version {header.version} of the format; this version of coframe reads version {_VERSION}",
            hint="Save the buffer again with this version of coframe, or install the version that wrote the file.",
        )
    if zlib.crc32(data[: _HEADER.size]) != _CRC.unpack_from(data, _HEADER.size)[0]:
        raise damaged_file_error(path, "the checksum of the header is wrong")
    if header.samples % _PAGE or header.samples < _PAGE:
        raise damaged_file_error(path, "the samples do not begin at a page boundary")
    if max(header.samples + header.samples_size, header.table + header.table_size) > size:
        raise damaged_file_error(path, "it is truncated")
    return header


def damaged_file_error(path: Path | str, reason: str) -> FrozenFileError:
    """Return the error for a damaged file."""
    return FrozenFileError(f"{path} is damaged: {reason}", hint="Save the buffer again.")
