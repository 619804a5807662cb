# SPDX-License-Identifier: Apache-2.0
"""Interface of the file format readers: all messages once in file order, then individual messages by position."""

from __future__ import annotations

import bisect
import os
import threading
from abc import ABC, abstractmethod
from collections import OrderedDict
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, BinaryIO, NamedTuple

from coframe._sources.remote_error import RemoteFileError
from coframe._sources.sources import Source, file_size, open_file
from coframe.bags._compression import MAX_UNPACKED_BYTES, DamagedError
from coframe.errors import RecordingError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    import numpy as np
    from numpy.typing import NDArray

    from coframe._sources.sources import Readable
    from coframe.bags._problems import Problems
    from coframe.bags._recording_format import RecordingFormat
    from coframe.messages.slices import Slices

__all__ = [
    "MAX_DAMAGED_PLACES",
    "Batch",
    "Channel",
    "ChunkedStorage",
    "ListedChunk",
    "Listing",
    "Storage",
    "are_consistent",
    "next_chunk",
    "read_at",
]

# A chunk whose size is plausible for its packed bytes is read in full. The total of all chunks is limited as well,
# because a small file could otherwise take hours.
MAX_RATIO = 200  # ratio of the unpacked chunks to the file size
MIN_BUDGET = 4 << 30  # bytes of unpacked chunks that every file may have
MAX_DAMAGED_PLACES = 1000  # damaged places after which a reader continues; an index can list any number of them


def unpacked_budget(size: int) -> int:
    """Return how many bytes a file of this size may unpack to."""
    return max(MIN_BUDGET, MAX_RATIO * size)


@dataclass(frozen=True, eq=False, slots=True)  # a recording can have tens of thousands
class Channel:
    """The messages of one type on one topic in one file.

    Attributes:
        topic: Name of the topic.
        type: Name of the type, such as ``sensor_msgs/msg/Imu`` for ROS.
        encoding: Encoding of the messages: ``cdr``, ``ros1``, ``protobuf``, ``json``, ...
        definition: Definition of the type; may be empty.
        definition_format: ``ros2msg``, ``ros2idl``, ``ros1msg``, ``protobuf``, ``jsonschema`` or empty.
        offered_qos: QoS that the publishers offered, in rosbag2's YAML; may be empty.
        publisher: Name of the node that published the messages, which only recordings from ROS 1 contain.
    """

    topic: str
    type: str
    encoding: str
    definition: bytes = b""
    definition_format: str = ""
    offered_qos: str = ""
    publisher: str = ""


class Batch(NamedTuple):
    """Messages of one channel, in file order.

    Attributes:
        channel: The channel on which the messages were recorded.
        received: Receive times, (N,) int64 nanoseconds.
        positions: Arguments for :meth:`Storage.read`, (N,) uint64.
        messages: The bytes, or None if they are not wanted and reading them would take time.
        is_intact: False if their checksum shows that some of their bytes have changed.
    """

    channel: Channel
    received: NDArray[np.int64]
    positions: NDArray[np.uint64]
    messages: Slices | None
    is_intact: bool = True


class ListedChunk(NamedTuple):
    """A chunk as the index of its file describes it.

    Attributes:
        offset: Where it begins in the file.
        end: Where it ends.
        first: Receive time of its first message, in nanoseconds.
        last: Receive time of its last message, in nanoseconds.
        channels: The channels of its messages, or None if the index does not list them.
        unpacked: Its size after unpacking, in bytes.
    """

    offset: int
    end: int
    first: int
    last: int
    channels: frozenset[Channel] | None
    unpacked: int


class Listing(NamedTuple):
    """The index of a file, which gives access to single chunks.

    Attributes:
        chunks: All chunks that contain messages, in file order.
        counts: The number of messages of each channel.
    """

    chunks: list[ListedChunk]
    counts: dict[Channel, int]


class Storage(ABC):
    """A file of a recording. Reading is thread-safe."""

    format: RecordingFormat

    def __init__(self, path: Readable, problems: Problems) -> None:
        self.path = path
        self.problems = problems
        self.size = file_size(path)  # bytes
        self.compressions: set[str] = set()  # the methods found so far

    @property
    def local_path(self) -> Path:
        """The path, for those who read only files of this machine."""
        assert isinstance(self.path, Path)
        return self.path

    @abstractmethod
    def channels(self) -> list[Channel]:
        """Return the channels found so far; after :meth:`batches` all of them, including those without messages."""

    @abstractmethod
    def batches(self, is_selected: Callable[[Channel], bool], progress: Callable[[int], object]) -> Iterator[Batch]:
        """Yield all messages that can be read; damage is added to the problems.

        Args:
            is_selected: Returns whether the bytes of a channel's messages are needed.
            progress: Called regularly with the number of bytes of the file that have been read.
        """

    def listing(self) -> Listing | None:
        """Return the index of the file, or None if it has none, so that `batches` has to read everything."""
        return None

    def read_chunk(self, chunk: ListedChunk) -> Iterator[Batch]:
        """Yield the messages of a chunk of the index, including the bytes; damage is added to the problems."""
        raise NotImplementedError

    @abstractmethod
    def read(self, position: int) -> bytes:
        """Return the bytes of one message.

        Raises:
            DamagedError: The message no longer exists.
        """

    def head(self, position: int, size: int) -> bytes:
        """Return the first bytes of one message.

        Raises:
            DamagedError: The message no longer exists.
        """
        return self.read(position)[:size]

    @abstractmethod
    def close(self) -> None:
        """Close the file."""

    def add_problem(self, sentence: str, times: int = 1) -> None:
        """Add a problem of this file."""
        self.problems.add(f"{self.path.name}: {sentence}", times)


def are_consistent(chunks: list[ListedChunk], begin: int, size: int) -> bool:
    """Return whether the chunks in an index are plausible: inside the file and not overlapping.

    Args:
        chunks: In file order.
        begin: Where the first one may begin.
        size: The size of the file in bytes.
    """
    budget = unpacked_budget(size)
    for chunk in chunks:
        budget -= chunk.unpacked
        if not begin <= chunk.offset < chunk.end <= size or budget < 0:
            return False
        begin = chunk.end
    return True


def next_chunk(chunks: list[int], offset: int) -> int | None:
    """Return the first chunk after an offset, or None if there is none.

    Args:
        chunks: The offsets of the chunks, sorted.
        offset: A position in the file, in bytes.
    """
    place = bisect.bisect_right(chunks, offset)
    return chunks[place] if place < len(chunks) else None


def read_at(file: BinaryIO, offset: int, size: int) -> bytes:
    """Return bytes of a file; fewer at its end.

    Where possible, the position of the file is not used: processes that are forked from this one share it.
    """
    if not hasattr(os, "pread"):
        file.seek(offset)
        return file.read(size)
    parts = []
    while size > 0 and (part := os.pread(file.fileno(), size, offset)):
        parts.append(part)
        offset, size = offset + len(part), size - len(part)
    return parts[0] if len(parts) == 1 else b"".join(parts)


_OFFSET_BITS = 40
_CACHE_SIZE = 64 << 20  # bytes of unpacked chunks


class ChunkedStorage(Storage):
    """A file of records, some of which are chunks of compressed records.

    A position is an offset in the file, or the number of a chunk (from 1) and the offset inside it.
    """

    def __init__(self, path: Readable, problems: Problems) -> None:
        super().__init__(path, problems)
        self._file: BinaryIO = open_file(path)
        self._lock = threading.Lock()
        self._chunks: dict[int, int] = {}  # their numbers from 1, by their offsets in the file
        self._offsets: list[int] = []
        self._counted_chunks: set[int] = set()  # offsets of chunks
        self._unpacked_bytes = 0
        self._unpacked_chunks: OrderedDict[int, bytes] = OrderedDict()

    @abstractmethod
    def unpack_chunk(self, offset: int) -> bytes:
        """Return the records of the chunk at an offset of the file.

        Raises:
            DamagedError: No data of the chunk can be read.
        """

    @abstractmethod
    def payload(self, source: bytes | None, offset: int) -> bytes | memoryview:
        """Return the message in the record at an offset of a chunk, or of the file if ``source`` is None.

        Raises:
            DamagedError: There is no such record.
        """

    def bytes_at(self, offset: int, size: int) -> bytes:
        """Return bytes of the file; fewer at its end."""
        if not 0 <= offset < self.size:
            return b""
        if size > MAX_UNPACKED_BYTES:
            raise DamagedError(f"a record claims to have {size} bytes; the maximum is {MAX_UNPACKED_BYTES}")
        if isinstance(self.path, Source):
            try:
                return self.path.read(offset, size)
            except RemoteFileError as error:  # Messages that are only missing now must not look like damage.
                raise RecordingError(str(error), hint=error.hint) from None
        with self._lock:
            return read_at(self._file, offset, size)

    def check_budget(self, offset: int, packed: int, size: int) -> None:
        """Count the unpacked size of a chunk when it is read for the first time.

        Args:
            offset: The offset of the chunk.
            packed: The size of the packed bytes.
            size: The unpacked size.

        Raises:
            DamagedError: The chunks up to this one are larger than a plausible recording of this size.
        """
        if offset in self._counted_chunks or size <= packed or size > MAX_UNPACKED_BYTES:
            return  # `unpack` rejects a chunk that is too large.
        budget = unpacked_budget(self.size)
        if self._unpacked_bytes + size > budget:
            raise DamagedError(
                f"the chunks before it have {self._unpacked_bytes} unpacked bytes; the limit is {budget}"
            )
        self._counted_chunks.add(offset)
        self._unpacked_bytes += size

    def add_chunk(self, offset: int) -> int:
        """Register a chunk; return the number to add to an offset inside it to get a position."""
        if offset not in self._chunks:
            self._offsets.append(offset)
            self._chunks[offset] = len(self._offsets)
        return self._chunks[offset] << _OFFSET_BITS

    def read(self, position: int) -> bytes:
        """Return the bytes of one message, from a cached chunk if possible."""
        number, offset = divmod(position, 1 << _OFFSET_BITS)
        if number == 0:
            return bytes(self.payload(None, offset))
        return bytes(self.payload(self._unpack_cached(number), offset))

    def close(self) -> None:
        """Close the file."""
        self._file.close()
        self._unpacked_chunks.clear()

    def _unpack_cached(self, number: int) -> bytes:
        with self._lock:
            if number in self._unpacked_chunks:
                self._unpacked_chunks.move_to_end(number)
                return self._unpacked_chunks[number]
        data = self.unpack_chunk(self._offsets[number - 1])
        with self._lock:
            self._unpacked_chunks[number] = data
            while len(self._unpacked_chunks) > 1 and sum(map(len, self._unpacked_chunks.values())) > _CACHE_SIZE:
                self._unpacked_chunks.popitem(last=False)
        return data
