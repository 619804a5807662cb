"""`coframe.relay()`: the trees of many robots into one, or one into many."""

from __future__ import annotations

import logging
import threading
import time
from collections.abc import Mapping
from typing import TYPE_CHECKING, NamedTuple

from coframe import _core
from coframe.errors import WireError
from coframe.frame_names import kept, renaming
from coframe.tf_publishers import SILENT_AFTER, OnceEach, TfPublisher, publisher_of, state_of
from coframe.wire.participant import Participant
from coframe.wire.qos import TF_STATIC_WRITER, QoS

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable
    from types import TracebackType

    from typing_extensions import Self

    from coframe.wire.endpoints import Publisher, Subscription

__all__ = ["Relay", "RelayedEdge", "RelayedRobot", "relay"]

_logger = logging.getLogger("coframe.wire")

_NS = 1_000_000_000
_CHECK_PERIOD_NS = _NS // 2
_TAKE = 100
_TF_TYPE = "tf2_msgs/msg/TFMessage"
# The first message passes at once; those that come right behind it wait so many seconds, and go together: of many
# robots each write, and each time that the thread wakes up, serves several.
_PAUSE = 0.005
_FORGET_AFTER = 60.0  # seconds
# By this other relays know the writers of a relay; in the form in which ROS tells of types.
_MARK = "coframe=relay;"
# As deep as it takes to lose nothing while the machine is busy with something else for a second.
_READER, _WRITER = QoS(depth=1000), QoS(depth=1000)
_STATIC_READER = QoS(depth=1000, transient_local=True)


class RelayedEdge(NamedTuple):
    """An edge that a relay writes, and where it comes from.

    Attributes:
        parent: The parent frame, as it is written.
        child: The child frame, as it is written.
        static: Whether it holds for all times.
        robot: Whose it is.
        source: The topic that it comes from.
        node: The node that told of it last.
        target: The topic that it is written to.
        passed: How many transforms were taken for writing.
        thinned: How many were left out for the rate.
        rival: The robot that tells something else of the same child, and is not listened to; "" if there is none.
        contested: How many transforms of rivals were left out.
        newest: The newest stamp, in nanoseconds.
        age: Seconds since it was heard of last.
    """

    parent: str
    child: str
    static: bool
    robot: str
    source: str
    node: str
    target: str
    passed: int
    thinned: int
    rival: str
    contested: int
    newest: int
    age: float


class RelayedRobot(NamedTuple):
    """A robot of a relay.

    Attributes:
        name: Such as "robot1".
        state: "waiting" (nothing came yet), "live", "silent" (nothing that moves for a second) or "gone" (nobody
            publishes there any more).
        publishers: Who publishes there, and who has left not long ago.
    """

    name: str
    state: str
    publishers: list[TfPublisher]


class _Robot(NamedTuple):
    """A robot, its topic elsewhere than where all are, and its prefix where all are."""

    name: str
    topic: str
    prefix: str


class _Outlet(NamedTuple):
    """A topic that is written."""

    topic: str
    native: _core.Relay
    publisher: Publisher
    robots: list[_Robot]  # by the number of the source


class _Way(NamedTuple):
    outlet: _Outlet
    source: int


class _Inlet(NamedTuple):
    """A topic that is read, and where its messages go."""

    topic: str
    static: bool
    subscription: Subscription
    ways: list[_Way]


class Relay:
    """Reads the transforms of robots and writes them elsewhere, until it is closed. Made by :func:`relay`."""

    def __init__(
        self,
        robots: list[_Robot],
        *,
        common: tuple[str, str],
        keep: Iterable[str],
        rate: float | None,
        split: bool,
        domain: int | None,
        node_name: str,
        warn: Callable[[str], None] | None,
    ) -> None:
        self._robots = robots
        self._keep = kept(keep)
        self._split = split
        self._period = 0 if rate is None else round(_NS / rate)
        self._warn = OnceEach(warn or _logger.warning)
        self._tell = warn or _logger.warning
        self._event = _core.Event()
        self._lock = threading.Lock()  # of the native relays
        self._ours: dict[int, bool] = {}  # whether a writer is a relay's
        self._states = {robot.name: "waiting" for robot in robots}
        self._ending = False
        self._closing = threading.Lock()
        self.participant = Participant.get(domain)
        try:
            self.node = self.participant.add_node("/", node_name)
            self._inlets = [
                inlet
                for static, topic in zip((False, True), common, strict=True)
                for inlet in self._connected(topic, static)
            ]
        except BaseException:
            self.participant.close()
            raise
        # The topics that are written, each once, with one that is read for them.
        pairs = [(inlet, way.outlet) for inlet in self._inlets for way in inlet.ways]
        self._pairs = list({outlet.topic: (inlet, outlet) for inlet, outlet in pairs}.values())
        self._thread = threading.Thread(target=self._run, name="coframe-relay", daemon=True)
        self._thread.start()

    @property
    def routes(self) -> list[str]:
        """What is read and written, a line each."""
        lines = []
        for inlet in self._inlets:
            for outlet, source in inlet.ways:
                prefix = outlet.robots[source].prefix
                names = "names as they are" if not prefix else f"{'without' if self._split else 'with'} {prefix}"
                lines.append(f"{inlet.topic} -> {outlet.topic}, {names}")
        return lines

    @property
    def robots(self) -> list[RelayedRobot]:
        """How each robot does."""
        found: dict[str, list[TfPublisher]] = {robot.name: [] for robot in self._robots}
        for inlet in self._inlets:
            for way in inlet.ways:
                for robot, publisher in self._publishers(inlet, way):
                    found[robot].append(publisher)
        return [RelayedRobot(name, state_of(publishers), publishers) for name, publishers in found.items()]

    def edges(self) -> list[RelayedEdge]:
        """Every edge that is written, or contested, and where it comes from."""
        now = time.monotonic_ns()
        edges = []
        for inlet, outlet in self._pairs:
            with self._lock:
                told = outlet.native.edges()
            for parent, child, source, writer, rival, contested, passed, thinned, newest, heard_at in told:
                robot = outlet.robots[source]
                edges.append(
                    RelayedEdge(
                        parent=parent,
                        child=child,
                        static=inlet.static,
                        robot=robot.name,
                        source=inlet.topic if self._split else _topic(robot.topic, static=inlet.static),
                        node=self.participant.writer_node(writer) or "an unnamed node",
                        target=outlet.topic,
                        passed=passed,
                        thinned=thinned,
                        rival="" if rival is None else outlet.robots[rival].name,
                        contested=contested,
                        newest=newest,
                        age=(now - heard_at) / _NS,
                    )
                )
        return edges

    def close(self) -> None:
        """Ends it; closing twice does no harm. What it wrote stays with those who heard it."""
        with self._closing:
            if self._ending:
                return
            self._ending = True
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

    def _connected(self, common: str, static: bool) -> list[_Inlet]:
        """The topics that are read, of one kind, and behind them those that are written."""
        if self._split:
            inlet = self._inlet(common, static)
            for robot in self._robots:
                outlet = self._outlet(_topic(robot.topic, static=static), static)
                inlet.ways.append(self._way(outlet, robot))
            return [inlet]
        outlet = self._outlet(common, static)
        inlets = []
        for robot in self._robots:
            inlets.append(self._inlet(_topic(robot.topic, static=static), static))
            inlets[-1].ways.append(self._way(outlet, robot))
        return inlets

    def _inlet(self, topic: str, static: bool) -> _Inlet:
        qos = _STATIC_READER if static else _READER
        reader = self.participant.raw_subscription(self.node, topic, _TF_TYPE, qos, on_data=self._event)
        return _Inlet(topic, static, reader, [])

    def _outlet(self, topic: str, static: bool) -> _Outlet:
        from coframe.messages.registry import find  # noqa: PLC0415 - importing coframe.wire stays cheap

        qos = TF_STATIC_WRITER if static else _WRITER
        message_type = find(_TF_TYPE)
        publisher = self.participant.publisher(self.node, topic, message_type, qos, user_data=_MARK)
        return _Outlet(topic, _core.Relay(static, 0 if static else self._period), publisher, [])

    def _way(self, outlet: _Outlet, robot: _Robot) -> _Way:
        names = renaming(robot.prefix, self._keep) or _core.Renaming("", self._keep)
        outlet.robots.append(robot)
        return _Way(outlet, outlet.native.add_source(names, self._split))

    def _run(self) -> None:
        checked = 0
        pause = threading.Event()
        while not self._ending:
            self._event.wait(_CHECK_PERIOD_NS)
            try:
                for inlet in self._inlets:
                    self._take(inlet)
                for _, outlet in self._pairs:
                    self._write(outlet)
                if time.monotonic_ns() - checked >= _CHECK_PERIOD_NS:
                    checked = time.monotonic_ns()
                    self._check()
            except Exception:
                # A callback of the user's, or DDS that is being closed.
                if not self._ending:
                    _logger.exception("a relay of transforms failed and goes on")
            pause.wait(_PAUSE)

    def _take(self, inlet: _Inlet) -> None:
        while inlet.subscription.pending():
            for data, _, writer in inlet.subscription.take(_TAKE):
                if self._is_relay(inlet.topic, writer):
                    continue
                for outlet, source in inlet.ways:
                    with self._lock:
                        outlet.native.add(source, writer, data)

    def _write(self, outlet: _Outlet) -> None:
        with self._lock:
            message = outlet.native.take()
        if message is None:
            return
        try:
            outlet.publisher.write(message)
        except WireError as error:
            if not self._ending:
                self._warn(outlet.topic, f"{error} {error.hint}")

    def _is_relay(self, topic: str, writer: int) -> bool:
        """Whether a writer is this or another relay's: reading those, transforms would go round for ever."""
        if writer not in self._ours:
            known = self.participant.writers(topic).get(writer)
            if known is None:  # it has left, and DDS has forgotten it
                return False
            self._ours[writer] = _MARK.encode() in known.user_data
            if self._ours[writer]:
                node = self.participant.writer_node(writer) or "another program"
                self._warn(
                    f"relay {topic} {node}",
                    f"{node} on {topic} is a relay: what relays write is not relayed again, or it would go round for "
                    "ever. Let this one read the robots' own topics",
                )
        return self._ours[writer]

    def _publishers(self, inlet: _Inlet, way: _Way) -> list[tuple[str, TfPublisher]]:
        """Whom one topic's messages come from, with the robot's name."""
        present = self.participant.writers(inlet.topic)
        with self._lock:
            heard = [heard for heard, _, _ in way.outlet.native.writers(way.source)]
        robot = way.outlet.robots[way.source].name
        return [
            (
                robot,
                publisher_of(
                    facts,
                    self.participant.writer_node(facts[0]),
                    inlet.topic,
                    static=inlet.static,
                    present=facts[0] in present,
                ),
            )
            for facts in heard
        ]

    def _check(self) -> None:
        """Tells what is wrong, each thing once, and whose transforms end or begin."""
        self._forget()
        edges = self.edges()
        for robot in self.robots:
            for publisher in robot.publishers:
                children = [edge.child for edge in edges if edge.robot == robot.name and edge.node == publisher.node]
                if problem := publisher.clock_problem(children):
                    self._warn(f"clock {publisher.node} {publisher.topic}", f"{robot.name}: {problem}")
                for sentence in publisher.oddities:
                    self._warn(sentence, sentence)
            self._tell_state(robot)
        for edge in edges:
            if edge.rival:
                self._warn(
                    f"rival {edge.child} {edge.rival}",
                    f"{edge.robot} and {edge.rival} both tell where {edge.child!r} is: {edge.robot} was first and is "
                    f"listened to ({edge.node} on {edge.source}); give each robot a prefix of its own, or let one tell",
                )

    def _tell_state(self, robot: RelayedRobot) -> None:
        before, self._states[robot.name] = self._states[robot.name], robot.state
        if robot.state == before:
            return
        if robot.state == "gone":
            self._tell(f"{robot.name} has gone: nobody publishes its transforms any more, its frames are stale")
        elif robot.state == "silent":
            self._tell(f"{robot.name} is silent: none of its transforms has come for {SILENT_AFTER:g} s")
        elif before != "waiting":
            self._tell(f"{robot.name} is back")

    def _forget(self) -> None:
        for inlet in self._inlets:
            present = self.participant.writers(inlet.topic)
            for outlet, source in inlet.ways:
                with self._lock:
                    for (writer, _, heard_at, *_), _, _ in outlet.native.writers(source):
                        if writer not in present and time.monotonic_ns() - heard_at > _FORGET_AFTER * _NS:
                            outlet.native.forget_writer(source, writer)
                            self._ours.pop(writer, None)


def _topic(topic: str, *, static: bool) -> str:
    return f"{topic}_static" if static else topic


def relay(
    robots: Iterable[str] | str = (),
    *,
    sources: Iterable[str] | Mapping[str, str] = (),
    common: str = "/tf",
    common_static: str | None = None,
    prefix: str = "",
    prefix_each: bool = False,
    keep: Iterable[str] = (),
    rate: float | None = None,
    split: bool = False,
    domain: int | None = None,
    node_name: str = "coframe_relay",
    warn: Callable[[str], None] | None = None,
) -> Relay:
    """Reads the transforms of robots, each on topics of its own, and writes all to one; or splits one up.

    The static transforms of a topic are expected on, and go to, the topic of its name with ``_static`` behind it. All
    that were ever heard are written again with every new one, so that late joiners get all. What a relay has written,
    this or another one, no relay reads. A frame that two robots tell of is the first one's, until it falls silent.

    Args:
        robots: Their names: ``robot1`` is on ``/robot1/tf``; a text is one name, or several with commas.
        sources: Topics of further robots, such as ``/robot1/tf``; as a mapping with the prefix of each: what it says,
            with its own slash.
        common: The topic where all robots are, that is written; or read where it is split.
        common_static: Likewise of the static transforms; None: ``common`` with ``_static`` behind it.
        prefix: In front of all names where all robots are, before each robot's own prefix.
        prefix_each: Each robot's frames get its name and a slash in front: ``robot1/``.
        keep: The frames that are shared and keep their names, such as ``["map", "world"]``.
        rate: Of each edge so many transforms a second at most; None: all. Static ones always pass.
        split: Reads the common topic instead and writes to the robots': what begins with ``robot1/``, without that,
            and what is shared.
        domain: The ROS domain, 0 to 232; None: ROS_DOMAIN_ID, or 0.
        node_name: As the others will see it.
        warn: Is called, on a thread of the relay's, with a sentence for each thing that is wrong: a clock that is off,
            a robot that has gone, a frame that two tell of, slashes in front of names, half a prefix. By default they
            go to the logger "coframe.wire".

    Raises:
        ValueError: There is no robot; one is there twice; a topic would be read and written; a rate is not positive.
        WireError: As of :func:`coframe.connect`.

    Example:
        >>> with relay("robot1,robot2", prefix_each=True, keep=["map"]) as running:    # doctest: +SKIP
        ...     [(edge.child, edge.robot, edge.node) for edge in running.edges()]
    """
    if rate is not None and not 0 < rate < _NS:
        raise ValueError(f"the rate must be above 0 Hz, not {rate!r}")
    prefixes = sources if isinstance(sources, Mapping) else dict.fromkeys(_texts(sources), "")
    topics = {f"/{name.strip('/')}/tf": "" for name in _texts(robots)}
    topics |= {_qualified(topic): own for topic, own in prefixes.items()}
    common = _qualified(common)
    common_static = _qualified(common_static or f"{common}_static")
    members = [_robot(topic, own, always=prefix_each or split) for topic, own in topics.items()]
    members = [robot._replace(prefix=f"{prefix}{robot.prefix}") for robot in members]
    if not members:
        raise ValueError("a relay needs robots: their names, or topics such as '/robot1/tf'")
    for robot in members:
        renaming(robot.prefix, keep)  # what is wrong with it is said before anything is joined
        for topic in sorted({robot.topic, f"{robot.topic}_static"} & {common, common_static}):
            raise ValueError(f"{topic} would be read and written, and go round for ever: choose another topic")
    return Relay(
        members,
        common=(common, common_static),
        keep=keep,
        rate=rate,
        split=split,
        domain=domain,
        node_name=node_name,
        warn=warn,
    )


def _robot(topic: str, prefix: str, *, always: bool) -> _Robot:
    name = topic.rpartition("/")[0].strip("/") or topic
    if always and not prefix:
        if name == topic:
            raise ValueError(f"{topic} is in no namespace that could name a robot: give its prefix")
        prefix = f"{name}/"
    return _Robot(name, topic, prefix)


def _texts(texts: Iterable[str] | str) -> list[str]:
    return [text.strip() for text in (texts.split(",") if isinstance(texts, str) else texts) if text.strip(" /")]


def _qualified(topic: str) -> str:
    return topic if topic.startswith("/") else f"/{topic}"
