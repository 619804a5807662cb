# SPDX-License-Identifier: Apache-2.0
"""The membership of this process in a DDS domain."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, TypeVar

from coframe import _core
from coframe.errors import WireError
from coframe.wire.dds import config, library, participants
from coframe.wire.dds._announcements import Announcements, participant_user_data
from coframe.wire.dds._discovery_info import ADAPTS, TOPIC, choose_gid_size, encode_info, gid_size, unseen_text
from coframe.wire.dds._graph import DdsGraph
from coframe.wire.dds._user_data import endpoint_user_data
from coframe.wire.dds._vendors import SERVICE_PARTITIONS, uses_service_partitions
from coframe.wire.dds.topics import create_topic
from coframe.wire.qos import GRAPH_WRITER, QoS
from coframe.wire.system_clock import clock_fault

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from coframe.buffer.buffer import Buffer
    from coframe.wire._backend import QueueLimits
    from coframe.wire.endpoints import GraphNode
    from coframe.wire.graph import NodeInfo
    from coframe.wire.names import Endpoint
    from coframe.wire.request_header import RequestHeader

EndpointT = TypeVar("EndpointT")

_GRAPH_TYPE = "rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_"


class DdsServiceReader(_core.Reader):
    """A reader of requests or replies. Implements `coframe.wire._backend.BackendServiceReader`."""

    def reject(self, header: RequestHeader) -> None:
        """Do nothing: DDS stores no requests."""


class DdsSession:
    """A DDS participant. Implements `coframe.wire._backend.Session`.

    Args:
        domain: The domain ID.
        changed: Set when the graph may have changed.

    Attributes:
        native: The participant.
        graph: The nodes and endpoints of the domain.
        gid_size: The size of the identifiers that the graph messages of this process contain, in bytes.

    Raises:
        WireError: There is no usable DDS library, an environment variable has an invalid value, or DDS cannot create
            the participant.
    """

    def __init__(self, domain: int, changed: _core.Event) -> None:
        library.load()
        self.native = participants.join(domain, config.cyclone_config(), participant_user_data())
        self._announcements = Announcements(self.native, repeated=config.reaches_other_machines())
        self.gid_size = self._preferred_gid_size = gid_size(os.environ)
        self._announced: list[NodeInfo] = []
        self._is_published = True  # whether the published state of this process's nodes is current
        self._info_writer = _core.Writer(
            self.native.entity, create_topic(self.native.entity, TOPIC, _GRAPH_TYPE), native_qos(GRAPH_WRITER), ADAPTS
        )
        self.graph = DdsGraph(self.native.entity, create_topic(self.native.entity, TOPIC, _GRAPH_TYPE), changed)

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
        partitions = SERVICE_PARTITIONS if endpoint.kind == "request" and uses_service_partitions(qos) else ()
        return self._create(
            endpoint,
            lambda topic, data: _core.Writer(
                self.native.entity, topic, native_qos(qos, partitions), data, checked, on_change
            ),
            user_data,
        )

    def reader(self, node: GraphNode, endpoint: Endpoint, qos: QoS, on_data: _core.Event | None) -> _core.Reader:
        """Create a reader that queues messages."""
        del node
        return self._create(
            endpoint, lambda topic, data: _core.Reader(self.native.entity, topic, native_qos(qos), data, on_data)
        )

    def service_reader(
        self, node: GraphNode, endpoint: Endpoint, qos: QoS, on_data: _core.Event | None
    ) -> DdsServiceReader:
        """Create a reader that queues requests or replies."""
        del node
        profile = native_qos(qos, SERVICE_PARTITIONS)
        return self._create(
            endpoint, lambda topic, data: DdsServiceReader(self.native.entity, topic, profile, data, on_data)
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
        self._announced = [node.info() for node in nodes]
        self._publish_nodes()

    def repeat_announcement(self) -> int:
        """Announce this process again if the network may have lost the first announcements."""
        if not self._is_published:
            self._publish_nodes()
        return self._announcements.send_due()

    def adapt(self) -> str:
        """Publish the nodes of this process in the form that the other participants can read."""
        others = self.graph.gid_sizes()
        size = choose_gid_size(self._preferred_gid_size, others)
        if size != self.gid_size:
            self.gid_size = size
            self._publish_nodes()
        return unseen_text(size, others)

    def close(self) -> None:
        """Leave the domain."""
        self._info_writer.close()
        self.graph.close()
        self.native.close()

    def _publish_nodes(self) -> None:
        try:
            self._info_writer.write(encode_info(self.native.guid, self._announced, self.gid_size))
            self._is_published = True
        except _core.EndpointError:
            # A node must be able to shut down while the clock is wrong. The next announcement contains all nodes.
            self._is_published = False
            if clock_fault() is None:
                raise

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
