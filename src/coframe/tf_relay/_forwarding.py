# SPDX-License-Identifier: Apache-2.0
"""The thread of a relay, which reads transforms and writes them to other topics."""

from __future__ import annotations

import logging
import threading
import time
from typing import TYPE_CHECKING, NamedTuple

from coframe import _core
from coframe._output.formatting import error_text
from coframe._output.warn_once import WarnOnce
from coframe.connection.tf_publishers import TfPublisher, publisher_state, tf_publisher
from coframe.errors import WireError
from coframe.frame_names import renaming, shared_frames
from coframe.tf_relay._robots import RobotTopics, topic_of_kind
from coframe.tf_relay._status import NotRelayed, RelayedEdge, RelayedRobot
from coframe.time import MILLISECOND, SECOND
from coframe.type_names import TF_MESSAGE
from coframe.wire.participant import Participant
from coframe.wire.qos import TF_STATIC_WRITER, QoS
from coframe.wire.tf_reader import WriterStatistics

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator
    from types import TracebackType

    from typing_extensions import Self

    from coframe.tf_relay._max_error import MaxError
    from coframe.wire.endpoints import Publisher, Subscription

__all__ = ["Relay"]

_logger = logging.getLogger("coframe.wire")

_CHECK_PERIOD = 500 * MILLISECOND
_BATCH = 100  # messages
# The first message is forwarded immediately. Messages that arrive within this time after it are collected and written
# together, which reduces the number of wake-ups and writes with many robots.
_COLLECTION_TIME = 0.005  # seconds
_FORGET_AFTER = 60 * SECOND
# The user data by which relays recognize each other's writers, in the format of ROS type hashes.
_USER_DATA = "coframe=relay;"
# Deep enough that no message is lost while the machine is busy for one second.
_READER_QOS, _WRITER_QOS = QoS(depth=1000), QoS(depth=1000)
_STATIC_READER_QOS = QoS(depth=1000, transient_local=True)


class _EdgeRow(NamedTuple):
    """The statistics of an edge. See `_core.Relay.edges`."""

    parent: str
    child: str
    source: int
    writer: int
    rival: int | None
    conflicts: int
    forwarded: int
    skipped: int
    newest: int
    received_at: int


class _Output(NamedTuple):
    """A topic to which the relay writes."""

    topic: str
    native: _core.Relay
    publisher: Publisher
    robots: list[RobotTopics]  # by the source number of `native`


class _Route(NamedTuple):
    """An output of an input, with the number of its source in the output."""

    output: _Output
    source: int


class _Input(NamedTuple):
    """A topic from which the relay reads, and the outputs to which its messages are forwarded."""

    topic: str
    static: bool
    subscription: Subscription
    routes: list[_Route]


class Relay:
    """A running relay, which forwards the transforms of robots until it is closed. Created by :func:`coframe.relay`."""

    def __init__(
        self,
        robots: list[RobotTopics],
        *,
        common: tuple[str, str],
        keep: Iterable[str],
        rate: float | None,
        max_error: MaxError | None,
        split: bool,
        domain: int | None,
        wire: str | None,
        node_name: str,
        warn: Callable[[str], None] | None,
    ) -> None:
        self._robots = robots
        self._shared_frames = shared_frames(keep)
        self._splits = split
        self._period = 0 if rate is None else round(SECOND / rate)
        self._max_error = max_error
        self._warn = warn or _logger.warning
        self._warn_once = WarnOnce(self._warn)
        self._event = _core.Event()
        self._lock = threading.Lock()  # protects the native relays
        self._relay_writers: dict[int, bool] = {}  # writer handle: whether it belongs to a relay
        self._states = {robot.name: "waiting" for robot in robots}
        self._closed = False
        self._closing = threading.Lock()
        self.participant = Participant.get(domain, wire)
        try:
            self.node = self.participant.add_node("/", node_name)
            self._inputs = [
                input_
                for static, topic in zip((False, True), common, strict=True)
                for input_ in self._connect(topic, static)
            ]
        except BaseException:
            self.participant.close()
            raise
        # Each output once, with one of its inputs.
        pairs = [(input_, route.output) for input_ in self._inputs for route in input_.routes]
        self._outputs = list({output.topic: (input_, output) for input_, output in pairs}.values())
        self._thread = threading.Thread(target=self._run, name="coframe-relay", daemon=True)
        self._thread.start()

    @property
    def routes(self) -> list[str]:
        """A description of each route: the topic that is read, the topic that is written, and the prefix."""
        lines = []
        for input_ in self._inputs:
            for output, source in input_.routes:
                prefix = output.robots[source].prefix
                change = f"{'removing' if self._splits else 'adding'} prefix {prefix}" if prefix else "frames unchanged"
                lines.append(f"{input_.topic} -> {output.topic}, {change}")
        return lines

    @property
    def robots(self) -> list[RelayedRobot]:
        """The state of each robot."""
        robots = []
        for name, received in self._publishers_by_robot().items():
            publishers = [publisher for publisher, _ in received]
            not_relayed = NotRelayed(*map(sum, zip(*(counts for _, counts in received), strict=True)))
            robots.append(RelayedRobot(name, publisher_state(publishers), publishers, not_relayed))
        return robots

    def edges(self) -> list[RelayedEdge]:
        """Return all published edges with their sources and counters."""
        now = time.monotonic_ns()
        edges = []
        for input_, output in self._outputs:
            with self._lock:
                rows = [_EdgeRow(*row) for row in output.native.edges()]
            for row in rows:
                robot = output.robots[row.source]
                edges.append(
                    RelayedEdge(
                        parent=row.parent,
                        child=row.child,
                        static=input_.static,
                        robot=robot.name,
                        source=input_.topic if self._splits else topic_of_kind(robot.topic, static=input_.static),
                        node=self.participant.writer_node(row.writer) or "an unnamed node",
                        target=output.topic,
                        forwarded=row.forwarded,
                        skipped=row.skipped,
                        conflicting_robot="" if row.rival is None else output.robots[row.rival].name,
                        conflicts=row.conflicts,
                        newest=row.newest,
                        age=(now - row.received_at) / SECOND,
                    )
                )
        return edges

    def close(self) -> None:
        """Stop the relay. Published transforms remain valid. A second call has no effect."""
        with self._closing:
            if self._closed:
                return
            self._closed = True
        self._event.set()
        if self._thread is not threading.current_thread():
            self._thread.join()
        self.node.close()
        self.participant.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self.close()

    def _connect(self, common: str, static: bool) -> list[_Input]:
        """Create the inputs of static or dynamic transforms, and their outputs."""
        if self._splits:
            input_ = self._input(common, static)
            for robot in self._robots:
                output = self._output(topic_of_kind(robot.topic, static=static), static)
                input_.routes.append(self._route(output, robot))
            return [input_]
        output = self._output(common, static)
        inputs = []
        for robot in self._robots:
            inputs.append(self._input(topic_of_kind(robot.topic, static=static), static))
            inputs[-1].routes.append(self._route(output, robot))
        return inputs

    def _input(self, topic: str, static: bool) -> _Input:
        qos = _STATIC_READER_QOS if static else _READER_QOS
        reader = self.participant.raw_subscription(self.node, topic, TF_MESSAGE, qos, on_data=self._event)
        return _Input(topic, static, reader, [])

    def _output(self, topic: str, static: bool) -> _Output:
        from coframe.messages.registry import find  # noqa: PLC0415 - `import coframe` must be cheap

        qos = TF_STATIC_WRITER if static else _WRITER_QOS
        message_type = find(TF_MESSAGE)
        publisher = self.participant.publisher(self.node, topic, message_type, qos, user_data=_USER_DATA)
        native = _core.Relay(True, 0) if static else _core.Relay(False, self._period, self._max_error)
        return _Output(topic, native, publisher, [])

    def _route(self, output: _Output, robot: RobotTopics) -> _Route:
        names = renaming(robot.prefix, self._shared_frames) or _core.Renaming("", self._shared_frames)
        output.robots.append(robot)
        return _Route(output, output.native.add_source(names, self._splits))

    def _run(self) -> None:
        checked = 0
        pause = threading.Event()
        while not self._closed:
            self._event.wait(self._idle_time())
            try:
                for input_ in self._inputs:
                    self._read(input_)
                for _, output in self._outputs:
                    self._write(output)
                if time.monotonic_ns() - checked >= _CHECK_PERIOD:
                    checked = time.monotonic_ns()
                    self._check()
            except Exception:
                # A warning callback raised, or the participant was closed in the meantime.
                if not self._closed:
                    _logger.exception("Relaying transforms failed. The relay continues.")
            pause.wait(_COLLECTION_TIME)

    def _idle_time(self) -> int:
        """Return how long the thread can sleep if no message arrives, in nanoseconds."""
        with self._lock:
            due = [output.native.next_due() for _, output in self._outputs]
        now = time.monotonic_ns()
        return max(0, min([_CHECK_PERIOD, *(at - now for at in due if at is not None)]))

    def _read(self, input_: _Input) -> None:
        while input_.subscription.pending():
            for data, _, writer in input_.subscription.take(_BATCH):
                if self._is_relay(input_.topic, writer):
                    continue
                for output, source in input_.routes:
                    with self._lock:
                        output.native.add(source, writer, data)

    def _write(self, output: _Output) -> None:
        with self._lock:
            message = output.native.take()
        if message is None:
            return
        try:
            output.publisher.write(message)
        except WireError as error:
            if not self._closed:
                self._warn_once(error_text(error), output.topic)

    def _is_relay(self, topic: str, writer: int) -> bool:
        """Return whether a writer is part of a relay, because its transforms must not be relayed again."""
        if writer not in self._relay_writers:
            description = self.participant.writers(topic).get(writer)
            if description is None:  # the writer has left, and the graph no longer contains it
                return False
            self._relay_writers[writer] = _USER_DATA.encode() in description.user_data
            if self._relay_writers[writer]:
                node = self.participant.writer_node(writer) or "another program"
                self._warn_once(
                    f"{node} on {topic} is a relay. Its transforms are not relayed again, to avoid an endless loop. "
                    "Read the robots' own topics instead.",
                    f"relay {topic} {node}",
                )
        return self._relay_writers[writer]

    def _publishers_by_robot(self) -> dict[str, list[tuple[TfPublisher, NotRelayed]]]:
        """Return the publishers of each robot, with the number of transforms that could not be relayed."""
        received: dict[str, list[tuple[TfPublisher, NotRelayed]]] = {robot.name: [] for robot in self._robots}
        for input_ in self._inputs:
            for route in input_.routes:
                received[route.output.robots[route.source].name] += self._publishers(input_, route)
        return received

    def _publishers(self, input_: _Input, route: _Route) -> Iterator[tuple[TfPublisher, NotRelayed]]:
        """Yield the publishers of one robot on one topic."""
        present = self.participant.writers(input_.topic)
        with self._lock:
            writers = route.output.native.writers(route.source)
        for facts, *not_relayed in writers:
            statistics = WriterStatistics(*facts)
            node = self.participant.writer_node(statistics.writer)
            publisher = tf_publisher(
                statistics, node, input_.topic, static=input_.static, is_present=statistics.writer in present
            )
            yield publisher, NotRelayed(*not_relayed)

    def _check(self) -> None:
        """Warn about each problem once, and about state changes of robots."""
        self._forget_departed_writers()
        edges = self.edges()
        for robot, received in self._publishers_by_robot().items():
            for publisher, not_relayed in received:
                children = [edge.child for edge in edges if edge.robot == robot and edge.node == publisher.node]
                if problem := publisher.clock_problem(children):
                    self._warn_once(f"{robot}: {problem}", f"clock {publisher.node} {publisher.topic}")
                for problem in publisher.naming_problems + not_relayed.problems(
                    f"{publisher.node} on {publisher.topic}"
                ):
                    self._warn_once(problem)
            self._report_state(robot, publisher_state(publisher for publisher, _ in received))
        for edge in edges:
            if edge.conflicting_robot:
                self._warn_once(
                    f"{edge.robot} and {edge.conflicting_robot} both publish a transform to {edge.child!r}. The "
                    f"first one, from {edge.robot}, is used ({edge.node} on {edge.source}). Give each robot its own "
                    "prefix, or stop one of the publishers.",
                    f"conflict {edge.child} {edge.conflicting_robot}",
                )

    def _report_state(self, robot: str, state: str) -> None:
        before, self._states[robot] = self._states[robot], state
        if state == before:
            return
        if state == "gone":
            self._warn(f"{robot} is gone: no node publishes its transforms, so its frames are stale.")
        elif state == "stale":
            self._warn(f"{robot} is stale: its publishers are on the graph, but no dynamic transforms arrive.")
        elif before != "waiting":
            self._warn(f"{robot} is live again.")

    def _forget_departed_writers(self) -> None:
        for input_ in self._inputs:
            present = self.participant.writers(input_.topic)
            for output, source in input_.routes:
                with self._lock:
                    for (writer, _, received_at, *_), *_ in output.native.writers(source):
                        if writer not in present and time.monotonic_ns() - received_at > _FORGET_AFTER:
                            output.native.forget_writer(source, writer)
                            self._relay_writers.pop(writer, None)
