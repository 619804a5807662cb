"""What all kinds of files have in common: channels of messages, read once in a row and then at will."""

from __future__ import annotations

import threading
from abc import ABC, abstractmethod
from collections import OrderedDict
from dataclasses import dataclass
from typing import TYPE_CHECKING, BinaryIO, NamedTuple

from coframe.bags.compression import LARGEST, DamagedError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path

    import numpy as np
    from numpy.typing import NDArray

    from coframe.bags.problems import Problems
    from coframe.messages.slices import Slices

__all__ = ["Batch", "Channel", "ChunkedStorage", "Storage"]


@dataclass(frozen=True, eq=False)
class Channel:
    """Messages of one type on one topic, in one file.

    Attributes:
        topic: Its name.
        type: As ROS 2 names types, ``sensor_msgs/msg/Imu``; of other systems as they do.
        encoding: Of the messages: ``cdr``, ``ros1``, ``protobuf``, ``json``, ...
        definition: What the file says of the type; may be empty.
        definition_format: ``ros2msg``, ``ros2idl``, ``ros1msg``, ``protobuf``, ``jsonschema`` or empty.
        offered_qos: What the publishers offered, as rosbag2 writes it: YAML; may be empty.
    """

    topic: str
    type: str
    encoding: str
    definition: bytes = b""
    definition_format: str = ""
    offered_qos: str = ""


class Batch(NamedTuple):
    """Messages of one channel, in the order in which they lie in a file.

    Attributes:
        channel: Where they belong.
        received: When they were written down, (N,) int64 nanoseconds.
        positions: What :meth:`Storage.read` finds them by, (N,) uint64.
        messages: Their bytes, or None where these were not wanted and would have taken time.
    """

    channel: Channel
    received: NDArray[np.int64]
    positions: NDArray[np.uint64]
    messages: Slices | None


class Storage(ABC):
    """One file of a recording. Any thread may read."""

    def __init__(self, path: Path, problems: Problems) -> None:
        self.path = path
        self.problems = problems
        self.size = path.stat().st_size  # bytes

    @abstractmethod
    def batches(self, wanted: Callable[[Channel], bool], progress: Callable[[int], object]) -> Iterator[Batch]:
        """All messages that can be read, once; what cannot be is among the problems.

        Args:
            wanted: For which channels their bytes must be there.
            progress: Told now and then how many bytes of the file have been dealt with.
        """

    @abstractmethod
    def read(self, position: int) -> bytes:
        """One message's bytes.

        Raises:
            DamagedError: They are no longer there.
        """

    def head(self, position: int, size: int) -> bytes:
        """The first bytes of one message.

        Raises:
            DamagedError: They are no longer there.
        """
        return self.read(position)[:size]

    @abstractmethod
    def close(self) -> None:
        """Lets go of the file."""

    def problem(self, sentence: str, times: int = 1) -> None:
        """Notes what could not be read of this file."""
        self.problems.add(f"{self.path.name}: {sentence}", times)


_OFFSET_BITS = 40
_CACHED = 64 << 20  # bytes of unpacked chunks


class ChunkedStorage(Storage):
    """A file of records, some of them chunks: compressed records in a row.

    A position is an offset in the file, or the number of a chunk, from 1 on, and the offset inside it.
    """

    def __init__(self, path: Path, problems: Problems) -> None:
        super().__init__(path, problems)
        self._file: BinaryIO = path.open("rb")
        self._lock = threading.Lock()
        self._chunks: list[int] = []  # where they begin in the file
        self._unpacked: OrderedDict[int, bytes] = OrderedDict()

    @abstractmethod
    def unpack_chunk(self, offset: int) -> bytes:
        """The records of the chunk at this offset of the file.

        Raises:
            DamagedError: Nothing of it can be read.
        """

    @abstractmethod
    def payload(self, source: bytes | None, offset: int) -> bytes | memoryview:
        """The message in the record at an offset of a chunk, or of the file where ``source`` is None.

        Raises:
            DamagedError: There is none.
        """

    def bytes_at(self, offset: int, size: int) -> bytes:
        """Bytes of the file; fewer at its end."""
        if not 0 <= offset < self.size:
            return b""
        if size > LARGEST:
            raise DamagedError(f"a record of {size} bytes")
        with self._lock:
            self._file.seek(offset)
            return self._file.read(size)

    def add_chunk(self, offset: int) -> int:
        """What is added to offsets in this chunk to make them positions."""
        self._chunks.append(offset)
        return len(self._chunks) << _OFFSET_BITS

    def read(self, position: int) -> bytes:
        """One message's bytes, of a chunk that is unpacked or kept from before."""
        number, offset = divmod(position, 1 << _OFFSET_BITS)
        if number == 0:
            return bytes(self.payload(None, offset))
        return bytes(self.payload(self._chunk(number), offset))

    def close(self) -> None:
        """Lets go of the file."""
        self._file.close()
        self._unpacked.clear()

    def _chunk(self, number: int) -> bytes:
        with self._lock:
            if number in self._unpacked:
                self._unpacked.move_to_end(number)
                return self._unpacked[number]
        data = self.unpack_chunk(self._chunks[number - 1])
        with self._lock:
            self._unpacked[number] = data
            while len(self._unpacked) > 1 and sum(map(len, self._unpacked.values())) > _CACHED:
                self._unpacked.popitem(last=False)
        return data
