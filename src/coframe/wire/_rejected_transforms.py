# SPDX-License-Identifier: Apache-2.0
"""Warnings about transforms that were received but not stored."""

from __future__ import annotations

import time
import weakref
from typing import TYPE_CHECKING

from coframe.wire import names

if TYPE_CHECKING:
    from collections.abc import Callable

    from coframe.buffer.buffer import Buffer
    from coframe.wire.graph import DiscoveredEndpoint, Graph
    from coframe.wire.tf_reader import TfReader

_REPEAT_AFTER = 10.0  # seconds

# For each counter of `Buffer.statistics`: what happened, what was affected, and why.
_REASONS = {
    "refused": (
        "Rejected",
        "transforms",
        "tf2 requires a non-zero quaternion, finite numbers, a frame_id, and a parent other than the frame itself.",
    ),
    "over_limit": (
        "Rejected",
        "transforms",
        "their frames are new, and the buffer cannot store more frames of other nodes.",
    ),
    "old": (
        "Dropped",
        "transforms",
        "they are older than the cache. Check whether two clocks differ or a recording was started again.",
    ),
    "malformed": (
        "Dropped",
        "messages",
        "their bytes are not a TFMessage. Check for a program that serializes its own messages.",
    ),
}


class RejectedTransformMonitor:
    """Warns about received transforms that were not stored in a buffer, at most every 10 s per reason.

    A later lookup only reports that the frame does not exist. tf2 logs every rejected transform instead.

    Args:
        graph: The graph, which contains the publishers.
        warn: Called with each warning.
    """

    def __init__(self, graph: Graph, warn: Callable[[str], None]) -> None:
        self._graph = graph
        self._warn = warn
        self._buffers: weakref.WeakKeyDictionary[TfReader, Buffer] = weakref.WeakKeyDictionary()
        # For each buffer and reason: the count at the last warning, and its time.
        self._reported_counts: dict[tuple[int, str], tuple[int, float]] = {}

    def add(self, reader: TfReader, buffer: Buffer) -> None:
        """Monitor the transforms that `reader` stores in `buffer`."""
        self._buffers[reader] = buffer

    def check(self, readers: list[TfReader]) -> None:
        """Warn about transforms of `readers` that were rejected since the last warning."""
        buffers = {id(buffer): buffer for reader in readers if (buffer := self._buffers.get(reader)) is not None}
        self._reported_counts = {key: reported for key, reported in self._reported_counts.items() if key[0] in buffers}
        for number, buffer in buffers.items():
            counts = buffer.statistics
            counts["refused"] -= counts["over_limit"]
            for kind, (verb, what, reason) in _REASONS.items():
                before, at = self._reported_counts.get((number, kind), (0, -_REPEAT_AFTER))
                if counts[kind] > before and time.monotonic() - at >= _REPEAT_AFTER:
                    self._reported_counts[number, kind] = counts[kind], time.monotonic()
                    sources = [reader for reader in readers if self._buffers.get(reader) is buffer]
                    count = counts[kind] - before
                    self._warn(f"{verb} {count} of the {what} {self._origin(sources)}: {reason}")

    def _origin(self, readers: list[TfReader]) -> str:
        topics = " or ".join(names.any_ros_name(reader.topic) for reader in readers)
        owners = (self._graph.owner(writer.guid) for reader in readers for writer in self._writers(reader))
        nodes = sorted({owner for owner in owners if owner})
        return f"on {topics} (from {' or '.join(nodes)})" if nodes else f"on {topics}"

    def _writers(self, reader: TfReader) -> list[DiscoveredEndpoint]:
        return list(self._graph.writers(reader.topic).values())
