# SPDX-License-Identifier: Apache-2.0
"""The interface of a middleware: a session in a ROS domain, its endpoints, and the graph.

`coframe.wire.dds` and `coframe.wire.zenoh` implement these protocols, as do other distributions such as
coframe-fastdds. Everything above them is the same for all. The endpoints of DDS are the native classes themselves, so
that DDS messages pass through no extra layer.

In all of them, topics and types are named as in DDS (`coframe.wire.names`), and a writer is identified by a handle, a
64-bit number that is part of each message and of the graph.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from coframe import _core
    from coframe.buffer.buffer import Buffer
    from coframe.wire.endpoints import GraphNode
    from coframe.wire.graph import Graph
    from coframe.wire.names import Endpoint
    from coframe.wire.qos import QoS
    from coframe.wire.request_header import RequestHeader


class QueueLimits(NamedTuple):
    """Limits of the queue of a `BackendTap`.

    Attributes:
        head: The number of bytes to keep of each message.
        messages: The number of messages.
        size: The total number of bytes. The last message may exceed it.
    """

    head: int
    messages: int
    size: int


class BackendEndpoint(Protocol):
    """A publisher or subscription of the middleware. Operations raise `_core.EndpointError` if they fail."""

    @property
    def guid(self) -> bytes:
        """The identifier of the endpoint on the graph, 16 bytes."""

    @property
    def matched(self) -> int:
        """The number of endpoints on the other side."""

    def matched_handles(self) -> list[int]:
        """Return the handles of the endpoints on the other side."""

    @property
    def refused_policy(self) -> int:
        """The DDS number of the QoS policy that made the last match fail, or 0 if no match failed."""

    def take_status(self, kind: int) -> tuple[int, int, int, int] | None:
        """Return the counts of a status if it has changed since the last call. See `LocalEndpoint.take_status`."""

    def close(self) -> None:
        """Close the endpoint; no callback runs afterwards. A second call has no effect."""


class BackendWriter(BackendEndpoint, Protocol):
    """A publisher of serialized messages: 4 bytes of encapsulation, then CDR."""

    def write(self, message: bytes) -> None:
        """Send a message. Transforms are checked if the writer was created with `checked`."""

    def forward(self, message: bytes) -> None:
        """Send a message without checking its bytes."""

    def publish(self, codec: _core.MessageCodec, message: object) -> bool:
        """Serialize and send a message without a copy. Return False if nothing was sent: `write` its bytes."""

    def direct(
        self,
        codec: _core.MessageCodec,
        closed: _core.Event,
        failure: Callable[[str], BaseException],
        of_items: bool,
    ) -> Callable[[object], bool] | None:
        """Return a native function that does what `publish` does, or None if the middleware has none.

        Args:
            codec: The codec of the message class.
            closed: When this is set, the function sends nothing and returns False.
            failure: Returns the exception to raise, given the text of an error.
            of_items: Whether the function takes the items of the message's only field instead of a message.
        """

    def assert_liveliness(self) -> None:
        """Assert that this publisher is alive."""

    def wait_for_acks(self, timeout_ns: int) -> bool:
        """Wait until all reliable subscriptions have received all messages. Return False after the timeout."""


class BackendServiceWriter(BackendWriter, Protocol):
    """A publisher of requests or replies."""

    @property
    def guids(self) -> Sequence[bytes]:
        """The identifiers of everything on the graph that this publisher consists of, with `guid` first."""

    @property
    def client_id(self) -> int:
        """For a publisher of requests, the client ID for their headers, by which servers know the client."""

    def reaches(self, header: RequestHeader, writer: int) -> bool:
        """Return whether a reply that is sent now reaches the client of a request.

        Some middlewares must discover the client's subscription first, which can take longer than the request.

        Args:
            header: The header of the request.
            writer: The handle of the writer of the request, or 0 if it is not known.
        """


class BackendReader(BackendEndpoint, Protocol):
    """A subscription that queues messages."""

    def take(self, limit: int) -> list[tuple[bytes, int, int]]:
        """Return up to `limit` messages: bytes, time of publication in ns since 1970, the writer's handle."""

    def take_decoded(self, limit: int, codec: _core.MessageCodec) -> list[tuple[Any, int, int]]:
        """Return the result of `take`, with messages instead of bytes if the middleware can decode them."""

    @property
    def pending(self) -> bool:
        """Whether messages may be queued."""


class BackendServiceReader(BackendReader, Protocol):
    """A subscription to requests or replies. Some middlewares store requests until they are answered."""

    def reject(self, header: RequestHeader) -> None:
        """Forget a request that will not be answered."""


class BackendTap(BackendEndpoint, Protocol):
    """A subscription that records messages with their arrival times."""

    def take(self) -> tuple[bytes, bytes, bytes, bytes, bytes]:
        """Return the messages since the last call. See `_core.Tap.take`."""

    @property
    def missed(self) -> int:
        """The number of messages that arrived while the queue was full."""


class BackendTfReader(BackendEndpoint, Protocol):
    """A subscription that stores transforms in a buffer without the GIL. It has the methods of `_core.TfReader`."""

    @property
    def stored_at(self) -> int: ...
    @property
    def received(self) -> int: ...
    def arm(self) -> None: ...
    def writers(self) -> list[tuple[int, int, int, int, int | None, str, str, str]]: ...
    def name_writer(self, writer: int, authority: str) -> None: ...
    def forget_writer(self, writer: int) -> None: ...
    def writer_left(self, writer: int) -> None: ...
    def settle_statics(self) -> None: ...


class Middleware(Protocol):
    """A middleware, a row of `coframe.wire.selection`. It imports its dependencies when it is first used."""

    @property
    def variables(self) -> Sequence[str]:
        """The environment variables that only this middleware has, and that select it if one is set."""

    def is_available(self, environment: Mapping[str, str]) -> bool:
        """Return whether it is installed, without importing it."""

    def check(self) -> None:
        """Raise a `WireError` if it is not installed, without importing it."""

    def describe(self) -> list[str]:
        """Return lines about the library for `coframe doctor --system`, unless it has its own examination."""

    def network(self, environment: Mapping[str, str]) -> str:
        """Return a string that is equal for two environments if processes in both join the same network.

        Raises:
            WireError: An environment variable has an invalid value.
        """

    def join(self, domain: int, changed: _core.Event) -> Session:
        """Join a ROS domain.

        Args:
            domain: The domain ID.
            changed: Set whenever the graph may have changed.

        Raises:
            WireError: It is not installed, its configuration is not valid, or it cannot join the domain.
        """


class Session(Protocol):
    """The membership of this process in a ROS domain. Methods that create endpoints raise `WireError`."""

    @property
    def graph(self) -> Graph:
        """The nodes and endpoints of the domain."""

    def writer(
        self,
        node: GraphNode,
        endpoint: Endpoint,
        qos: QoS,
        *,
        user_data: str = "",
        checked: bool = False,
        on_change: _core.Event | None = None,
    ) -> BackendWriter:
        """Create a publisher on a topic; with `checked`, `write` raises `EndpointError` for damaged transforms."""

    def service_writer(
        self, node: GraphNode, endpoint: Endpoint, qos: QoS, user_data: str = ""
    ) -> BackendServiceWriter:
        """Create a publisher of requests or replies."""

    def reader(self, node: GraphNode, endpoint: Endpoint, qos: QoS, on_data: _core.Event | None) -> BackendReader:
        """Create a subscription to a topic that queues messages."""

    def service_reader(
        self, node: GraphNode, endpoint: Endpoint, qos: QoS, on_data: _core.Event | None, user_data: str = ""
    ) -> BackendServiceReader:
        """Create a subscription that queues requests or replies."""

    def tap(self, node: GraphNode, endpoint: Endpoint, qos: QoS, limits: QueueLimits) -> BackendTap:
        """Create a subscription that records messages."""

    def tf_reader(
        self,
        node: GraphNode,
        endpoint: Endpoint,
        qos: QoS,
        buffer: Buffer,
        *,
        static: bool,
        authority: str,
        renaming: _core.Renaming | None,
        on_data: _core.Event | None,
    ) -> BackendTfReader:
        """Create a subscription that stores transforms."""

    def announce(self, nodes: Sequence[GraphNode]) -> None:
        """Publish the nodes of this process with their endpoints."""

    def repeat_announcement(self) -> int:
        """Announce this process again if it is due. Return the time until the next call in nanoseconds."""

    def adapt(self) -> str:
        """Adapt to a change of the graph. Return a warning, or "" if there is none."""

    def close(self) -> None:
        """Leave the domain. All endpoints must be closed first."""
