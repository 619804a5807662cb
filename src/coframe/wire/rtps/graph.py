# SPDX-License-Identifier: Apache-2.0
"""The ROS graph from the topic ros_discovery_info and DDS discovery."""

from __future__ import annotations

from collections import OrderedDict
from typing import TYPE_CHECKING, Any, Protocol

from coframe.wire import names, vendors
from coframe.wire.graph import DiscoveredEndpoint, Graph, NodeInfo
from coframe.wire.qos import QoS
from coframe.wire.rtps.clients import receives_replies
from coframe.wire.rtps.discovery_info import ADAPTS, TOPIC, decode_info
from coframe.wire.rtps.user_data import REQUESTS_HISTORY, type_hash_of

if TYPE_CHECKING:
    from collections.abc import Collection, Sequence

    from coframe.wire._backend import BackendReader
    from coframe.wire._endpoint_table import EndpointTable

MAX_DEPARTED_WRITERS = 1_000  # remembered after they have left, because their requests may still be queued

_BATCH = 256  # messages
_ENCLAVE_KEY = b"enclave="  # in the user data of every participant of ROS
_PARTICIPANT = slice(4, 20)  # of a message on the topic ros_discovery_info
_HIDDEN = REQUESTS_HISTORY.encode()


class EndpointReader(Protocol):
    """Receives the writers, readers or participants that DDS discovery finds, including those of this process."""

    def take(self) -> list[tuple[Any, ...]]:
        """Return the changes since the last call. See `_core.EndpointReader.take`."""

    def close(self) -> None:
        """Stop."""


class DdsGraph(Graph):
    """The graph of a DDS domain.

    Args:
        participant: The GUID of the participant of this process.
        info_reader: Receives the messages on the topic ros_discovery_info.
        writer_reader: Receives the writers found by discovery.
        reader_reader: Receives the readers found by discovery.
        participant_reader: Receives the participants found by discovery. If None, `unnamed_participants` is empty.
    """

    def __init__(
        self,
        participant: bytes,
        info_reader: BackendReader,
        writer_reader: EndpointReader,
        reader_reader: EndpointReader,
        participant_reader: EndpointReader | None = None,
    ) -> None:
        super().__init__()
        self._own = participant
        self._own_nodes: Sequence[NodeInfo] | None = None  # since the last refresh
        self._info_reader = info_reader
        self._writer_reader = writer_reader
        self._reader_reader = reader_reader
        self._participant_reader = participant_reader
        self._participants: dict[int, tuple[bytes, bool]] = {}  # by handle: the GUID, and whether it is one of ROS
        self._gid_sizes: dict[bytes, int] = {}  # by participant
        # Writers that send requests in another form.
        self._departed_endpoints: OrderedDict[int, DiscoveredEndpoint] = OrderedDict()

    def close(self) -> None:
        """Close the discovery readers. The state remains available."""
        for reader in (self._info_reader, self._writer_reader, self._reader_reader, self._participant_reader):
            if reader is not None:
                reader.close()

    def set_own_nodes(self, nodes: Sequence[NodeInfo]) -> None:
        """Set the nodes of this process. Its own messages about them are not read."""
        with self._lock:
            self._own_nodes = nodes

    def foreign_services(self, peer: DiscoveredEndpoint) -> str:
        """Return the DDS implementation of an endpoint if it sends requests in another form, or "" if not."""
        if vendors.shares_services(peer.guid, peer.partitions):
            return ""
        return vendors.vendor(peer.guid) or vendors.unknown_vendor(peer.guid)

    def ignores_requests(self, peer: DiscoveredEndpoint, qos: QoS) -> bool:
        """Return whether the partitions of request writers do not match those of a reader."""
        return vendors.uses_service_partitions(qos) and vendors.ignores_service_partitions(peer.guid, peer.partitions)

    def foreign_writer(self, handle: int) -> str:
        """Return what `foreign_services` returns for a writer, even after it has left."""
        writer = self.writer(handle) or self._departed_endpoints.get(handle)
        return "" if writer is None else self.foreign_services(writer)

    def has_matched_client(self, readers: Collection[int], writer: int) -> bool:
        """Return whether the subscription to replies of a client is among some readers.

        Args:
            readers: The handles of the readers.
            writer: The handle of the client's writer of requests.
        """
        client = self.writer(writer)
        if not all(handle in self._readers for handle in readers):
            self.refresh()
        with self._lock:
            found = [reader for handle in readers if (reader := self._readers.get(handle)) is not None]
        understanding = (reader for reader in found if not self.foreign_services(reader))
        return receives_replies(understanding, client)

    def gid_sizes(self) -> dict[int, list[str]]:
        """Return the sizes of identifiers that participants of other implementations publish, with their nodes."""
        with self._lock:
            adapting = {
                writer.participant
                for writer in self._writers.on_topic(TOPIC).values()
                if ADAPTS.encode() in writer.user_data
            }
            found: dict[int, list[str]] = {}
            for participant, size in self._gid_sizes.items():
                if participant not in adapting:
                    nodes = self._nodes[participant]
                    found.setdefault(size, []).extend(names.full_name(node.namespace, node.name) for node in nodes)
        return found

    def participants(self) -> set[bytes]:
        """Return the GUIDs of all participants, without processing discovery messages."""
        with self._lock:
            return {guid for guid, _ in self._participants.values()}

    def unnamed_participants(self) -> list[str]:
        """Return the DDS implementations of the participants of ROS whose nodes are not known yet."""
        self.refresh()
        with self._lock:
            guids = [guid for guid, is_ros in self._participants.values() if is_ros and guid not in self._nodes]
        return [vendors.vendor(guid) or vendors.unknown_vendor(guid) for guid in guids]

    def all_writers(self) -> dict[int, DiscoveredEndpoint]:
        """Return the writers of all topics by their handles, without processing discovery messages."""
        with self._lock:
            return self._writers.copy()

    def read_history(self, participant: bytes) -> set[tuple[str, str]]:
        """Return the DDS topics, with their types, on which a participant has transient-local readers."""
        with self._lock:
            return {
                (reader.topic, reader.type)
                for reader in self._readers
                if reader.participant == participant and reader.qos.transient_local
            }

    def _take_changes(self) -> bool:
        # Nodes are read before endpoints: if a participant leaves in between, its endpoints remove the nodes.
        changed = self._take_info()
        changed |= self._take_endpoints(self._writer_reader, self._writers)
        changed |= self._take_endpoints(self._reader_reader, self._readers)
        changed |= self._take_participants()
        if changed:
            self._remove_departed()
        return changed

    def _take_info(self) -> bool:
        changed = self._own_nodes is not None
        if self._own_nodes is not None:
            self._set_nodes(self._own, self._own_nodes)
            self._own_nodes = None
        while messages := self._info_reader.take(_BATCH):
            for message, _, _ in messages:
                if message[_PARTICIPANT] != self._own and (info := decode_info(message)) is not None:
                    self._set_nodes(info.participant, info.nodes)
                    self._gid_sizes[info.participant] = info.gid_size
                    changed = True
        return changed

    def _take_endpoints(self, reader: EndpointReader, known: EndpointTable) -> bool:
        changed = False
        for handle, alive, guid, participant, topic, type_name, (
            depth,
            *policies,
        ), user_data, partitions in reader.take():
            if user_data == _HIDDEN or (not alive and handle not in known):
                continue
            changed = True
            if alive:
                qos = QoS(max(depth, 1), *policies)
                endpoint = DiscoveredEndpoint(
                    guid, participant, topic, type_name, qos, user_data, type_hash_of(user_data), partitions
                )
                known.store(handle, endpoint)
                continue
            if known is not self._writers:
                known.remove(handle)
                continue
            departed = self._remove_writer(handle)
            if departed is not None and self.foreign_services(departed):
                self._departed_endpoints[handle] = departed
                if len(self._departed_endpoints) > MAX_DEPARTED_WRITERS:
                    self._departed_endpoints.popitem(last=False)
        return changed

    def _take_participants(self) -> bool:
        changes = [] if self._participant_reader is None else self._participant_reader.take()
        for handle, alive, guid, *_, user_data, _ in changes:
            if alive:
                self._participants[handle] = guid, _ENCLAVE_KEY in user_data
            else:
                self._participants.pop(handle, None)
        return bool(changes)

    def _remove_departed(self) -> None:
        participants = {writer.participant for writer in self._writers.on_topic(TOPIC).values()}
        for guid in self._nodes.keys() - participants - {self._own}:
            self._set_nodes(guid, None)
        self._gid_sizes = {guid: size for guid, size in self._gid_sizes.items() if guid in participants}
