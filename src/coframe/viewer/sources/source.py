# SPDX-License-Identifier: Apache-2.0
"""The interface of sources, and the source for a buffer."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Literal, Protocol

from coframe.viewer.sources.requested_quality import AUTOMATIC, RequestedQuality
from coframe.viewer.sources.topic_names import VIEWER_NODE, NodeName, resolve_topic

if TYPE_CHECKING:
    from collections.abc import Callable, Generator

    from coframe.bags import Recording
    from coframe.buffer.buffer import Buffer
    from coframe.connection.connection import Connection
    from coframe.doctor import Report
    from coframe.viewer.protocol.common import ClockState
    from coframe.viewer.sources.topic_messages import TopicMessages

__all__ = ["BufferSource", "Mode", "ViewerSource", "WithoutClock"]

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
        node: The node relative to which names of topics are resolved.
    """

    mode: Mode
    title: str
    buffer: Buffer
    connection: Connection | None
    recording: Recording | None
    span: tuple[int, int] | None
    node: NodeName

    def topics(self) -> list[tuple[str, str]]:
        """Return the topics that exist now, with their types, in order."""

    def resolve(self, topic: str) -> str:
        """Return the full name of a topic.

        Raises:
            ViewerError: The name is not valid.
        """

    def open(self, topic: str, quality: RequestedQuality = AUTOMATIC) -> TopicMessages | None:
        """Return the messages on a topic, which the caller closes, or None if the topic does not exist.

        Args:
            topic: The full name of the topic.
            quality: The quality of service to request from publishers; without effect if there are none.

        Raises:
            WireError: The middleware cannot create the subscription.
        """

    def refresh(self) -> None:
        """Follow changes such as new publishers; called about once per second."""

    @property
    def clock(self) -> ClockState:
        """The clock of the source."""

    def watch(self, newest: Callable[[str], int]) -> str:
        """Return why everything has to start again, or "" to continue; called about five times per second.

        Args:
            newest: Returns the newest stamp of a frame in the buffer, or 0 if there is none.
        """

    def restart(self) -> None:
        """Remove the transforms of the time before a jump. Static transforms stay."""

    def running(self) -> int:
        """Return the time in nanoseconds by which frames become stale: monotonic, without pauses of a simulation."""

    def other_subscriptions(self, topic: str) -> int:
        """Return the number of subscriptions to a topic without those of the viewer."""

    def examine(self) -> Generator[dict[str, Report] | None, None, None] | None:
        """Return a generator of doctor reports by namespace, or None if there is nothing to examine.

        The generator is advanced every half second in a separate thread, where it may block, and yields None while
        there is no new report. The caller closes it.
        """

    def close(self) -> None:
        """Release the resources that the source opened itself."""


class WithoutClock:
    """The methods of sources whose time cannot jump."""

    clock: ClockState = "system"

    def watch(self, _newest: Callable[[str], int]) -> str:
        """Return "": there is no reason to start again."""
        return ""

    def restart(self) -> None:
        """Do nothing: nothing is older than a jump."""

    def running(self) -> int:
        """Return the time of the monotonic clock in nanoseconds."""
        return time.monotonic_ns()

    def other_subscriptions(self, _topic: str) -> int:
        """Return 0: nothing is published."""
        return 0


class BufferSource(WithoutClock):
    """A buffer without messages.

    Args:
        buffer: The transforms.
        title: The title of the browser tab.
        mode: The kind of source that the page shows.
        node: The node relative to which names of topics are resolved.
    """

    connection: Connection | None = None
    recording: Recording | None = None
    span: tuple[int, int] | None = None

    def __init__(
        self, buffer: Buffer, title: str = "coframe", mode: Mode = "buffer", node: NodeName = VIEWER_NODE
    ) -> None:
        self.buffer = buffer
        self.title = title
        self.mode = mode
        self.node = node

    def topics(self) -> list[tuple[str, str]]:
        """Return no topics."""
        return []

    def resolve(self, topic: str) -> str:
        """Return the full name of a topic."""
        return resolve_topic(topic, self.node)

    def open(self, _topic: str, _quality: RequestedQuality = AUTOMATIC) -> TopicMessages | None:
        """Return None: a buffer has no messages."""
        return None

    def refresh(self) -> None:
        """Do nothing: a buffer has no publishers."""

    def examine(self) -> None:
        """Return None: a buffer contains neither the publishers nor the arrival times that the doctor needs."""

    def close(self) -> None:
        """Do nothing: the buffer belongs to the caller."""
