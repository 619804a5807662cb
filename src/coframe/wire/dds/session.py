# SPDX-License-Identifier: Apache-2.0
"""The membership of this process in a DDS domain."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeVar

from coframe import _core
from coframe.errors import WireError
from coframe.wire.dds import config, library, participants
from coframe.wire.dds._announcements import Announcements, participant_user_data
from coframe.wire.dds._discovery_requests import DiscoveryRequests
from coframe.wire.dds._history import HistoryRequests
from coframe.wire.dds.topics import create_topic
from coframe.wire.qos import GRAPH_READER, GRAPH_WRITER, QoS, for_service_reader
from coframe.wire.request_header import random_client_id
from coframe.wire.rtps.announcer import NodeAnnouncer
from coframe.wire.rtps.discovery_info import ADAPTS, ROS_TYPE, TOPIC, TYPE
from coframe.wire.rtps.graph import DdsGraph
from coframe.wire.rtps.user_data import endpoint_user_data
from coframe.wire.vendors import SERVICE_PARTITIONS, uses_service_partitions

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from coframe.buffer.buffer import Buffer
    from coframe.wire._backend import QueueLimits
    from coframe.wire.endpoints import GraphNode
    from coframe.wire.names import Endpoint
    from coframe.wire.request_header import RequestHeader

EndpointT = TypeVar("EndpointT")


class DdsServiceReader(_core.Reader):
    """A reader of requests or replies. Implements `coframe.wire._backend.BackendServiceReader`."""

    def reject(self, header: RequestHeader) -> None:
        """Do nothing: DDS stores no requests."""


class DdsServiceWriter(_core.Writer):
    """A writer of requests or replies. Implements `coframe.wire._backend.BackendServiceWriter`.

    Args:
        graph: The graph.
        arguments: Those of the native class.
    """

    def __init__(self, graph: DdsGraph, *arguments: Any) -> None:
        self._graph = graph
        self.client_id = random_client_id()
        super().__init__(*arguments)

    @property
    def guids(self) -> tuple[bytes]:
        """The GUID of this writer."""
        return (self.guid,)

    def reaches(self, header: RequestHeader, writer: int) -> bool:
        """Return whether the subscription to replies of a client is matched."""
        del header
        return self._graph.has_matched_client(self.matched_handles(), writer)


class DdsSession:
    """A DDS participant. Implements `coframe.wire._backend.Session`.

    Args:
        domain: The domain ID.
        changed: Set when the graph may have changed.

    Attributes:
        native: The participant.
        graph: The nodes and endpoints of the domain.

    Raises:
        WireError: There is no usable DDS library, an environment variable has an invalid value, or DDS cannot create
            the participant.
    """

    def __init__(self, domain: int, changed: _core.Event) -> None:
        library.load()
        self.native = participants.join(domain, config.cyclone_config(), participant_user_data())
        self._announcements = Announcements(self.native, repeated=config.reaches_other_machines())
        participant = self.native.entity
        self._announcer = NodeAnnouncer(
            self.native.guid,
            _core.Writer(
                participant, self._graph_topic(), native_qos(GRAPH_WRITER), endpoint_user_data(ROS_TYPE, ADAPTS)
            ),
        )
        self.graph = DdsGraph(
            self.native.guid,
            _core.Reader(
                participant, self._graph_topic(), native_qos(GRAPH_READER), endpoint_user_data(ROS_TYPE), changed
            ),
            _core.EndpointReader(participant, _core.PUBLICATIONS, changed),
            _core.EndpointReader(participant, _core.SUBSCRIPTIONS, changed),
            _core.EndpointReader(participant, _core.PARTICIPANTS, changed),
        )
        self._discovery = DiscoveryRequests(self.native.guid, domain, self.graph)
        self._history = HistoryRequests(self.native, self.graph)

    def writer(
        self,
        node: GraphNode,
        endpoint: Endpoint,
        qos: QoS,
        *,
        user_data: str = "",
        checked: bool = False,
        on_change: _core.Event | None = None,
    ) -> _core.Writer:
        """Create a writer."""
        del node
        return self._create(
            endpoint,
            lambda topic, data: _core.Writer(self.native.entity, topic, native_qos(qos), data, checked, on_change),
            user_data,
        )

    def service_writer(self, node: GraphNode, endpoint: Endpoint, qos: QoS, user_data: str = "") -> DdsServiceWriter:
        """Create a writer of requests or replies."""
        del node
        partitions = SERVICE_PARTITIONS if endpoint.kind == "request" and uses_service_partitions(qos) else ()
        profile = native_qos(qos, partitions)
        return self._create(
            endpoint,
            lambda topic, data: DdsServiceWriter(self.graph, self.native.entity, topic, profile, data),
            user_data,
        )

    def reader(self, node: GraphNode, endpoint: Endpoint, qos: QoS, on_data: _core.Event | None) -> _core.Reader:
        """Create a reader that queues messages."""
        del node
        return self._create(
            endpoint, lambda topic, data: _core.Reader(self.native.entity, topic, native_qos(qos), data, on_data)
        )

    def service_reader(
        self, node: GraphNode, endpoint: Endpoint, qos: QoS, on_data: _core.Event | None, user_data: str = ""
    ) -> DdsServiceReader:
        """Create a reader that queues requests or replies."""
        del node
        profile = native_qos(for_service_reader(qos), SERVICE_PARTITIONS)
        return self._create(
            endpoint, lambda topic, data: DdsServiceReader(self.native.entity, topic, profile, data, on_data), user_data
        )

    def tap(self, node: GraphNode, endpoint: Endpoint, qos: QoS, limits: QueueLimits) -> _core.Tap:
        """Create a reader that records messages."""
        del node
        return self._create(
            endpoint,
            lambda topic, data: _core.Tap(self.native.entity, topic, native_qos(qos), data, *limits),
        )

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
    ) -> _core.TfReader:
        """Create a reader that stores transforms on the DDS thread."""
        del node
        return self._create(
            endpoint,
            lambda topic, data: _core.TfReader(
                self.native.entity, topic, native_qos(qos), data, buffer, static, authority, renaming, on_data
            ),
        )

    def announce(self, nodes: Sequence[GraphNode]) -> None:
        """Publish the nodes of this process with their endpoints."""
        described = [info for node in nodes if (info := node.info()) is not None]
        self.graph.set_own_nodes(described)
        self._announcer.announce(described)

    def repeat_announcement(self) -> int:
        """Announce this process again if the network may have lost the first announcements."""
        self._announcer.repeat()
        return min(self._announcements.send_due(), self._discovery.update(), self._history.update())

    def adapt(self) -> str:
        """Publish the nodes of this process in the form that the others can read, and request what they have."""
        self._discovery.update()
        self._history.update()
        return self._announcer.adapt(self.graph)

    def close(self) -> None:
        """Leave the domain."""
        self._history.close()
        self._announcer.close()
        self.graph.close()
        self.native.close()

    def _graph_topic(self) -> int:
        return create_topic(self.native.entity, TOPIC, TYPE)

    def _create(self, endpoint: Endpoint, make: Callable[[int, str], EndpointT], user_data: str = "") -> EndpointT:
        """Create an endpoint with `make(handle of the topic, user data)`."""
        data = endpoint_user_data(endpoint.ros_type, user_data)
        topic = create_topic(self.native.entity, endpoint.dds_topic, endpoint.dds_type)
        try:
            return make(topic, data)
        except _core.EndpointError as error:
            raise WireError(
                f"DDS cannot create an endpoint on {endpoint.name}: {error}.",
                hint="Check that the participant is not closed.",
            ) from error


def native_qos(qos: QoS, partitions: Sequence[str] = ()) -> _core.QosProfile:
    """Return the quality of service as arguments of the native code.

    Args:
        qos: The quality of service.
        partitions: The partitions of the endpoint. If there are none, it is in the default partition.
    """
    return _core.QosProfile(
        qos.depth,
        qos.reliable,
        qos.transient_local,
        qos.keep_all,
        qos.manual_liveliness,
        qos.deadline,
        qos.lifespan,
        qos.lease,
        list(partitions),
    )
