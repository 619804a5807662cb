# SPDX-License-Identifier: Apache-2.0
"""The bytes of many messages in one block of memory."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from numpy.typing import NDArray

__all__ = ["Slices"]


class Slices(NamedTuple):
    """The bytes of many messages in one block of memory.

    Attributes:
        data: The block. It may contain other bytes between the messages.
        starts: Offset of the first byte of each message, (N,) uint64.
        ends: Offset after the last byte of each message, (N,) uint64.
    """

    data: bytes
    starts: NDArray[np.uint64]
    ends: NDArray[np.uint64]

    @staticmethod
    def join(messages: Sequence[bytes | memoryview]) -> Slices:
        """Copy separate messages into one block."""
        lengths = np.fromiter(map(len, messages), np.uint64, len(messages))
        return Slices.contiguous(b"".join(messages), np.cumsum(lengths))

    @staticmethod
    def contiguous(data: bytes, ends: NDArray[np.uint64]) -> Slices:
        """Describe a block in which each message begins where the previous one ends."""
        return Slices(data, np.concatenate([np.zeros(1, dtype=np.uint64), ends])[:-1], ends)

    def each(self) -> Iterator[memoryview]:
        """Iterate over the messages, without copying them."""
        view = memoryview(self.data)
        return (view[start:end] for start, end in zip(self.starts.tolist(), self.ends.tolist(), strict=True))
