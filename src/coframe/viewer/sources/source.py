# SPDX-License-Identifier: Apache-2.0
"""The interface of sources, and the source for a buffer."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal, Protocol

if TYPE_CHECKING:
    from collections.abc import Generator

    from coframe.bags import Recording
    from coframe.buffer.buffer import Buffer
    from coframe.connection.connection import Connection
    from coframe.doctor import Report
    from coframe.viewer.sources.topic_messages import TopicMessages

__all__ = ["BufferSource", "Mode", "ViewerSource"]

Mode = Literal["live", "recording", "buffer"]


class ViewerSource(Protocol):
    """A source of transforms and messages.

    Attributes:
        mode: The kind of source.
        title: The title of the browser tab.
        buffer: The transforms.
        connection: The connection to the ROS graph, or None if there is none.
        recording: The recording, or None if there is none.
        span: The first and the last stamp in nanoseconds, or None if the transforms determine it.
    """

    mode: Mode
    title: str
    buffer: Buffer
    connection: Connection | None
    recording: Recording | None
    span: tuple[int, int] | None

    def topics(self) -> list[tuple[str, str]]:
        """Return the topics that exist now, with their types, in order."""

    def open(self, topic: str) -> TopicMessages | None:
        """Return the messages on a topic, which the caller closes, or None if the topic does not exist."""

    def refresh(self) -> None:
        """Follow changes such as new publishers; called about once per second."""

    def examine(self) -> Generator[dict[str, Report] | None, None, None] | None:
        """Return a generator of doctor reports by namespace, or None if there is nothing to examine.

        The generator is advanced every half second in a separate thread, where it may block, and yields None while
        there is no new report. The caller closes it.
        """

    def close(self) -> None:
        """Release the resources that the source opened itself."""


class BufferSource:
    """A buffer without messages.

    Args:
        buffer: The transforms.
        title: The title of the browser tab.
        mode: The kind of source that the page shows.
    """

    connection: Connection | None = None
    recording: Recording | None = None
    span: tuple[int, int] | None = None

    def __init__(self, buffer: Buffer, title: str = "coframe", mode: Mode = "buffer") -> None:
        self.buffer = buffer
        self.title = title
        self.mode = mode

    def topics(self) -> list[tuple[str, str]]:
        """Return no topics."""
        return []

    def open(self, _topic: str) -> TopicMessages | None:
        """Return None: a buffer has no messages."""
        return None

    def refresh(self) -> None:
        """Do nothing: a buffer has no publishers."""

    def examine(self) -> None:
        """Return None: a buffer contains neither the publishers nor the arrival times that the doctor needs."""

    def close(self) -> None:
        """Do nothing: the buffer belongs to the caller."""
