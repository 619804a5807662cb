# SPDX-License-Identifier: Apache-2.0
"""The membership of this process in a DDS domain over Fast DDS."""

from __future__ import annotations

import logging
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any, Final, TypeVar

from coframe import _core
from coframe.errors import WireError
from coframe.time import SECOND
from coframe.wire import _descriptors as descriptors
from coframe.wire.names import check_name
from coframe.wire.qos import GRAPH_READER, GRAPH_WRITER, QoS, for_service_reader
from coframe.wire.rtps.announcer import NodeAnnouncer
from coframe.wire.rtps.discovery_info import ADAPTS, ROS_TYPE, TOPIC, TYPE
from coframe.wire.rtps.user_data import endpoint_user_data
from coframe.wire.vendors import HEADER_PARTITIONS
from coframe_fastdds import _config as config
from coframe_fastdds import _fastdds as native
from coframe_fastdds import _security as security
from coframe_fastdds._graph import FastDdsGraph
from coframe_fastdds._ignored import IgnoredMessages
from coframe_fastdds._services import (
    PLAIN_LATENCY_BUDGET,
    ReplyReader,
    ReplyWriter,
    RequestReader,
    RequestWriter,
    Services,
)
from coframe_fastdds._tf_reader import FastDdsTfReader

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from coframe.buffer.buffer import Buffer
    from coframe.wire._backend import (
        BackendReader,
        BackendServiceReader,
        BackendServiceWriter,
        BackendTap,
        BackendWriter,
        QueueLimits,
    )
    from coframe.wire.endpoints import GraphNode
    from coframe.wire.names import Endpoint

EndpointT = TypeVar("EndpointT")

_logger = logging.getLogger("coframe.wire")

_DESCRIPTORS: Final = 32
_KEEP_ALL: Final = 5000  # messages, the default of Fast DDS


class FastDdsSession:
    """A participant of Fast DDS. Implements `coframe.wire._backend.Session`.

    Args:
        domain: The domain ID.
        changed: Set when the graph may have changed.

    Raises:
        WireError: An environment variable has an invalid value, or Fast DDS cannot create the participant.
    """

    def __init__(self, domain: int, changed: _core.Event) -> None:
        settings = config.read()
        self.native = _join(domain, settings, changed)
        self._announcer = NodeAnnouncer(
            self.native.guid,
            native.Writer(self.native, TOPIC, TYPE, native_qos(GRAPH_WRITER), endpoint_user_data(ROS_TYPE, ADAPTS)),
        )
        info_reader = native.Reader(
            self.native, TOPIC, TYPE, native_qos(GRAPH_READER), endpoint_user_data(ROS_TYPE), changed
        )
        self.graph = FastDdsGraph(self.native, info_reader, has_server=bool(settings.server))
        self._services = Services()
        self._nodes: list[GraphNode] = []
        self._ignored = IgnoredMessages(_logger.warning)

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
        """Create a writer."""
        del node
        return self._create(native.Writer, endpoint, native_qos(qos), checked, on_change, user_data=user_data)

    def reader(self, node: GraphNode, endpoint: Endpoint, qos: QoS, on_data: _core.Event | None) -> BackendReader:
        """Create a reader that queues messages."""
        del node
        return self._create(native.Reader, endpoint, native_qos(qos), on_data)

    def service_reader(
        self, node: GraphNode, endpoint: Endpoint, qos: QoS, on_data: _core.Event | None, user_data: str = ""
    ) -> BackendServiceReader:
        """Create a reader that queues requests or replies."""
        profile = native_qos(for_service_reader(qos), HEADER_PARTITIONS)
        if endpoint.kind == "request":
            clients = self._services.clients(endpoint.name)
            return self._create(partial(RequestReader, clients), endpoint, profile, on_data, user_data=user_data)
        pending = self._services.pending(endpoint.name)
        reader = self._create(partial(ReplyReader, pending), endpoint, profile, on_data, user_data=user_data)
        pending.offer_reader(node, reader)
        return reader

    def tap(self, node: GraphNode, endpoint: Endpoint, qos: QoS, limits: QueueLimits) -> BackendTap:
        """Create a reader that records messages."""
        del node
        return self._create(native.Tap, endpoint, native_qos(qos), *limits)

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
    ) -> FastDdsTfReader:
        """Create a reader that stores transforms on the threads of Fast DDS."""
        del node
        store = _core.TransformStore(buffer, static, authority, renaming, on_data)
        return self._create(partial(FastDdsTfReader, store), endpoint, native_qos(qos), store, on_data)

    def announce(self, nodes: Sequence[GraphNode]) -> None:
        """Publish the nodes of this process with their endpoints."""
        self._nodes = list(nodes)
        described = [info for node in nodes if (info := node.info()) is not None]
        self.graph.set_own_nodes(described)
        self._announcer.announce(described)

    def repeat_announcement(self) -> int:
        """Publish the nodes again if that failed. Fast DDS itself repeats the announcement of the participant."""
        self._announcer.repeat()
        self._ignored.add(self.native.take_ignored())
        return SECOND

    def adapt(self) -> str:
        """Adapt nodes and services to the forms that the other participants can read."""
        if self._services.adapt():
            for node in self._nodes:
                node.endpoints_changed()
            self.announce(self._nodes)
        return self._announcer.adapt(self.graph)

    def close(self) -> None:
        """Leave the domain."""
        self._announcer.close()
        self.graph.close()
        self.native.close()

    def service_writer(
        self, node: GraphNode, endpoint: Endpoint, qos: QoS, user_data: str = ""
    ) -> BackendServiceWriter:
        """Create a publisher of requests or replies."""
        # A reader that refuses the plain writer never acknowledges its messages, and would block one that keeps all.
        kept = replace(qos, keep_all=False, depth=_KEEP_ALL) if qos.keep_all else qos

        def make_writer(with_header: bool) -> native.Writer:
            profile = native_qos(kept, HEADER_PARTITIONS) if with_header else native_qos(kept, (), PLAIN_LATENCY_BUDGET)
            return self._create(native.Writer, endpoint, profile, user_data=user_data)

        writer: RequestWriter | ReplyWriter
        if endpoint.kind == "request":
            pending = self._services.pending(endpoint.name)
            writer = RequestWriter(endpoint, self.graph, make_writer, pending, pending.take_reader(node))
        else:
            writer = ReplyWriter(endpoint, self.graph, make_writer, self._services.clients(endpoint.name))
        self._services.writers.add(writer)
        return writer

    def _create(
        self,
        make: Callable[..., EndpointT],
        endpoint: Endpoint,
        qos: tuple[Any, ...],
        *arguments: object,
        user_data: str = "",
    ) -> EndpointT:
        """Create an endpoint with `make(participant, topic, type, quality of service, user data, *arguments)`."""
        data = endpoint_user_data(endpoint.ros_type, user_data)
        for name in (endpoint.dds_topic, endpoint.dds_type):
            check_name(name)
        try:
            return make(self.native, endpoint.dds_topic, endpoint.dds_type, qos, data, *arguments)
        except _core.EndpointError as error:
            raise WireError(
                f"Fast DDS cannot create an endpoint on {endpoint.name}: {error}.",
                hint="Use one type for each topic in a process, and check that the participant is not closed.",
            ) from error


def native_qos(qos: QoS, partitions: Sequence[str] = (), latency_budget: int = 0) -> tuple[Any, ...]:
    """Return the quality of service as arguments of the native code.

    Args:
        qos: The quality of service.
        partitions: The partitions of the endpoint. If there are none, it is in the default partition.
        latency_budget: The latency budget in nanoseconds.
    """
    return (
        qos.depth,
        qos.reliable,
        qos.transient_local,
        qos.keep_all,
        qos.manual_liveliness,
        qos.deadline,
        qos.lifespan,
        qos.lease,
        list(partitions),
        latency_budget,
    )


def _join(domain: int, settings: config.Config, changed: _core.Event) -> native.Participant:
    descriptors.check(_DESCRIPTORS, "Fast DDS", domain)
    try:
        return native.Participant(
            domain=domain,
            name=settings.enclave,
            user_data=f"enclave={settings.enclave};",
            discovery_range="SYSTEM_DEFAULT" if settings.server else settings.range,
            peers=config.addresses(settings.peers),
            profiles=settings.profiles,
            qos_from_profiles=settings.qos_from_profiles,
            asynchronous=settings.asynchronous,
            properties=list(settings.properties),
            changed=changed,
        )
    except _core.EndpointError as error:
        if settings.properties:
            raise WireError(
                f"Joining domain {domain} with the enclave {settings.enclave} failed: {error}.",
                hint="Check its files: whether they belong together, are still valid, and allow this domain. They are "
                f"in {security.folder_of(settings.properties)}.",
            ) from error
        raise WireError(
            f"Joining domain {domain} failed: {error}.",
            hint="Fast DDS wrote the reason to stderr. Check the variables that configure it.",
        ) from error
