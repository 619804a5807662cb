"""Recordings whose messages were compressed one by one."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe.bags.compression import LARGEST, DamagedError, unpack
from coframe.bags.storage import Record, Storage

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from coframe.bags.storage import Channel

__all__ = ["UnpackedMessages"]


class UnpackedMessages(Storage):
    """Another storage, with its messages unpacked."""

    def __init__(self, packed: Storage, compression: str) -> None:
        super().__init__(packed.path, packed.problems)
        self._packed = packed
        self._compression = compression

    def records(self, wanted: Callable[[Channel], bool], progress: Callable[[int], object]) -> Iterator[Record]:
        """Those of the other storage, unpacked."""
        for record in self._packed.records(wanted, progress):
            if record.data is None:
                yield record
                continue
            try:
                yield record._replace(data=unpack(self._compression, record.data, LARGEST))
            except DamagedError as error:
                self.problem(f"messages on {record.channel.topic} that cannot be unpacked: {error}")

    def read(self, position: int) -> bytes:
        """One message's bytes, unpacked."""
        return unpack(self._compression, self._packed.read(position), LARGEST)

    def close(self) -> None:
        """Lets go of the file."""
        self._packed.close()
