# SPDX-License-Identifier: Apache-2.0
"""The membership of this process in a ROS domain over Zenoh."""

from __future__ import annotations

import itertools
import logging
import os
import threading
import weakref
from typing import TYPE_CHECKING, Any, Final, TypeVar

from coframe._output.escaping import display_name
from coframe.errors import WireError
from coframe.time import SECOND
from coframe.wire import _descriptors
from coframe.wire.names import check_name
from coframe.wire.type_hashes import type_hash_of_name
from coframe.wire.zenoh import _keys, _library, _tokens, config, connecting
from coframe.wire.zenoh._endpoint import Place, ZenohEndpoint
from coframe.wire.zenoh._graph import ZenohGraph
from coframe.wire.zenoh._identity import Identity
from coframe.wire.zenoh._large_types import has_unbounded_bytes
from coframe.wire.zenoh._readers import ZenohReader, ZenohTap, ZenohTfReader
from coframe.wire.zenoh._services import ReplyReader, ReplyWriter, RequestReader, RequestWriter, ServiceTable
from coframe.wire.zenoh._tokens import NodeToken
from coframe.wire.zenoh._writer import ZenohWriter

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from coframe import _core
    from coframe.buffer.buffer import Buffer
    from coframe.wire._backend import (
        BackendReader,
        BackendServiceReader,
        BackendServiceWriter,
        BackendWriter,
        QueueLimits,
    )
    from coframe.wire.endpoints import GraphNode
    from coframe.wire.names import Endpoint
    from coframe.wire.qos import QoS

_RESERVED_CHARACTERS: Final = frozenset("*$?#")
_DESCRIPTORS: Final = 64  # Zenoh uses about 20, and ends the process if it gets none

OpenedT = TypeVar("OpenedT", bound=ZenohEndpoint)

_logger = logging.getLogger("coframe.wire")


class ZenohSession:
    """A Zenoh session. Implements `coframe.wire._backend.Session`.

    Args:
        domain: The domain ID.
        changed: Set when the graph may have changed.

    Raises:
        WireError: Zenoh is not installed, its configuration is not valid, or a client finds no router.
    """

    def __init__(self, domain: int, changed: _core.Event) -> None:
        self._error = _library.load().ZError
        self._domain = domain
        _descriptors.check(_DESCRIPTORS, "Zenoh", domain)
        self._session: Any = connecting.open_session()
        self._zid = str(self._session.info.zid())
        self._counter = itertools.count()  # counter for nodes and endpoints
        self._lock = threading.RLock()
        self._nodes: dict[GraphNode, NodeToken] = {}
        self._identities: dict[bytes, Identity] = {}  # by the identifier of the endpoint
        self._endpoints: weakref.WeakSet[ZenohEndpoint] = weakref.WeakSet()
        self._declared: dict[str, Any] = {}  # the tokens of this process
        self._announced: set[bytes] = set()  # the identifiers of the announced endpoints
        self._services = ServiceTable()
        try:
            self.graph = ZenohGraph(self._session, domain, changed)
        except BaseException:
            self._session.close()  # type: ignore[no-untyped-call] # an open session would keep the process alive
            raise

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
        """Create a publisher."""
        type_hash = self._required_hash(endpoint)
        identity = self._identify(node, _tokens.PUBLISHER, endpoint, type_hash, qos, user_data=user_data)
        place = self._place(endpoint, type_hash, identity.gid)
        return self._open_endpoint(endpoint, lambda: ZenohWriter(place, qos, checked=checked, on_change=on_change))

    def service_writer(
        self, node: GraphNode, endpoint: Endpoint, qos: QoS, user_data: str = ""
    ) -> BackendServiceWriter:
        """Create a publisher of requests or replies."""
        del user_data  # Zenoh itself connects a reply with its request
        type_hash = self._required_hash(endpoint)
        if endpoint.kind == "reply":
            place = self._place(endpoint, type_hash, os.urandom(16))
            return self._open_endpoint(endpoint, lambda: ReplyWriter(place, self._services))
        identity = self._identify(node, _tokens.CLIENT, endpoint, type_hash, qos)
        place = self._place(endpoint, type_hash, identity.gid)
        return self._open_endpoint(endpoint, lambda: RequestWriter(place, self._services))

    def reader(self, node: GraphNode, endpoint: Endpoint, qos: QoS, on_data: _core.Event | None) -> BackendReader:
        """Create a subscription that queues messages."""
        place = self._subscription_place(node, endpoint, qos)
        return self._open_endpoint(endpoint, lambda: ZenohReader(place, qos, on_data))

    def service_reader(
        self, node: GraphNode, endpoint: Endpoint, qos: QoS, on_data: _core.Event | None, user_data: str = ""
    ) -> BackendServiceReader:
        """Create a subscription that queues requests or replies."""
        del user_data
        type_hash = self._required_hash(endpoint)
        if endpoint.kind == "reply":
            place = self._place(endpoint, type_hash, os.urandom(16))
            return self._open_endpoint(endpoint, lambda: ReplyReader(place, qos, on_data, self._services))
        identity = self._identify(node, _tokens.SERVICE, endpoint, type_hash, qos)
        place = self._place(endpoint, type_hash, identity.gid)
        return self._open_endpoint(endpoint, lambda: RequestReader(place, qos, on_data, self._services))

    def tap(self, node: GraphNode, endpoint: Endpoint, qos: QoS, limits: QueueLimits) -> ZenohTap:
        """Create a subscription that records messages."""
        place = self._subscription_place(node, endpoint, qos)
        return self._open_endpoint(endpoint, lambda: ZenohTap(place, qos, limits))

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
    ) -> ZenohTfReader:
        """Create a subscription that stores transforms."""
        place = self._subscription_place(node, endpoint, qos)
        return self._open_endpoint(
            endpoint,
            lambda: ZenohTfReader(
                place, qos, buffer, static=static, authority=authority, renaming=renaming, on_data=on_data
            ),
        )

    def announce(self, nodes: Sequence[GraphNode]) -> None:
        """Declare the tokens of the nodes of this process and their endpoints, and undeclare outdated ones."""
        with self._lock:
            self._nodes = {node: self._node_token(node) for node in nodes}
            wanted = dict.fromkeys(token.text for token in self._nodes.values())
            open_endpoints = {local.guid for node in nodes for local in node.endpoints}
            for node, token in self._nodes.items():
                for local in node.endpoints:
                    identity = self._identities.get(local.guid)
                    if identity is not None:
                        wanted |= dict.fromkeys(identity.tokens(token, self._counter))
            for text in self._declared.keys() - wanted.keys():
                self._declared.pop(text).undeclare()
                self.graph.add_own(text, declared=False)
            for text in wanted.keys() - self._declared.keys():
                self._declared[text] = self._session.liveliness().declare_token(text)
                self.graph.add_own(text, declared=True)
            self._forget_closed(open_endpoints)

    def repeat_announcement(self) -> int:
        """Do nothing: Zenoh retransmits lost data."""
        return SECOND

    def adapt(self) -> str:
        """Update the status of the endpoints, and announce those whose type has become known."""
        with self._lock:
            endpoints = list(self._endpoints)
            unknown = [known for known in self._identities.values() if known.type_hash == _keys.ANY_HASH]
            for identity in unknown:
                identity.type_hash = self.graph.known_hash(identity.endpoint) or _keys.ANY_HASH
            if any(identity.type_hash != _keys.ANY_HASH for identity in unknown):
                self.announce(list(self._nodes))
        for endpoint in endpoints:
            endpoint.update_matched()
        return ""

    def close(self) -> None:
        """Leave the domain."""
        self.graph.close()
        self._session.close()

    def _subscription_place(self, node: GraphNode, endpoint: Endpoint, qos: QoS) -> Place:
        """Return the context of a subscription. If its type is unknown, it receives every definition of the type."""
        _check_names(endpoint)
        type_hash = self._hash_of(endpoint)
        if not type_hash:
            _logger.warning(
                "The definition of %s on %s is unknown, so messages of any definition are received. Other nodes see "
                "this subscription once the type is published.",
                endpoint.ros_type,
                endpoint.name,
            )
            type_hash = _keys.ANY_HASH
        buffers = not qos.transient_local and has_unbounded_bytes(endpoint.ros_type)
        identity = self._identify(node, _tokens.SUBSCRIPTION, endpoint, type_hash, qos, buffers=buffers)
        place = self._place(endpoint, type_hash, identity.gid)
        if buffers:
            place.key_list.append(f"{place.key_list[0]}/{_keys.BUFFER_SUFFIX}")
        return place

    def _place(self, endpoint: Endpoint, type_hash: str, gid: bytes) -> Place:
        key = _keys.data_key(self._domain, endpoint, type_hash)
        return Place(self._session, self.graph, [key], endpoint, type_hash, gid)

    def _identify(
        self,
        node: GraphNode,
        kind: str,
        endpoint: Endpoint,
        type_hash: str,
        qos: QoS,
        *,
        buffers: bool = False,
        user_data: str = "",
    ) -> Identity:
        with self._lock:
            token, number = self._node_token(node), next(self._counter)
            identity = Identity(token, number, kind, endpoint, type_hash, qos, buffers=buffers, user_data=user_data)
            self._identities[identity.gid] = identity
            return identity

    def _node_token(self, node: GraphNode) -> NodeToken:
        if node not in self._nodes:
            self._nodes[node] = NodeToken(self._domain, self._zid, next(self._counter), node.namespace, node.name)
        return self._nodes[node]

    def _hash_of(self, endpoint: Endpoint) -> str:
        """Return the hash of a type: from its definition, or from other nodes that use it, or "" if it is unknown."""
        return type_hash_of_name(_keys.interface(endpoint)) or self.graph.known_hash(endpoint)

    def _required_hash(self, endpoint: Endpoint) -> str:
        _check_names(endpoint)
        if type_hash := self._hash_of(endpoint):
            return type_hash
        raise WireError(
            f"The endpoint on {endpoint.name} needs the definition of {_keys.interface(endpoint)}, which is unknown: "
            "over Zenoh, the hash of the definition is part of the address.",
            hint="Add the interface file (see docs/how-to/own-messages.md), or use DDS: COFRAME_WIRE=dds.",
        )

    def _open_endpoint(self, endpoint: Endpoint, make: Callable[[], OpenedT]) -> OpenedT:
        try:
            opened = make()
        except self._error as error:
            raise WireError(
                f"Zenoh cannot create an endpoint on {endpoint.name}: {config.reason_of(error)}.",
                hint="Check that the participant is not closed, and the name of the topic.",
            ) from error
        self._endpoints.add(opened)
        return opened

    def _forget_closed(self, open_endpoints: set[bytes]) -> None:
        """Remove the identities of announced endpoints that are closed."""
        closed = self._announced - open_endpoints
        for guid in closed:
            self._identities.pop(guid, None)
        self._announced = open_endpoints


def _check_names(endpoint: Endpoint) -> None:
    """Raise a WireError if the name of the topic or the type cannot be announced over Zenoh."""
    for name in (endpoint.dds_topic, endpoint.dds_type):
        check_name(name)
        if found := _RESERVED_CHARACTERS.intersection(name):
            raise WireError(
                f"The name {display_name(name)!r} contains {min(found)!r}, which has a special meaning in Zenoh.",
                hint="Choose another name.",
            )
