# SPDX-License-Identifier: Apache-2.0
"""The nodes, publishers and subscriptions of this process."""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple, TypeVar

from coframe import _core
from coframe.errors import WireError
from coframe.wire import names
from coframe.wire.graph import DiscoveredEndpoint, NodeInfo
from coframe.wire.system_clock import clock_fault

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from coframe.wire._backend import BackendEndpoint, BackendReader, BackendWriter
    from coframe.wire.graph import Graph
    from coframe.wire.names import Endpoint
    from coframe.wire.participant import Participant
    from coframe.wire.qos import QoS

ValueT = TypeVar("ValueT")


class Sample(NamedTuple):
    """A received message.

    Attributes:
        data: The message: 4 bytes of encapsulation, then CDR. `Subscription.take_decoded` returns message objects.
        source_timestamp: The time at which it was published, in nanoseconds since 1970 on the publisher's clock.
        writer: The handle of the writer that sent it, for `Participant.writer_node`.
    """

    data: Any
    source_timestamp: int
    writer: int


class StatusCounts(NamedTuple):
    """The counts of a status, in the order of DDS. Counts that a status does not have are 0.

    Attributes:
        total: The number of events so far; for LIVELINESS, how many publishers are alive.
        total_change: Its change since the status was taken last; for LIVELINESS, how many publishers are not alive.
        current: The number of matched endpoints; for INCOMPATIBLE_QOS, the number of the last policy; for LIVELINESS,
            the change of `total`.
        current_change: Its change since the status was taken last; for LIVELINESS, the change of `total_change`.
    """

    total: int
    total_change: int
    current: int
    current_change: int


class GraphNode:
    """A node of this process on the ROS graph. Created by `Participant.add_node`."""

    def __init__(self, participant: Participant, namespace: str, name: str, *, has_parameters: bool) -> None:
        self.namespace = namespace
        self.name = name
        self.has_parameters = has_parameters
        self._participant = participant
        self._endpoints: dict[bytes, LocalEndpoint] = {}
        self._info: NodeInfo | None = None
        self._has_changed = True
        self._is_held = False

    @property
    def full_name(self) -> str:
        """The node's name with its namespace, such as "/talker"."""
        return names.full_name(self.namespace, self.name)

    @property
    def endpoints(self) -> list[LocalEndpoint]:
        """The node's open endpoints."""
        return list(self._endpoints.values())

    def find_writer(self, handle: int) -> DiscoveredEndpoint | None:
        """Return the writer that sent a `Sample`, given its handle, or None if it has left."""
        return self._participant.find_writer(handle)

    def info(self) -> NodeInfo | None:
        """Return the description of this node that is published on the graph, or None if it is not announced yet."""
        if self._has_changed and not self._is_held:
            self._has_changed = False
            endpoints = self.endpoints
            self._info = NodeInfo(
                self.namespace,
                self.name,
                readers=tuple(guid for endpoint in endpoints if not endpoint.is_writer for guid in endpoint.guids),
                writers=tuple(guid for endpoint in endpoints if endpoint.is_writer for guid in endpoint.guids),
            )
        return self._info

    def hold(self) -> None:
        """Do not announce changes of this node until `announce` or `close` is called, which announce all of them."""
        self._is_held = True

    def announce(self) -> None:
        """Announce this node with its present endpoints, and from now on each change."""
        self._is_held = False
        self._participant.announce()

    def add(self, endpoint: LocalEndpoint) -> None:
        """Announce `endpoint` as an endpoint of this node."""
        self._endpoints[endpoint.guid] = endpoint
        self.endpoints_changed()
        if not self._is_held:
            self._participant.announce()

    def remove(self, endpoint: LocalEndpoint) -> None:
        """Stop announcing `endpoint` as an endpoint of this node."""
        if self._endpoints.pop(endpoint.guid, None):
            self.endpoints_changed()
            if not self._is_held:
                self._participant.announce()

    def endpoints_changed(self) -> None:
        """Describe the endpoints again in the next announcement."""
        self._has_changed = True

    def close(self) -> None:
        """Remove the node from the graph and close its endpoints."""
        self.hold()
        for endpoint in self.endpoints:
            endpoint.leave(self)
        self._participant.remove_node(self)


class LocalEndpoint:
    """A reader or writer of this process, announced as an endpoint of one or more of its nodes.

    The constructor announces the endpoint, after which the maintenance thread uses it. Subclasses must therefore call
    this constructor last.

    Attributes:
        adapts: Whether the caller replaces the endpoint when its QoS does not match the other side. If so, no
            warning about incompatible QoS is logged.
        on_mismatch: Called with the reason ("type" or a QoS policy) and a message for each endpoint on the topic that
            cannot communicate with this one. If None, the participant warns.
    """

    is_writer: ClassVar[bool] = False
    adapts = False
    on_mismatch: Callable[[str, str], object] | None = None

    def __init__(self, native: BackendEndpoint, node: GraphNode, endpoint: Endpoint, qos: QoS) -> None:
        self.guid = native.guid
        self.topic = endpoint.dds_topic
        self.qos = qos
        self.description = DiscoveredEndpoint(self.guid, b"", self.topic, endpoint.dds_type, qos)
        self._endpoint = native
        self._nodes: list[GraphNode] = []
        self._lock = threading.Lock()
        self._closed = False
        self.share(node)

    @property
    def guids(self) -> Sequence[bytes]:
        """The identifiers of everything on the graph that this endpoint consists of."""
        return (self.guid,)

    @property
    def matched(self) -> int:
        """The number of matched endpoints on the other side, or 0 after `close`."""
        return self._read_unless_closed(lambda: self._endpoint.matched, 0)

    def writer(self, handle: int) -> DiscoveredEndpoint | None:
        """Return the writer that sent a `Sample`, given its handle, or None if it has left."""
        with self._lock:
            node = self._nodes[0] if self._nodes else None
        return None if node is None else node.find_writer(handle)

    def matched_handles(self) -> set[int]:
        """Return the handles of the matched endpoints on the other side."""
        return self._read_unless_closed(lambda: set(self._endpoint.matched_handles()), set())

    @property
    def refused_policy(self) -> int:
        """The DDS number of the QoS policy that made the last match fail, or 0 if no match failed."""
        return self._read_unless_closed(lambda: self._endpoint.refused_policy, 0)

    def take_status(self, kind: int) -> StatusCounts | None:
        """Return the counts of a status if it has changed since the last call.

        Args:
            kind: `_core.DEADLINE_MISSED`, `LIVELINESS`, `INCOMPATIBLE_QOS`, `MATCHED` or `SAMPLE_LOST`.
        """
        counts = None if self._closed else self._endpoint.take_status(kind)
        return None if counts is None else StatusCounts(*counts)

    def graph_changed(self, graph: Graph) -> None:
        """Adapt to a change of the graph. The maintenance thread calls this."""

    def report_unreachable(self) -> None:
        """Report that no endpoint on the other side understands this one, if that is so."""

    @property
    def has_warning(self) -> bool:
        """Whether messages were ignored since the last call of `take_warning`."""
        return False

    def take_warning(self) -> str:
        """Return a warning about the messages that were ignored since the last call, or "" if there are none."""
        return ""

    @property
    def closed(self) -> bool:
        """Whether the endpoint is closed."""
        return self._closed

    def share(self, node: GraphNode) -> None:
        """Announce this as an endpoint of `node` as well."""
        with self._lock:
            if node not in self._nodes:
                self._nodes.append(node)
        node.add(self)

    def leave(self, node: GraphNode) -> None:
        """Remove this endpoint from `node`, and close it if no other node uses it. A second call has no effect."""
        with self._lock:
            if node in self._nodes:
                self._nodes.remove(node)
            last = not self._nodes and not self._closed
            self._closed |= last
        node.remove(self)
        if last:
            self._endpoint.close()

    def _read_unless_closed(self, read: Callable[[], ValueT], closed: ValueT) -> ValueT:
        try:
            return closed if self._closed else read()
        except _core.EndpointError:
            if self._closed:  # by another thread in the meantime
                return closed
            raise

    def close(self) -> None:
        """Remove this endpoint from all nodes and close it. A second call has no effect."""
        for node in list(self._nodes):
            self.leave(node)


class Publisher(LocalEndpoint):
    """A publisher of serialized messages."""

    is_writer = True

    def __init__(
        self,
        native: BackendWriter,
        node: GraphNode,
        endpoint: Endpoint,
        qos: QoS,
        *,
        on_mismatch: Callable[[str, str], object] | None = None,
    ) -> None:
        self._writer = native
        self.on_mismatch = on_mismatch
        super().__init__(native, node, endpoint, qos)

    def write(self, cdr: bytes) -> None:
        """Publish a message: 4 bytes of encapsulation, then CDR. The GIL is released while it is sent.

        Raises:
            WireError: The publisher is closed, the bytes are not a message of the topic's type, or a reliable
                subscription has not kept up for one second.
        """
        try:
            self._send(cdr)
        except _core.EndpointError as error:
            raise self._write_error(str(error)) from error

    def publish(self, codec: _core.MessageCodec, message: object) -> bool:
        """Serialize and publish a message, without the copies of large arrays that `write` needs.

        Returns:
            False if the message was not published, because the codec does not support it: serialize it and call
            `write`.

        Raises:
            WireError: As for `write`.
        """
        try:
            return self._writer.publish(codec, message)
        except _core.EndpointError as error:
            raise self._write_error(str(error)) from error

    def direct(
        self,
        codec: _core.MessageCodec,
        closed: _core.Event,
        failure: Callable[[WireError], BaseException],
        *,
        of_items: bool = False,
    ) -> Callable[[object], bool] | None:
        """Return a native function that does what `publish` does, or None if the middleware has no such function.

        Args:
            codec: The codec of the message class.
            closed: When this is set, the function publishes nothing and returns False, as it does after `close`.
            failure: Returns the exception to raise instead of an error of `publish`.
            of_items: Whether to pass the items of the message's only field, or a single item, instead of a message.
        """
        return self._writer.direct(codec, closed, lambda text: failure(self._write_error(text)), of_items)

    def assert_liveliness(self) -> None:
        """Assert that this publisher is alive."""
        if not self._closed:
            self._writer.assert_liveliness()

    def wait_for_acks(self, timeout_ns: int) -> bool:
        """Wait until all reliable subscriptions have received all messages. Return False after the timeout."""
        return self._closed or self._writer.wait_for_acks(timeout_ns)

    def _send(self, cdr: bytes) -> None:
        self._writer.write(cdr)

    def _write_error(self, error: str) -> WireError:
        topic = names.any_ros_name(self.topic)
        if self._closed:
            return WireError(f"The publisher on {topic} is closed.", hint="Publish before you close the node.")
        if error.endswith("Timeout"):
            return WireError(
                f"Publishing on {topic} failed: a reliable subscription has not kept up for 1 s.",
                hint="Publish less often, publish with best-effort reliability (qos_profile_sensor_data), "
                "or find the subscriber that hangs.",
            )
        if (fault := clock_fault()) is not None:
            return WireError(f"Publishing on {topic} failed. {fault}", hint=fault.hint)
        return WireError(
            f"Publishing on {topic} failed: {error}.",
            hint=f"The bytes must be the CDR serialization of a {names.ros_type(self.description.type)}.",
        )


class RawPublisher(Publisher):
    """A publisher of serialized messages whose type does not have to be known in this process."""

    def _send(self, cdr: bytes) -> None:
        self._writer.forward(cdr)


class Subscription(LocalEndpoint):
    """A subscription that queues serialized messages until they are taken."""

    def __init__(
        self,
        native: BackendReader,
        node: GraphNode,
        endpoint: Endpoint,
        qos: QoS,
        *,
        adapts: bool = False,
        on_mismatch: Callable[[str, str], object] | None = None,
    ) -> None:
        self._reader = native
        self.adapts = adapts
        self.on_mismatch = on_mismatch
        super().__init__(native, node, endpoint, qos)

    def take(self, limit: int = 100) -> list[Sample]:
        """Return up to `limit` queued messages, oldest first, without waiting."""
        return [Sample(*message) for message in self._reader.take(limit)]

    def take_decoded(self, codec: _core.MessageCodec, limit: int = 100) -> list[Sample]:
        """Return what `take` returns, with messages instead of their bytes where the codec can read them."""
        return [Sample(*message) for message in self._reader.take_decoded(limit, codec)]

    def pending(self) -> bool:
        """Return whether messages may be queued. Cheap; may return True although `take` returns none."""
        return not self._closed and self._reader.pending
