# SPDX-License-Identifier: Apache-2.0
"""Recordings whose messages are compressed one by one (rosbag2's compression mode "message")."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from coframe.bags.compression import LARGEST, DamagedError, unpack
from coframe.bags.storage import Batch, Storage
from coframe.messages.slices import Slices

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from coframe.bags.storage import Channel

__all__ = ["UnpackedMessages"]


class UnpackedMessages(Storage):
    """Wraps another storage and unpacks its messages."""

    def __init__(self, packed: Storage, compression: str) -> None:
        super().__init__(packed.path, packed.problems)
        self.format = packed.format  # type: ignore[misc]
        self.compressions = {f"{compression} (each message)"}
        self._packed = packed
        self._compression = compression

    def channels(self) -> list[Channel]:
        """Return the channels of the wrapped storage."""
        return self._packed.channels()

    def batches(self, wanted: Callable[[Channel], bool], progress: Callable[[int], object]) -> Iterator[Batch]:
        """Yield the batches of the wrapped storage with unpacked messages."""
        for batch in self._packed.batches(wanted, progress):
            if batch.messages is None:
                yield batch
                continue
            unpacked = [self._unpack(batch.channel, message) for message in batch.messages.each()]
            readable = np.array([message is not None for message in unpacked], dtype=bool)
            messages = Slices.join([message for message in unpacked if message is not None])
            yield Batch(batch.channel, batch.received[readable], batch.positions[readable], messages)

    def _unpack(self, channel: Channel, message: memoryview) -> bytes | None:
        try:
            return unpack(self._compression, message, LARGEST)
        except DamagedError as error:
            self.add_problem(f"messages on {channel.topic} cannot be unpacked: {error}")
            return None

    def read(self, position: int) -> bytes:
        """Return the unpacked bytes of one message."""
        return unpack(self._compression, self._packed.read(position), LARGEST)

    def close(self) -> None:
        """Close the file."""
        self._packed.close()
