# SPDX-License-Identifier: Apache-2.0
"""The ways in which a connection can receive transforms. The first applicable row of `RECEIVERS` is used."""

from __future__ import annotations

import logging
import weakref
from typing import TYPE_CHECKING, Final, NamedTuple, Protocol

from coframe import _core
from coframe.connection.shared_transforms import SharedTransforms

if TYPE_CHECKING:
    from collections.abc import Callable

    from coframe.buffer.buffer import Buffer
    from coframe.connection.listener_config import ListenerConfig
    from coframe.wire.endpoints import GraphNode
    from coframe.wire.participant import Participant
    from coframe.wire.tf_reader import TfReader

__all__ = ["RECEIVERS", "Receiver", "Request", "open_receiver"]

_logger = logging.getLogger("coframe.wire")


class Request(NamedTuple):
    """The parameters of a connection that select its receiver.

    Attributes:
        config: The topics, frames, cache, domain and middleware.
        buffer: The buffer to fill.
        join: Joins the graph, unless the connection has done so.
        on_local_change: A method of the connection that is called when the program changes a buffer that reads shared
            transforms.
        shared: Whether the transforms may be shared with other processes.
    """

    config: ListenerConfig
    buffer: Buffer
    join: Callable[[], tuple[Participant, GraphNode]]
    on_local_change: Callable[[], None]
    shared: bool


class Receiver(Protocol):
    """Fills the buffer of a connection."""

    @property
    def shared(self) -> bool:
        """Whether the buffer reads transforms that one process receives for all processes."""

    @property
    def participant(self) -> Participant:
        """The participant of the subscriptions to transforms. It joins the graph at its first use."""

    @property
    def readers(self) -> list[TfReader]:
        """The subscriptions of this process to transforms; none if another process receives them."""

    def close(self) -> None:
        """Stop filling the buffer."""


class OwnReceiver:
    """Subscriptions of the connection's own node."""

    shared = False

    def __init__(self, request: Request) -> None:
        config = request.config
        self.participant, node = request.join()
        self.readers = [
            self.participant.tf_reader(
                node, topic, request.buffer, static=static, authority=None, renaming=config.renaming
            )
            for topic, static in zip(config.topics, (False, True), strict=True)
        ]

    def close(self) -> None:
        """Do nothing: the subscriptions end with the node."""


class SharedReceiver:
    """The transforms that one process of this user receives for all its processes.

    Attributes:
        transforms: The shared transforms.
    """

    shared = True

    def __init__(self, request: Request, transforms: SharedTransforms) -> None:
        self._buffer = request.buffer
        self._join = weakref.WeakMethod(request.join)
        self.transforms = transforms
        transforms.follow(request.buffer)
        # The connection refers to the buffer; the buffer must not refer to the connection.
        changed = weakref.WeakMethod(request.on_local_change)

        def on_local_change() -> None:
            method = changed()
            if method is not None:
                method()

        request.buffer._on_local_change(on_local_change)  # noqa: SLF001 - sharing requires private members

    @classmethod
    def open(cls, request: Request) -> SharedReceiver | None:
        """Share the transforms, or None if this system cannot."""
        try:
            return cls(request, SharedTransforms.join(request.config))
        except _core.SegmentError as error:
            _logger.warning("The transforms are not shared with other processes: %s", error)
            return None

    @property
    def participant(self) -> Participant:
        """The participant of the subscriptions, or of the connection if another process receives the transforms."""
        own = self.transforms.participant
        return own if own is not None else self._join_participant()

    @property
    def readers(self) -> list[TfReader]:
        """The subscriptions of this process to transforms; none if another process receives them."""
        return self.transforms.readers

    def close(self) -> None:
        """Stop reading the shared transforms. The buffer keeps its contents."""
        self._buffer._on_local_change(None)  # noqa: SLF001 - sharing requires private members
        self.detach()
        self.leave()

    def detach(self) -> None:
        """Detach the buffer, and copy the stored transforms into it."""
        self._buffer._stop_following()  # noqa: SLF001 - sharing requires private members

    def leave(self) -> None:
        """Stop using the shared transforms."""
        self.transforms.leave()

    def _join_participant(self) -> Participant:
        join = self._join()
        assert join is not None, "the connection uses this object"
        return join()[0]


class ReceiverRow(NamedTuple):
    """A way to receive transforms.

    Attributes:
        name: The name of the way.
        applies: Returns whether a connection uses it, unless an earlier row applies.
        open: Opens it; returns None if that is not possible on this system.
    """

    name: str
    applies: Callable[[Request], bool]
    open: Callable[[Request], Receiver | None]


RECEIVERS: Final = (
    ReceiverRow("shared", lambda request: request.shared, SharedReceiver.open),
    ReceiverRow("own", lambda _: True, OwnReceiver),
)


def open_receiver(request: Request) -> Receiver:
    """Receive transforms as the first applicable row that is possible on this system."""
    opened = (row.open(request) for row in RECEIVERS if row.applies(request))
    return next(receiver for receiver in opened if receiver is not None)
