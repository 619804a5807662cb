"""What is viewed: the ROS graph, a recording, or a buffer."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal, NamedTuple, Protocol

if TYPE_CHECKING:
    from collections.abc import Generator

    from coframe import Buffer
    from coframe.connection import Connection
    from coframe.doctor import Report
    from coframe.viewer.sources.messages import Messages

__all__ = ["BufferSource", "Mode", "Source", "Topic"]

Mode = Literal["live", "recording", "buffer"]


class Topic(NamedTuple):
    """A topic that can be displayed."""

    topic: str
    type: str
    display: str


class Source(Protocol):
    """What is viewed.

    Attributes:
        mode: What kind it is.
        title: What the tab is called.
        buffer: Its transforms.
        connection: Where joint states can be sent; None where that is nowhere.
        span: The first and the last time that it has, in nanoseconds; None where its transforms tell.
    """

    mode: Mode
    title: str
    buffer: Buffer
    connection: Connection | None
    span: tuple[int, int] | None

    def topics(self) -> list[Topic]:
        """What can be displayed now, in order."""

    def open(self, topic: str) -> Messages | None:
        """The messages of a topic, to be closed again; None where there is none of that name."""

    def refresh(self) -> None:
        """Takes in what has changed around it; to be called now and then."""

    def examine(self) -> Generator[dict[str, Report] | None, None, None] | None:
        """The doctor's reports by namespace, or None where there is none yet, to be asked for every half a second.

        The generator may take long, in a thread of its own, and is to be closed. None: there is nothing to examine.
        """

    def close(self) -> None:
        """Gives back what the source itself has opened."""


class BufferSource:
    """A buffer alone: frames, and no messages."""

    connection: Connection | None = None
    span: tuple[int, int] | None = None

    def __init__(self, buffer: Buffer, title: str = "coframe", mode: Mode = "buffer") -> None:
        self.buffer = buffer
        self.title = title
        self.mode = mode

    def topics(self) -> list[Topic]:
        """None."""
        return []

    def open(self, _topic: str) -> Messages | None:
        """None."""
        return None

    def refresh(self) -> None:
        """Nothing: the buffer is looked at anyway."""

    def examine(self) -> None:
        """Nothing: a buffer does not tell who sent what, nor when it came."""

    def close(self) -> None:
        """The buffer is the caller's."""
