# SPDX-License-Identifier: Apache-2.0
"""The participant of this process in a ROS domain, shared by all its nodes."""

from __future__ import annotations

import atexit
import contextlib
import logging
import os
import signal
import threading
import time
from typing import TYPE_CHECKING, ClassVar, Final

from coframe import _core
from coframe._output.escaping import printable
from coframe._output.formatting import error_text
from coframe._output.warn_once import WarnOnce
from coframe.errors import WireError
from coframe.frame_names import naming_problems
from coframe.time import SECOND
from coframe.wire import domains, names, selection
from coframe.wire._endpoint_factory import EndpointFactory
from coframe.wire._graph_queries import GraphQueries
from coframe.wire._ignored_messages import IgnoredMessageMonitor
from coframe.wire._parameter_services import ParameterServices
from coframe.wire._rejected_transforms import RejectedTransformMonitor
from coframe.wire.endpoint_mismatch import MismatchMonitor
from coframe.wire.endpoints import GraphNode, LocalEndpoint
from coframe.wire.static_broadcaster import SharedStaticPublisher, StaticBroadcaster
from coframe.wire.system_clock import clock_fault
from coframe.wire.tf_reader import TfReader

if TYPE_CHECKING:
    from collections.abc import Callable


_logger = logging.getLogger("coframe.wire")

# The maintenance thread pauses for this many times as long as it worked. While many nodes or endpoints are created one
# after the other, it would otherwise examine all of them after each one.
_PAUSE_FACTOR: Final = 10
_MAX_PAUSE: Final = SECOND // 10


class Participant(EndpointFactory, GraphQueries):
    """The participant of this process in a ROS domain over a middleware. All methods are thread-safe.

    The participant is reference-counted: each call of `get` must be matched by a call of `close`.

    Attributes:
        domain_id: The ROS domain ID, as in ``ROS_DOMAIN_ID``.
        wire: The middleware, "dds" or "zenoh".
    """

    _instances: ClassVar[dict[tuple[str, int], Participant]] = {}
    _instances_lock: ClassVar[threading.RLock] = threading.RLock()

    def __init__(self, domain_id: int, wire: str) -> None:
        self.domain_id = domain_id
        self.wire = wire
        self._process = os.getpid()
        self._references = 0
        self._lock = threading.RLock()
        self._nodes: list[GraphNode] = []
        self._statics: dict[str, SharedStaticPublisher] = {}
        self._wake_event = _core.Event()
        self._end_of_pause = _core.Event()  # set when the participant is closed
        self._session = selection.join(wire, domain_id, self._wake_event)
        self._graph = self._session.graph
        self._mismatches = MismatchMonitor(self._graph, self._warn)
        self._rejections = RejectedTransformMonitor(self._graph, self._warn)
        self._ignored_messages = IgnoredMessageMonitor(self._warn)
        self._warn_once = WarnOnce(self._warn)
        self._parameter_services = ParameterServices(self)
        self._watchers: list[_core.Event] = []
        self._warning_callbacks: list[Callable[[str], None]] = []
        self._closing = False
        self._thread = threading.Thread(target=self._run_maintenance, name=f"coframe-wire-{domain_id}", daemon=True)
        self._thread.start()

    @classmethod
    def get(cls, domain_id: int | None = None, wire: str | None = None) -> Participant:
        """Return the participant of this process in a domain, and join the domain if necessary.

        A process may use several middlewares: it has one participant for each of them and for each domain.

        Args:
            domain_id: The domain, 0 to 232. If None, it is ROS_DOMAIN_ID, or 0 if that is not set.
            wire: The middleware, "dds" or "zenoh". If None, the selected one; see `coframe.wire.selection`.

        Raises:
            WireError: There is no such middleware, or none that is usable, an environment variable has an invalid
                value, the domain has no free participant index, this process was forked from a process that had joined
                a domain, or the system clock is before 1970 or after 2106.
        """
        domain = domains.domain_id() if domain_id is None else domains.check_domain_id(domain_id)
        key = (selection.resolve(wire), domain)
        with cls._instances_lock:
            if any(joined.is_inherited() for joined in cls._instances.values()):
                raise WireError(
                    "This process was forked from one that had joined the ROS graph, which does not work after a fork.",
                    hint="Start processes with 'spawn': multiprocessing.set_start_method('spawn').",
                )
            participant = cls._instances.get(key)
            if participant is None:
                if (fault := clock_fault()) is not None:
                    raise fault
                participant = cls._instances[key] = cls(domain, key[0])
            participant._references += 1
            return participant

    def close(self) -> None:
        """Release one reference. The last one closes all endpoints and stops the threads of the wire."""
        with self._instances_lock:
            self._references -= 1
            if self._references == 0 and self._process == os.getpid():
                self._end()

    def add_node(
        self, namespace: str, name: str, *, has_parameters: bool = False, is_complete: bool = True
    ) -> GraphNode:
        """Add a node to the graph.

        Args:
            namespace: The absolute namespace: "/" or "/a/b".
            name: The name without the namespace.
            has_parameters: Whether the caller provides the parameter services of the node. If not, the participant
                provides services without parameters.
            is_complete: Whether to announce the node now. If not, the caller creates its first endpoints and then calls
                `GraphNode.announce`, so that the others receive one message about the node.

        Raises:
            WireError: The namespace is not absolute, or a name is longer than 256 bytes.
        """
        if not namespace.startswith("/"):
            raise WireError(f"Namespace {namespace!r} is not absolute.", hint=f"Use '/{namespace}'.")
        for text in (namespace, name):
            names.check_name(text)
        node = GraphNode(self, namespace, name, has_parameters=has_parameters)
        if not is_complete:
            node.hold()
        with self._lock:
            self._nodes.append(node)
            if is_complete:
                self.announce()
        return node

    def remove_node(self, node: GraphNode) -> None:
        """Remove a node from the graph. `GraphNode.close` calls this."""
        with self._lock:
            if node in self._nodes:
                self._nodes.remove(node)
                self.announce()

    def static_broadcaster(self, node: GraphNode, topic: str = "/tf_static") -> StaticBroadcaster:
        """Create a broadcaster of static transforms for `node`.

        All broadcasters of this process on one topic share one writer: a late-joining subscriber receives only the
        last message of a writer, so that message must contain all static transforms of the process.

        Raises:
            WireError: The middleware cannot create the publisher.
        """
        with self._lock:
            shared = self._statics.get(topic)
            if shared is None or shared.closed:
                shared = self._statics[topic] = SharedStaticPublisher(self, topic)
            return shared.join(node)

    def watch_graph(self, event: _core.Event) -> None:
        """Set `event` when the graph changes, until `unwatch_graph` is called."""
        with self._lock:
            self._watchers.append(event)

    def unwatch_graph(self, event: _core.Event) -> None:
        """Stop setting `event` when the graph changes."""
        with self._lock:
            self._watchers = [watcher for watcher in self._watchers if watcher is not event]

    def on_warning(self, callback: Callable[[str], None]) -> None:
        """Call `callback` with each communication warning, on the maintenance thread.

        If no callback is registered, warnings go to the logger "coframe.wire".
        """
        with self._lock:
            self._warning_callbacks.append(callback)

    def announce(self) -> None:
        """Publish the nodes of this process and their endpoints on the graph."""
        with self._lock:
            if self._closing or self.is_inherited():
                return
            self._session.announce(self._nodes)

    def is_inherited(self) -> bool:
        """Return whether this process was forked from the process that created the participant."""
        return self._process != os.getpid()

    def _warn(self, text: str) -> None:
        with self._lock:
            callbacks = list(self._warning_callbacks)
        for callback in callbacks or [_logger.warning]:
            callback(printable(text))  # contain names from the network

    def _endpoints(self) -> list[LocalEndpoint]:
        with self._lock:
            return list({endpoint.guid: endpoint for node in self._nodes for endpoint in node.endpoints}.values())

    def _run_maintenance(self) -> None:
        seen = -1
        endpoints: list[LocalEndpoint] = []
        while not self._closing:
            pause = SECOND
            start = time.thread_time_ns()
            try:
                pause = self._session.repeat_announcement()
                version = self._graph.refresh()
                if version != seen:
                    self._graph_changed()
                    endpoints = self._endpoints()  # a new one is part of the graph
                if version != seen or self._mismatches.waiting:
                    self._mismatches.check(endpoints)
                seen = version
                for endpoint in endpoints:
                    endpoint.report_unreachable()
                self._ignored_messages.check(endpoints)
                readers = [endpoint for endpoint in endpoints if isinstance(endpoint, TfReader)]
                self._rejections.check(readers)
                self._warn_of_naming_problems(readers)
                if (fault := clock_fault()) is not None:  # The clock was changed while the process was running.
                    self._warn_once(error_text(fault), "clock")
            except Exception:
                # A warning callback raised, or an endpoint was closed in the meantime.
                if not self._closing:
                    _logger.exception("The maintenance of the ROS graph failed. Retrying in 1 s.")
            worked = time.thread_time_ns() - start
            self._end_of_pause.wait(min(_PAUSE_FACTOR * worked, _MAX_PAUSE))
            self._wake_event.wait(pause)

    def _warn_of_naming_problems(self, readers: list[TfReader]) -> None:
        for reader in readers:
            topic = names.any_ros_name(reader.topic)
            for statistics in reader.writer_statistics():
                node = self._graph.writer_node(statistics.writer) or "an unnamed node"
                examples = statistics.slashed, statistics.prefixed, statistics.plain
                for problem in naming_problems(f"{node} on {topic}", *examples):
                    self._warn_once(problem)

    def _graph_changed(self) -> None:
        with self._lock:
            watchers = list(self._watchers)
        for event in watchers:
            event.set()
        with self._lock:
            warning = self._session.adapt()
        self._warn_once(warning, "middleware")
        with self._lock:
            without_parameters = [node for node in self._nodes if not node.has_parameters]
        self._parameter_services.serve(without_parameters, self._graph.by_topic(writers=True))
        for endpoint in self._endpoints():
            endpoint.graph_changed(self._graph)

    def _end(self) -> None:
        del self._instances[self.wire, self.domain_id]
        self._closing = True
        self._end_of_pause.set()
        self._wake_event.set()
        if self._thread is not threading.current_thread():
            self._thread.join()
        self._parameter_services.close()
        for node in list(self._nodes):
            node.close()
        self._session.close()


def _renew_locks() -> None:
    """Replace the locks in a forked child, where the threads that held them do not exist."""
    Participant._instances_lock = threading.RLock()  # noqa: SLF001 - this module's class
    for participant in Participant._instances.values():  # noqa: SLF001 - this module's class
        participant._lock = threading.RLock()  # noqa: SLF001 - this module's class


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_renew_locks)


@atexit.register
def _end_all() -> None:
    """Close all participants, because the threads of the wire must stop before the interpreter exits."""
    # A second Ctrl-C would leave the participants open and print a traceback. Only the main thread can set a handler.
    with contextlib.suppress(ValueError):
        signal.signal(signal.SIGINT, signal.SIG_IGN)
    with Participant._instances_lock:  # noqa: SLF001 - this module's class
        for participant in list(Participant._instances.values()):  # noqa: SLF001 - this module's class
            if participant._process == os.getpid():  # noqa: SLF001 - this module's class
                participant._end()  # noqa: SLF001 - this module's class
