# SPDX-License-Identifier: Apache-2.0
"""Read parts of an MCAP file for a survey: with its index if it has one, else all of it."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

import numpy as np

from coframe import _core
from coframe._files.regular_files import open_regular
from coframe.bags._compression import MAX_UNPACKED_BYTES, DamagedError
from coframe.bags.editing import _mcap_layout as mcap
from coframe.bags.editing._survey import Source
from coframe.bags.formats import MCAP

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path
    from typing import BinaryIO

    from coframe.bags.storage import Channel

__all__ = ["McapSource", "definitions_in"]

_BLOCK_BYTES = 4 << 20  # bytes to read at once from records outside chunks


class McapSource(Source):
    """An MCAP file.

    Raises:
        OSError: The file cannot be read.
        DamagedError: The file is damaged.
    """

    def __init__(self, path: Path) -> None:
        self._path = path
        with open_regular(path) as file:
            size = os.fstat(file.fileno()).st_size
            summary = mcap.read_summary(file, size)
        self._chunks = None if summary is None else sorted(summary.chunks)
        if summary is not None and summary.definitions.channels and (summary.chunks or not summary.messages):
            self.definitions, self._span = summary.definitions, summary.span
        else:
            self._chunks, self.definitions, self._span = None, mcap.Definitions(), None
            self._read_all()

    def channels(self) -> list[Channel]:
        """Return all channels."""
        return list(self.definitions.channels.values())

    def span(self) -> tuple[int, int] | None:
        """Return the first and last log time."""
        return self._span

    def messages(self, is_selected: Callable[[Channel], bool]) -> Iterator[tuple[Channel, int, bytes]]:
        """Yield the messages of some channels in file order."""
        numbers = {number for number, channel in self.definitions.channels.items() if is_selected(channel)}
        for data in self._blocks(numbers):
            columns = _core.mcap_records(data)
            channels = np.frombuffer(columns[0], np.uint16)
            times, starts, ends = (np.frombuffer(column, np.uint64) for column in (columns[1], columns[3], columns[4]))
            for row in np.flatnonzero(np.isin(channels, list(numbers))).tolist():
                channel = self.definitions.channels[int(channels[row])]
                yield channel, int(times[row]), bytes(data[int(starts[row]) : int(ends[row])])

    def _read_all(self) -> None:
        for data in self._blocks(None):
            columns = _core.mcap_records(data)
            definitions_in(data, columns[5], self.definitions)
            times = np.frombuffer(columns[1], np.uint64)
            if len(times):
                first, last = self._span or (int(times[0]), int(times[0]))
                self._span = min(first, int(times.min())), max(last, int(times.max()))

    def _blocks(self, numbers: set[int] | None) -> Iterator[bytes]:
        """Yield sequences of records that contain all messages of the channels with these numbers, or None for all."""
        with open_regular(self._path) as file:
            if self._chunks is not None and numbers is not None:
                for place in self._chunks:
                    if numbers & place.channels or not place.channels:
                        file.seek(place.offset)
                        yield _chunk_at(file)
                return
            file.seek(len(MCAP.magic))
            while (head := mcap.read_head(file)) is not None:
                opcode, length = head
                if opcode in {mcap.DATA_END, mcap.FOOTER}:
                    return
                if opcode == mcap.CHUNK:
                    file.seek(-mcap.RECORD.size, os.SEEK_CUR)
                    yield _chunk_at(file)
                elif opcode in {mcap.SCHEMA, mcap.CHANNEL, mcap.MESSAGE}:
                    file.seek(-mcap.RECORD.size, os.SEEK_CUR)
                    start = file.tell()
                    data = file.read(max(_BLOCK_BYTES, min(length, MAX_UNPACKED_BYTES) + mcap.RECORD.size))
                    done = _core.mcap_records(data)[6]
                    if not done:
                        raise DamagedError("the file is truncated")
                    yield data[:done]
                    file.seek(start + done)
                else:
                    file.seek(length, os.SEEK_CUR)


def definitions_in(data: bytes, places: list[tuple[int, int, int]], definitions: mcap.Definitions) -> None:
    """Add the schemas and channels in records."""
    for opcode, start, end in places:
        add = definitions.add_schema if opcode == mcap.SCHEMA else definitions.add_channel
        add(bytes(data[start:end]))


def _chunk_at(file: BinaryIO) -> bytes:
    head = mcap.read_head(file)
    if head is None or head[0] != mcap.CHUNK or head[1] > MAX_UNPACKED_BYTES:
        raise DamagedError("the index lists a chunk where there is none")
    content = file.read(head[1])
    if len(content) < head[1]:
        raise DamagedError("the file is truncated inside a chunk")
    return mcap.read_chunk(content).data
