# SPDX-License-Identifier: Apache-2.0
"""A file whose format can only be read sequentially, without access to single messages."""

from __future__ import annotations

import tempfile
import threading
from array import array
from typing import TYPE_CHECKING, Any, BinaryIO, NamedTuple, cast

import numpy as np

from coframe._files.os_errors import reason
from coframe.bags._compression import DamagedError
from coframe.bags.storage import Batch, Channel, Storage, read_at
from coframe.errors import RecordingError
from coframe.messages import serialize
from coframe.messages.definition_texts import definition_of
from coframe.messages.slices import Slices

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator
    from pathlib import Path

    from coframe.bags._problems import Problems
    from coframe.bags._recording_format import RecordingFormat
    from coframe.messages import Message

__all__ = ["MessageFile", "serialize_messages"]

_BATCH_MESSAGES = 2000
_BATCH_BYTES = 16 << 20
_MAX_TIME = 1 << 63


def serialize_messages(messages: Iterable[tuple[str, int, Message]]) -> Iterator[tuple[Channel, int, bytes]]:
    """Yield messages as CDR, with one channel for each topic and type.

    Raises:
        TypeError: A message is not an instance of a ROS class.
    """
    channels: dict[tuple[str, str], Channel] = {}
    for topic, received, message in messages:
        type_ = getattr(type(message), "ROS_TYPE", None)
        if type_ is None:
            raise TypeError(f"a message on {topic} is of {type(message).__name__}, which is not a ROS message")
        if (topic, type_) not in channels:
            definition = definition_of(type_).encode()
            channels[topic, type_] = Channel(topic, type_, "cdr", definition, "ros2msg" if definition else "")
        yield channels[topic, type_], received, serialize(message)


class _PendingBatch(NamedTuple):
    """Messages of one channel that the next batch contains."""

    received: list[int]
    positions: list[int]
    messages: list[bytes]


class MessageFile(Storage):
    """Reads all messages once, and keeps their bytes in an unnamed temporary file.

    The position of a message is its number in the order of the format.
    """

    def __init__(self, path: Path, problems: Problems, format_: RecordingFormat) -> None:
        super().__init__(path, problems)
        self.format = format_
        self._path = path
        self._lock = threading.Lock()
        self._bytes = cast("BinaryIO", tempfile.TemporaryFile())  # noqa: SIM115 - `close` closes it
        self._offsets = array("Q", [0])
        self._channels: dict[Channel, None] = {}

    def channels(self) -> list[Channel]:
        """Return the channels found so far."""
        return list(self._channels)

    def batches(self, is_selected: Callable[[Channel], bool], progress: Callable[[int], object]) -> Iterator[Batch]:
        """Yield all messages. An exception of the format ends the file and is added to the problems."""
        del is_selected
        pending: dict[Channel, _PendingBatch] = {}
        size = count = 0
        for channel, received, data in self._valid_messages():
            lists = pending.setdefault(channel, _PendingBatch([], [], []))
            lists.received.append(received)
            lists.positions.append(self._append(data))
            lists.messages.append(data)
            size, count = size + len(data), count + 1
            if size >= _BATCH_BYTES or count >= _BATCH_MESSAGES:
                yield from _batches(pending)
                pending, size, count = {}, 0, 0
        yield from _batches(pending)
        progress(self.size)

    def _valid_messages(self) -> Iterator[tuple[Channel, int, bytes]]:
        """Yield the messages of the format that are valid."""
        try:
            for channel, received, data in self.format.serialized_messages(self._path):
                self._channels[channel] = None
                time = _integer(received)
                if time is None:
                    self.add_problem("messages with an invalid receive time")
                else:
                    yield channel, time, bytes(data)
        except Exception as error:  # noqa: BLE001 - formats are plug-ins, and files may be damaged
            number = len(self._offsets) - 1
            self.add_problem(f"{type(error).__name__} after {number} messages ({self.format.name}): {error}")

    def _append(self, data: bytes) -> int:
        try:
            with self._lock:
                self._bytes.seek(self._offsets[-1])
                self._bytes.write(data)
                self._bytes.flush()
        except OSError as error:
            raise RecordingError(
                f"the messages of {self.path} cannot be written to a temporary file: {reason(error)}",
                hint=f"Free space in {tempfile.gettempdir()}, or set TMPDIR to another folder.",
            ) from None
        self._offsets.append(self._offsets[-1] + len(data))
        return len(self._offsets) - 2

    def read(self, position: int) -> bytes:
        """Return the bytes of one message."""
        return self.head(position, self._offsets[position + 1] - self._offsets[position])

    def head(self, position: int, size: int) -> bytes:
        """Return the first bytes of one message."""
        start, end = self._offsets[position], self._offsets[position + 1]
        with self._lock:
            if self._bytes.closed:
                raise DamagedError("the recording is closed")
            return read_at(self._bytes, start, min(size, end - start))

    def close(self) -> None:
        """Close the temporary file, which deletes it."""
        with self._lock:
            self._bytes.close()


def _integer(received: Any) -> int | None:
    """Return a receive time in nanoseconds, or None if it is not one."""
    try:
        time = received.__index__()  # NumPy's integers have it, and floats do not
    except AttributeError:
        return None
    return int(time) if 0 <= time < _MAX_TIME else None


def _batches(pending: dict[Channel, _PendingBatch]) -> Iterator[Batch]:
    for channel, (received, positions, messages) in pending.items():
        yield Batch(
            channel,
            np.array(received, dtype=np.int64),
            np.array(positions, dtype=np.uint64),
            Slices.join(messages),
        )
