# SPDX-License-Identifier: Apache-2.0
"""Recordings with individually compressed messages (rosbag2's compression mode "message")."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe.bags._compression import MAX_UNPACKED_MESSAGE, DamagedError, unpack_beginning, unpack_message
from coframe.bags.storage import MAX_RATIO, Batch, Storage, unpacked_budget
from coframe.messages.slices import Slices

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from coframe.bags.storage import Channel, ListedChunk, Listing

__all__ = ["UnpackedMessages"]

_BATCH_BYTES = 64 << 20  # bytes of unpacked messages in a batch


class UnpackedMessages(Storage):
    """Wraps another storage and unpacks its messages."""

    def __init__(self, storage: Storage, compression: str) -> None:
        super().__init__(storage.path, storage.problems)
        self.format = storage.format
        self.compressions = {f"{compression} (each message)"}
        self._packed_messages = storage
        self._compression = compression
        # The total size of messages with an unusual ratio is limited. Each of them is counted once.
        self._budget = unpacked_budget(storage.size)
        self._counted_positions: set[int] = set()  # their positions

    def channels(self) -> list[Channel]:
        """Return the channels of the wrapped storage."""
        return self._packed_messages.channels()

    def batches(self, is_selected: Callable[[Channel], bool], progress: Callable[[int], object]) -> Iterator[Batch]:
        """Yield the batches of the wrapped storage with unpacked messages."""
        for batch in self._packed_messages.batches(is_selected, progress):
            if batch.messages is None:
                yield batch
                continue
            yield from self._unpack_batch(batch.channel, batch, batch.messages)

    def listing(self) -> Listing | None:
        """Return the index of the wrapped storage."""
        return self._packed_messages.listing()

    def read_chunk(self, chunk: ListedChunk) -> Iterator[Batch]:
        """Yield the messages of a chunk, unpacked."""
        for batch in self._packed_messages.read_chunk(chunk):
            if batch.messages is not None:
                yield from self._unpack_batch(batch.channel, batch, batch.messages)

    def _unpack_batch(self, channel: Channel, packed_batch: Batch, messages: Slices) -> Iterator[Batch]:
        """Yield a batch in parts, so that not all unpacked messages are in memory at the same time."""
        rows: list[int] = []
        unpacked: list[bytes] = []
        size = 0
        for row, (position, message) in enumerate(zip(packed_batch.positions.tolist(), messages.each(), strict=True)):
            try:
                data = self._unpack(position, message)
            except DamagedError as error:
                self.add_problem(f"messages on {channel.topic} cannot be unpacked: {error}")
                continue
            rows.append(row)
            unpacked.append(data)
            size += len(data)
            if size >= _BATCH_BYTES:
                yield Batch(channel, packed_batch.received[rows], packed_batch.positions[rows], Slices.join(unpacked))
                rows, unpacked, size = [], [], 0
        yield Batch(channel, packed_batch.received[rows], packed_batch.positions[rows], Slices.join(unpacked))

    def _unpack(self, position: int, message: bytes | memoryview) -> bytes:
        usual = MAX_RATIO * len(message)
        if position in self._counted_positions:
            return unpack_message(self._compression, message)
        data = unpack_message(self._compression, message, min(MAX_UNPACKED_MESSAGE, max(usual, self._budget)))
        if len(data) > usual:
            self._counted_positions.add(position)
            self._budget -= len(data)
        return data

    def read(self, position: int) -> bytes:
        """Return the unpacked bytes of one message."""
        return self._unpack(position, self._packed_messages.read(position))

    def head(self, position: int, size: int) -> bytes:
        """Return the first bytes of one message, without unpacking the rest."""
        return unpack_beginning(self._compression, self._packed_messages.read(position), size)

    def close(self) -> None:
        """Close the file."""
        self._packed_messages.close()
