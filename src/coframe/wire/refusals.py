"""Transforms that arrive and are not taken: how many, who sends on those topics, and what is refused at all."""

from __future__ import annotations

import time
import weakref
from typing import TYPE_CHECKING

from coframe.wire import names

if TYPE_CHECKING:
    from collections.abc import Callable

    from coframe import Buffer
    from coframe.wire.endpoints import TfReader
    from coframe.wire.graph import DdsEndpoint, Graph

_REPEAT_AFTER = 10.0  # seconds

_REASONS = {
    "refused": (
        "Refused",
        "transforms",
        "tf2 takes no quaternion of zeros, no NaN, no empty frame_id, and no frame that is its own parent.",
    ),
    "old": (
        "Left out",
        "transforms",
        "they are older than the cache. Do two clocks differ, or has a recording begun anew?",
    ),
    "malformed": (
        "Dropped",
        "messages",
        "they hold bytes that are no TFMessage. Is there a program that writes its own messages?",
    ),
}


class RefusalWatch:
    """Tells, once in a while, of transforms that did not get into a buffer.

    A look-up later only says that the frame does not exist; tf2 itself logs each of them, at the rate they come.

    Args:
        graph: Knows who publishes.
        warn: Is given the sentences.
    """

    def __init__(self, graph: Graph, warn: Callable[[str], None]) -> None:
        self._graph = graph
        self._warn = warn
        self._buffers: weakref.WeakKeyDictionary[TfReader, Buffer] = weakref.WeakKeyDictionary()
        self._told: dict[tuple[int, str], tuple[int, float]] = {}

    def add(self, reader: TfReader, buffer: Buffer) -> None:
        """Watches what `reader` brings to `buffer`."""
        self._buffers[reader] = buffer

    def check(self, readers: list[TfReader]) -> None:
        """Looks at the counters of the buffers that `readers` fill, and tells what is new."""
        fed = {id(buffer): buffer for reader in readers if (buffer := self._buffers.get(reader)) is not None}
        self._told = {key: told for key, told in self._told.items() if key[0] in fed}
        for number, buffer in fed.items():
            counts = buffer.statistics
            for kind, (verb, what, reason) in _REASONS.items():
                before, at = self._told.get((number, kind), (0, -_REPEAT_AFTER))
                if counts[kind] > before and time.monotonic() - at >= _REPEAT_AFTER:
                    self._told[number, kind] = counts[kind], time.monotonic()
                    fillers = [reader for reader in readers if self._buffers.get(reader) is buffer]
                    number_of = counts[kind] - before
                    self._warn(f"{verb} {number_of} of the {what} {self._origin(fillers)}: {reason}")

    def _origin(self, readers: list[TfReader]) -> str:
        topics = " or ".join(names.any_ros_name(reader.topic) for reader in readers)
        owners = (self._graph.owner(writer.guid) for reader in readers for writer in self._writers(reader))
        nodes = sorted({owner for owner in owners if owner})
        return f"on {topics} (from {' or '.join(nodes)})" if nodes else f"on {topics}"

    def _writers(self, reader: TfReader) -> list[DdsEndpoint]:
        return list(self._graph.writers(reader.topic).values())
