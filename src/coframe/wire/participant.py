"""One membership in the ROS graph for each process and domain, shared by all its nodes."""

from __future__ import annotations

import atexit
import logging
import os
import threading
from typing import TYPE_CHECKING, Any, ClassVar

from coframe import _core
from coframe.errors import WireError
from coframe.tf_publishers import OnceEach
from coframe.wire import config, dds, names, types
from coframe.wire.discovery_info import MAX_NAME, TOPIC, encode_info, gid_size
from coframe.wire.endpoints import (
    GraphNode,
    Publisher,
    RawPublisher,
    Subscription,
    Tap,
    TfReader,
    WireEndpoint,
    initial_authority,
)
from coframe.wire.graph import DdsEndpoint, Endpoint, Graph
from coframe.wire.mismatch import MismatchWatch
from coframe.wire.qos import GRAPH_WRITER, TF, TF_STATIC_READER, QoS
from coframe.wire.refusals import RefusalWatch
from coframe.wire.statics import StaticTopic, StaticWriter

if TYPE_CHECKING:
    from collections.abc import Callable

    from coframe import Buffer
    from coframe.tf_publishers import TfPublisher
    from coframe.wire.names import Kind

_logger = logging.getLogger("coframe.wire")

_TF_TYPE = "tf2_msgs/msg/TFMessage"
_ENCLAVE = "enclave=/;"  # what ROS participants say of themselves
_CHECK_PERIOD_NS = 1_000_000_000


class Participant:
    """A process's membership in a DDS domain. Got by `get`, given back by `close`; all methods are thread-safe."""

    _instances: ClassVar[dict[int, Participant]] = {}
    _instances_lock: ClassVar[threading.RLock] = threading.RLock()

    def __init__(self, domain_id: int) -> None:
        dds.load()
        self.domain_id = domain_id
        self._process = os.getpid()
        self._references = 0
        self._native = dds.join(domain_id, config.cyclone_config(), _ENCLAVE)
        self._lock = threading.RLock()
        self._topics: dict[tuple[str, str], int] = {}
        self._unchecked_topics: dict[tuple[str, str], int] = {}
        self._nodes: list[GraphNode] = []
        self._statics: dict[str, StaticTopic] = {}
        self._gid_size = gid_size(os.environ)

        graph_topic = self._topic(TOPIC, types.graph_type())
        self._info_writer = _core.Writer(self._native.entity, graph_topic, _native_qos(GRAPH_WRITER), "")
        self._wake = _core.Event()
        self._graph = Graph(self._native.entity, graph_topic, self._wake)
        self._mismatches = MismatchWatch(self._graph, self._warn)
        self._refusals = RefusalWatch(self._graph, self._warn)
        self._odd_names = OnceEach(self._warn)
        self._watchers: list[_core.Event] = []
        self._warning_callbacks: list[Callable[[str], None]] = []
        self._ending = False
        self._thread = threading.Thread(target=self._keep_house, name=f"coframe-wire-{domain_id}", daemon=True)
        self._thread.start()

    @classmethod
    def get(cls, domain_id: int | None = None) -> Participant:
        """This process's participant in a domain; each call is given back by one `close`.

        Args:
            domain_id: 0 to 232; None: ROS_DOMAIN_ID, or 0.

        Raises:
            WireError: cyclonedds is missing, an environment variable holds nonsense, the domain is full, or this
                is a forked child of a process that had joined.
        """
        domain = config.domain_id() if domain_id is None else config.check_domain_id(domain_id)
        with cls._instances_lock:
            if any(joined.is_inherited() for joined in cls._instances.values()):
                raise WireError(
                    "This process was forked from one that had joined the ROS graph, and DDS does not survive that.",
                    hint="Start it by 'spawn': multiprocessing.set_start_method('spawn').",
                )
            participant = cls._instances.get(domain)
            if participant is None:
                participant = cls._instances[domain] = cls(domain)
            participant._references += 1
            return participant

    def close(self) -> None:
        """Gives one reference back. The last one ends all endpoints, the housekeeping thread and DDS's threads."""
        with self._instances_lock:
            self._references -= 1
            if self._references == 0 and self._process == os.getpid():
                self._end()

    def add_node(self, namespace: str, name: str) -> GraphNode:
        """Shows a node on the graph.

        Args:
            namespace: "/" or "/a/b".
            name: without a namespace.

        Raises:
            WireError: a name is too long for the graph, or the namespace is not absolute.
        """
        if not namespace.startswith("/"):
            raise WireError(f"Namespace {namespace!r} is not absolute.", hint=f"Write it as '/{namespace}'.")
        for text in (namespace, name):
            if len(text.encode()) > MAX_NAME:
                raise WireError(
                    f"The name {text[:20]!r}... has {len(text.encode())} bytes: the ROS graph takes {MAX_NAME}.",
                    hint="Choose a shorter one.",
                )
        node = GraphNode(self, namespace, name)
        with self._lock:
            self._nodes.append(node)
            self.announce()
        return node

    def remove_node(self, node: GraphNode) -> None:
        """Takes a node off the graph. `GraphNode.close` calls it."""
        with self._lock:
            if node in self._nodes:
                self._nodes.remove(node)
                self.announce()

    def publisher(
        self, node: GraphNode, topic: str, message_type: type, qos: QoS, *, kind: Kind = "topic", user_data: str = ""
    ) -> Publisher:
        """A publisher of `node`.

        Args:
            node: its node.
            topic: fully qualified: "/scan"; of a service for the kinds "request" and "reply".
            message_type: the message class. For requests and replies the caller writes ROS's 16-byte header
                (client's identifier, sequence number) between the encapsulation and the message.
            qos: what is offered.
            kind: "topic", "request" or "reply".
            user_data: what readers can learn of it from DDS, before the first message.

        Raises:
            WireError: DDS refuses.
        """
        of_transforms = types.ros_type(message_type) == _TF_TYPE
        name, type_name, entity = (
            self._unchecked_topic(topic, _TF_TYPE) if of_transforms else self._topic_of(topic, message_type, kind)
        )
        native = _create(
            lambda: _core.Writer(self._native.entity, entity, _native_qos(qos), user_data, of_transforms), topic
        )
        return Publisher(native, node, name, type_name, qos)

    def subscription(
        self,
        node: GraphNode,
        topic: str,
        message_type: type,
        qos: QoS,
        *,
        on_data: _core.Event | None = None,
        kind: Kind = "topic",
        adapts: bool = False,
    ) -> Subscription:
        """A subscription of `node`; the arguments are those of `publisher`.

        Args:
            node: its node.
            topic: fully qualified.
            message_type: the message class.
            qos: what is asked for.
            on_data: is set whenever messages arrive.
            kind: "topic", "request" or "reply".
            adapts: the caller follows what publishers offer, so that nobody is warned of those that offer less.

        Raises:
            WireError: DDS refuses.
        """
        name, type_name, entity = self._topic_of(topic, message_type, kind)
        native = _create(lambda: _core.Reader(self._native.entity, entity, _native_qos(qos), "", on_data), topic)
        return Subscription(native, node, name, type_name, qos, adapts=adapts)

    def raw_publisher(self, node: GraphNode, topic: str, ros_type: str, qos: QoS) -> RawPublisher:
        """A publisher of `node` for messages of any type, whose bytes it passes on as they are.

        Args:
            node: its node.
            topic: fully qualified: "/scan".
            ros_type: such as "sensor_msgs/msg/LaserScan"; nobody here needs to know it.
            qos: what is offered.

        Raises:
            WireError: DDS refuses.
        """
        name, type_name, entity = self._unchecked_topic(topic, ros_type)
        native = _create(lambda: _core.Writer(self._native.entity, entity, _native_qos(qos), "", True), topic)
        return RawPublisher(native, node, name, type_name, qos)

    def raw_subscription(
        self,
        node: GraphNode,
        topic: str,
        ros_type: str,
        qos: QoS,
        *,
        on_data: _core.Event | None = None,
        adapts: bool = False,
    ) -> Subscription:
        """A subscription of `node` to messages of any type, whose bytes nobody checks.

        Args:
            node: its node.
            topic: fully qualified: "/scan".
            ros_type: such as "sensor_msgs/msg/LaserScan"; nobody here needs to know it.
            qos: what is asked for.
            on_data: is set whenever messages arrive.
            adapts: the caller follows what publishers offer, so that nobody is warned of those that offer less.

        Raises:
            WireError: DDS refuses.
        """
        name, type_name, entity = self._unchecked_topic(topic, ros_type)
        native = _create(lambda: _core.Reader(self._native.entity, entity, _native_qos(qos), "", on_data), topic)
        return Subscription(native, node, name, type_name, qos, adapts=adapts)

    def tap(self, node: GraphNode, topic: str, ros_type: str, qos: QoS, *, head: int, capacity: int = 100_000) -> Tap:
        """A subscription of `node` that notes when messages of any type come, without Python.

        Args:
            node: its node.
            topic: fully qualified: "/scan".
            ros_type: such as "sensor_msgs/msg/LaserScan"; nobody here needs to know it.
            qos: what is asked for.
            head: so many bytes of each message are kept.
            capacity: so many messages may wait to be taken; others are counted only.

        Raises:
            WireError: DDS refuses.
        """
        name, type_name, entity = self._unchecked_topic(topic, ros_type)
        native = _create(lambda: _core.Tap(self._native.entity, entity, _native_qos(qos), "", head, capacity), topic)
        return Tap(native, node, name, type_name, qos)

    def tf_reader(
        self,
        node: GraphNode,
        topic: str,
        buffer: Buffer,
        *,
        static: bool,
        qos: QoS | None = None,
        authority: str | None = "default_authority",
        renaming: _core.Renaming | None = None,
    ) -> TfReader:
        """A subscription of `node` that stores transforms in `buffer` as they arrive, without Python.

        Args:
            node: its node.
            topic: fully qualified: "/tf".
            buffer: where the transforms go.
            static: whether they hold for all times.
            qos: what is asked for; None: as tf2's listener.
            authority: what the buffer notes as their source; None: the name of the publishing node.
            renaming: what the frames are called in the buffer (`coframe.frame_names.renaming`); None: as they come.

        Raises:
            WireError: DDS refuses.
        """
        chosen = qos or (TF_STATIC_READER if static else TF)
        name, type_name, entity = self._unchecked_topic(topic, _TF_TYPE)
        source = initial_authority(authority)
        native = _create(
            lambda: _core.TfReader(
                self._native.entity, entity, _native_qos(chosen), "", buffer, static, source, renaming
            ),
            topic,
        )
        reader = TfReader(native, node, name, type_name, chosen, static=static, name_writers=authority is None)
        reader.name_writers(self._graph)
        self._refusals.add(reader, buffer)
        return reader

    def static_broadcaster(self, node: GraphNode, topic: str = "/tf_static") -> StaticWriter:
        """A writer of static transforms; all of this process on one topic share one DDS writer.

        A late joiner is given a writer's last message only: it must hold all static transforms of the process.

        Raises:
            WireError: DDS refuses.
        """
        with self._lock:
            shared = self._statics.get(topic)
            if shared is None or shared.closed:
                shared = self._statics[topic] = StaticTopic(self, topic)
            return shared.join(node)

    def nodes(self) -> list[tuple[str, str]]:
        """(namespace, name) of every node on the graph, our own among them."""
        return self._graph.nodes()

    def topics(self) -> dict[str, list[str]]:
        """The topics with their ROS types: {"/tf": ["tf2_msgs/msg/TFMessage"]}."""
        return self._graph.types(("topic",))

    def services(self) -> dict[str, list[str]]:
        """The services with the ROS types of their requests and replies, such as "std_srvs/srv/SetBool_Request"."""
        return self._graph.types(("request", "reply"))

    def publishers(self, topic: str, *, kind: Kind = "topic") -> list[Endpoint]:
        """Who publishes on a topic, by its ROS name."""
        return self._describe(self._graph.writers(names.dds_topic(topic, kind)))

    def published(self) -> dict[str, dict[int, Endpoint]]:
        """All topics that somebody publishes on, by their ROS names; the publishers by their handles, as of samples."""
        self._graph.refresh()
        found = {}
        for name, writers in self._graph.by_topic(writers=True).items():
            if (topic := names.ros_topic(name)) is not None:
                found[topic] = {handle: self._graph.describe(writer) for handle, writer in writers.items()}
        return found

    def subscribers(self, topic: str, *, kind: Kind = "topic") -> list[Endpoint]:
        """Who subscribes to a topic, by its ROS name."""
        return self._describe(self._graph.readers(names.dds_topic(topic, kind)))

    def tf_publishers(self, reader: TfReader) -> list[TfPublisher]:
        """Who was heard by a reader of transforms, also who has left."""
        return reader.publishers(self._graph)

    def writers(self, topic: str) -> dict[int, DdsEndpoint]:
        """The writers on a topic as DDS describes them, by the handles that their samples bear."""
        return self._graph.writers(names.dds_topic(topic))

    def writer_node(self, handle: int) -> str | None:
        """The full name of the node that wrote a sample, such as "/talker"; None if no node has claimed it."""
        return self._graph.writer_node(handle)

    def watch_graph(self, event: _core.Event) -> None:
        """Sets `event` whenever the graph has changed, until `unwatch_graph`."""
        with self._lock:
            self._watchers.append(event)

    def unwatch_graph(self, event: _core.Event) -> None:
        """Ends what `watch_graph` began."""
        with self._lock:
            self._watchers = [watcher for watcher in self._watchers if watcher is not event]

    def on_warning(self, callback: Callable[[str], None]) -> None:
        """Calls `callback`, on a thread of its own, with one sentence for each thing that is wrong on the wire.

        Without any callback the sentences go to the logger "coframe.wire".
        """
        with self._lock:
            self._warning_callbacks.append(callback)

    def announce(self) -> None:
        """Tells the graph about the nodes of this process and their endpoints."""
        with self._lock:
            if self._ending or self.is_inherited():
                return
            infos = [node.info() for node in self._nodes]
            self._info_writer.write(encode_info(self._native.guid, infos, self._gid_size))

    def is_inherited(self) -> bool:
        """Whether this process is a forked child, and the participant its parent's."""
        return self._process != os.getpid()

    def _topic_of(self, topic: str, message_type: type, kind: Kind) -> tuple[str, str, int]:
        """The DDS topic's name, its type's name, and its number."""
        name = names.dds_topic(topic, kind)
        data_type = types.dds_type(message_type, kind)
        return name, data_type.__idl_typename__, self._topic(name, data_type)

    def _topic(self, name: str, data_type: Any) -> int:
        key = (name, data_type.__idl_typename__)
        with self._lock:
            if key not in self._topics:
                self._topics[key] = types.create_topic(self._native.entity, name, data_type)
            return self._topics[key]

    def _unchecked_topic(self, topic: str, ros_type: str) -> tuple[str, str, int]:
        """As `_topic_of`, for those who check the bytes themselves, or only pass them on."""
        name, type_name = names.dds_topic(topic), names.dds_type(ros_type)
        with self._lock:
            if (name, type_name) not in self._unchecked_topics:
                entity = types.create_unchecked_topic(self._native.entity, name, type_name)
                self._unchecked_topics[name, type_name] = entity
            return name, type_name, self._unchecked_topics[name, type_name]

    def _describe(self, endpoints: dict[int, DdsEndpoint]) -> list[Endpoint]:
        return [self._graph.describe(endpoint) for endpoint in endpoints.values()]

    def _warn(self, text: str) -> None:
        with self._lock:
            callbacks = list(self._warning_callbacks)
        for callback in callbacks or [_logger.warning]:
            callback(text)

    def _endpoints(self) -> list[WireEndpoint]:
        with self._lock:
            return list({endpoint.guid: endpoint for node in self._nodes for endpoint in node.endpoints}.values())

    def _keep_house(self) -> None:
        seen = -1
        while not self._ending:
            try:
                version = self._graph.refresh()
                if version != seen:
                    self._graph_changed()
                if version != seen or self._mismatches.waiting:
                    self._mismatches.check(self._endpoints())
                seen = version
                listeners = [end for end in self._endpoints() if isinstance(end, TfReader)]
                self._refusals.check(listeners)
                self._tell_odd_names(listeners)
            except Exception:
                # A callback of the user's, or an endpoint that was closed meanwhile.
                if not self._ending:
                    _logger.exception("coframe's housekeeping of the ROS graph failed and goes on")
            self._wake.wait(_CHECK_PERIOD_NS)

    def _tell_odd_names(self, listeners: list[TfReader]) -> None:
        for listener in listeners:
            for publisher in listener.publishers(self._graph):
                for sentence in publisher.oddities:
                    self._odd_names(sentence, sentence)

    def _graph_changed(self) -> None:
        with self._lock:
            watchers = list(self._watchers)
        for event in watchers:
            event.set()
        for endpoint in self._endpoints():
            if isinstance(endpoint, TfReader):
                endpoint.name_writers(self._graph)

    def _end(self) -> None:
        del self._instances[self.domain_id]
        self._ending = True
        self._wake.set()
        if self._thread is not threading.current_thread():
            self._thread.join()
        for node in list(self._nodes):
            node.close()
        self._info_writer.close()
        self._graph.close()
        self._native.close()


def _native_qos(qos: QoS) -> _core.QosProfile:
    return _core.QosProfile(qos.depth, qos.reliable, qos.transient_local, qos.keep_all)


def _create(make: Callable[[], Any], topic: str) -> Any:
    try:
        return make()
    except _core.DdsError as error:
        raise WireError(f"DDS refuses {topic}: {error}.", hint="Has the participant been closed already?") from error


def _renew_locks() -> None:
    """In a forked child: whoever held them is not here to give them back."""
    Participant._instances_lock = threading.RLock()  # noqa: SLF001 - our own class
    for participant in Participant._instances.values():  # noqa: SLF001 - our own class
        participant._lock = threading.RLock()  # noqa: SLF001 - our own class


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_renew_locks)


@atexit.register
def _end_all() -> None:
    """DDS's threads must have ended before the interpreter does."""
    with Participant._instances_lock:  # noqa: SLF001 - our own class
        for participant in list(Participant._instances.values()):  # noqa: SLF001 - our own class
            if participant._process == os.getpid():  # noqa: SLF001 - our own class
                participant._end()  # noqa: SLF001 - our own class
