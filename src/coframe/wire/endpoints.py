"""What a node has on the wire: publishers, subscriptions, and listeners that fill a buffer."""

from __future__ import annotations

import threading
from collections import deque
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

import numpy as np

from coframe import _core
from coframe.errors import WireError
from coframe.tf_publishers import TfPublisher, publisher_of
from coframe.wire import names
from coframe.wire.discovery_info import NodeInfo
from coframe.wire.graph import DdsEndpoint, Graph

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from coframe.wire.participant import Participant
    from coframe.wire.qos import QoS

_REMEMBERED = 100  # publishers that have left
_NO_AUTHORITY = "<no authority available>"

NativeEndpoint: TypeAlias = "_core.Writer | _core.Reader | _core.Tap | _core.TfReader"


class Sample(NamedTuple):
    """A received message.

    Attributes:
        data: 4 bytes of encapsulation, then CDR.
        source_timestamp: when it was written, in nanoseconds since 1970 by the writer's clock.
        writer: its writer's handle, for `Participant.writer_node`.
    """

    data: bytes
    source_timestamp: int
    writer: int


class GraphNode:
    """A node of this process, as the graph sees it. Made by `Participant.add_node`."""

    def __init__(self, participant: Participant, namespace: str, name: str) -> None:
        self.namespace = namespace
        self.name = name
        self._participant = participant
        self._endpoints: dict[bytes, WireEndpoint] = {}

    @property
    def full_name(self) -> str:
        """With the namespace: "/talker"."""
        return names.full_name(self.namespace, self.name)

    @property
    def endpoints(self) -> list[WireEndpoint]:
        """The open endpoints."""
        return list(self._endpoints.values())

    def info(self) -> NodeInfo:
        """What the graph is told."""
        endpoints = self.endpoints
        return NodeInfo(
            self.namespace,
            self.name,
            readers=tuple(endpoint.guid for endpoint in endpoints if not endpoint.is_writer),
            writers=tuple(endpoint.guid for endpoint in endpoints if endpoint.is_writer),
        )

    def add(self, endpoint: WireEndpoint) -> None:
        """Shows `endpoint` as this node's."""
        self._endpoints[endpoint.guid] = endpoint
        self._participant.announce()

    def remove(self, endpoint: WireEndpoint) -> None:
        """Shows `endpoint` as this node's no longer."""
        if self._endpoints.pop(endpoint.guid, None):
            self._participant.announce()

    def close(self) -> None:
        """Takes the node off the graph and closes its endpoints."""
        for endpoint in self.endpoints:
            endpoint.leave(self)
        self._participant.remove_node(self)


class WireEndpoint:
    """A DDS reader or writer on a topic, announced as that of one node or of several.

    The constructor announces it, and from then on the housekeeping thread uses it: it must be the last thing that a
    child's constructor calls.

    Attributes:
        adapts: Whether somebody follows what the other side offers, so that nobody need be warned of it.
    """

    adapts = False

    def __init__(self, native: NativeEndpoint, node: GraphNode, topic: str, dds_type: str, qos: QoS) -> None:
        self.guid = native.guid
        self.topic = topic
        self.qos = qos
        self.is_writer = isinstance(native, _core.Writer)
        self.description = DdsEndpoint(self.guid, b"", topic, dds_type, qos)
        self._endpoint = native
        self._nodes: list[GraphNode] = []
        self._lock = threading.Lock()
        self._closed = False
        self.share(node)

    @property
    def matched(self) -> int:
        """How many endpoints on the other side have been found; 0 once closed."""
        return 0 if self._closed else self._endpoint.matched

    def matched_handles(self) -> set[int]:
        """The handles of the endpoints on the other side that have been found."""
        return set() if self._closed else set(self._endpoint.matched_handles())

    @property
    def refused_policy(self) -> int:
        """DDS's number of the policy by which the last endpoint was refused; 0: none was."""
        return 0 if self._closed else self._endpoint.refused_policy

    @property
    def closed(self) -> bool:
        """Whether it has left the topic."""
        return self._closed

    def share(self, node: GraphNode) -> None:
        """Announces it as that of `node` too."""
        with self._lock:
            if node not in self._nodes:
                self._nodes.append(node)
        node.add(self)

    def leave(self, node: GraphNode) -> None:
        """Takes it from `node`; taken from the last one, it closes. Leaving twice does no harm."""
        with self._lock:
            if node in self._nodes:
                self._nodes.remove(node)
            last = not self._nodes and not self._closed
            self._closed |= last
        node.remove(self)
        if last:
            self._endpoint.close()

    def close(self) -> None:
        """Leaves the topic. Closing twice does no harm."""
        for node in list(self._nodes):
            self.leave(node)


class Publisher(WireEndpoint):
    """Writes serialised messages."""

    def __init__(self, native: _core.Writer, node: GraphNode, topic: str, dds_type: str, qos: QoS) -> None:
        self._writer = native
        super().__init__(native, node, topic, dds_type, qos)

    def write(self, cdr: bytes) -> None:
        """Sends a message: 4 bytes of encapsulation, then CDR. Other threads go on meanwhile.

        Raises:
            WireError: the publisher is closed, the bytes are not of the topic's type, or a reliable subscription
                has not kept up for a second.
        """
        try:
            self._send(cdr)
        except _core.DdsError as error:
            raise self._write_error(error) from error

    def _send(self, cdr: bytes) -> None:
        self._writer.write(cdr)

    def _write_error(self, error: _core.DdsError) -> WireError:
        topic = names.any_ros_name(self.topic)
        if self._closed:
            return WireError(f"The publisher on {topic} is closed.", hint="Publish before closing the node.")
        if error.args[0].endswith("Timeout"):
            return WireError(
                f"Publishing on {topic} failed: a reliable subscription has not kept up for a second.",
                hint="Publish less, or best-effort (qos_profile_sensor_data), or find out which subscriber hangs.",
            )
        return WireError(
            f"Publishing on {topic} failed: {error}.",
            hint=f"The bytes must be the CDR of a {names.ros_type(self.description.type)}.",
        )


class RawPublisher(Publisher):
    """Writes serialised messages whose type nobody here knows."""

    def _send(self, cdr: bytes) -> None:
        self._writer.forward(cdr)


class Subscription(WireEndpoint):
    """Holds serialised messages until they are taken."""

    def __init__(
        self, native: _core.Reader, node: GraphNode, topic: str, dds_type: str, qos: QoS, *, adapts: bool = False
    ) -> None:
        self._reader = native
        self.adapts = adapts
        super().__init__(native, node, topic, dds_type, qos)

    def take(self, limit: int = 100) -> list[Sample]:
        """Up to `limit` messages, the oldest first; without waiting."""
        return [Sample(*message) for message in self._reader.take(limit)]

    def pending(self) -> bool:
        """Whether messages may be waiting: cheap, and now and then true although `take` finds none."""
        return not self._closed and self._reader.pending


class TappedMessages(NamedTuple):
    """Messages, or their first bytes, the oldest first. Times are nanoseconds since 1970.

    Attributes:
        data: of each 4 bytes of encapsulation, then CDR, or the first bytes of it; one after the other.
        ends: where each ends, (N,) uint64.
        arrived: (N,) by this machine's clock.
        sent: (N,) by the clock of its writer's machine.
        writers: (N,) its writer's handle, uint64, for `Participant.writer_node`.
    """

    data: bytes
    ends: NDArray[np.uint64]
    arrived: NDArray[np.int64]
    sent: NDArray[np.int64]
    writers: NDArray[np.uint64]


class Tap(WireEndpoint):
    """Notes when messages come, on DDS's own thread, for those who look now and then."""

    def __init__(self, native: _core.Tap, node: GraphNode, topic: str, dds_type: str, qos: QoS) -> None:
        self._tap = native
        super().__init__(native, node, topic, dds_type, qos)

    def take(self) -> TappedMessages:
        """The messages since the last call."""
        data, ends, arrived, sent, writers = self._tap.take()
        return TappedMessages(
            data,
            np.frombuffer(ends, np.uint64),
            np.frombuffer(arrived, np.int64),
            np.frombuffer(sent, np.int64),
            np.frombuffer(writers, np.uint64),
        )

    @property
    def missed(self) -> int:
        """How many messages came while too many were waiting."""
        return self._tap.missed


class TfReader(WireEndpoint):
    """Stores the transforms of a topic in a buffer as they arrive, on DDS's own thread."""

    def __init__(
        self,
        native: _core.TfReader,
        node: GraphNode,
        topic: str,
        dds_type: str,
        qos: QoS,
        *,
        static: bool,
        name_writers: bool,
    ) -> None:
        self._reader = native
        self._static = static
        self._named: dict[int, str] | None = {} if name_writers else None
        self._gone: deque[int] = deque()
        self._naming = threading.Lock()
        super().__init__(native, node, topic, dds_type, qos)

    @property
    def stored_at(self) -> int:
        """When the newest message's transforms were in the buffer: `time.monotonic_ns()`; 0: never."""
        return self._reader.stored_at

    def pending(self) -> bool:
        """Whether messages may be waiting, as for a `Subscription`: never, they are in the buffer already."""
        return False

    def take(self, limit: int = 100) -> list[Sample]:
        """The messages that wait, as for a `Subscription`: none."""
        del limit
        return []

    def publishers(self, graph: Graph) -> list[TfPublisher]:
        """Who was heard so far, also who has left."""
        if self._closed:
            return []
        present = graph.writers(self.topic)
        topic = names.any_ros_name(self.topic)
        return [
            publisher_of(heard, graph.writer_node(heard[0]), topic, static=self._static, present=heard[0] in present)
            for heard in self._reader.writers()
        ]

    def name_writers(self, graph: Graph) -> None:
        """Lets the buffer note the publishing nodes, as far as the graph tells them."""
        if self._named is None or self._closed:
            return
        with self._naming:
            writers = graph.writers(self.topic)
            for handle in self._named.keys() - writers.keys():
                self._gone.append(handle)
                del self._named[handle]
            while len(self._gone) > _REMEMBERED:
                self._reader.forget_writer(self._gone.popleft())
            for handle, writer in writers.items():
                node = graph.owner(writer.guid)
                if node is not None and self._named.get(handle) != node:
                    self._reader.name_writer(handle, node)
                    self._named[handle] = node


def initial_authority(authority: str | None) -> str:
    """What a buffer notes before a publisher's node is known."""
    return _NO_AUTHORITY if authority is None else authority
