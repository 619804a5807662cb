"""`coframe.record()`: what is said on the graph, written down by two threads, of which one may be slow."""

from __future__ import annotations

import threading
import time
from datetime import datetime
from typing import TYPE_CHECKING, NamedTuple

from coframe import _core
from coframe.bags import OfferedQos, RecordingError, Writer
from coframe.frame_names import renaming
from coframe.recorder.frame_renaming import FrameRenamer
from coframe.recorder.message_queue import MessageQueue, ReceivedMessage
from coframe.recorder.topic_subscriptions import Subscriptions, Wanted
from coframe.wire import Participant

if TYPE_CHECKING:
    import os
    from collections.abc import Callable, Iterable
    from datetime import timedelta

    from typing_extensions import Self

__all__ = ["DEFAULT_BACKLOG", "Recorder", "RecorderStatistics", "record"]

DEFAULT_BACKLOG = 128 << 20  # bytes
_FLUSH_PERIOD = 0.5  # seconds: with the time that a flush takes, at most the last second is lost
_LISTEN_PERIOD_NS = 100_000_000
_BATCH = 1 << 20  # bytes


class RecorderStatistics(NamedTuple):
    """How a recorder is doing.

    Attributes:
        messages: On the disk.
        size: Bytes of the files.
        topics: How many were joined.
        waiting: Bytes that were received and are not on the disk yet.
        dropped: Messages by topic that the disk was too slow for.
        missing: Topics that were asked for by name and that nobody publishes on yet.
        refused: Topics that cannot be joined: their type is not ROS's, or there are too many.
        not_renamed: Topics whose frames get no prefix, as nobody says what their messages are made of.
    """

    messages: int
    size: int
    topics: int
    waiting: int
    dropped: dict[str, int]
    missing: list[str]
    refused: list[str]
    not_renamed: list[str]


class Recorder:
    """What `record` gives; usable as a context manager. Any thread may ask.

    Attributes:
        writer: What writes the files.
    """

    def __init__(
        self,
        writer: Writer,
        wanted: Wanted,
        *,
        domain: int | None,
        backlog: int,
        on_topic: Callable[[str, str], None],
        frames: FrameRenamer | None = None,
    ) -> None:
        self.writer = writer
        self._wanted = wanted
        self._on_topic = on_topic
        self._frames = frames
        self._backlog = MessageQueue(backlog)
        self._error: Exception | None = None
        self._ended = threading.Event()
        self._stopping = False
        self._closing = threading.Lock()
        self._qos: dict[tuple[str, str], tuple[OfferedQos, ...]] = {}
        self._participant = Participant.get(domain)
        try:
            self._node = self._participant.add_node("/", "coframe_record")
            self._data, self._graph = _core.Event(), _core.Event()
            self._subscriptions = Subscriptions(self._participant, self._node, wanted, self._data)
            self._participant.watch_graph(self._graph)
        except BaseException:
            self._participant.close()
            raise
        self._graph.set()
        self._threads = [
            threading.Thread(target=self._guarded, args=(run,), name=f"coframe-record-{name}", daemon=True)
            for name, run in (("listen", self._listen), ("write", self._write))
        ]
        for thread in self._threads:
            thread.start()

    @property
    def statistics(self) -> RecorderStatistics:
        """How it is doing."""
        joined = self._subscriptions.topics()
        return RecorderStatistics(
            messages=self.writer.messages,
            size=self.writer.size,
            topics=len(joined),
            waiting=self._backlog.size,
            dropped=dict(self._backlog.dropped),
            missing=self._wanted.missing(joined),
            refused=sorted(self._subscriptions.refused()),
            not_renamed=[] if self._frames is None else list(self._frames.not_renamed),
        )

    def wait(self, timeout: float | None = None) -> bool:
        """Waits until recording has ended by itself, which it does only when something fails: True, or an exception.

        Args:
            timeout: Seconds; None: for ever.

        Raises:
            RecordingError: The disk is full, for example.
        """
        if not self._ended.wait(timeout):
            return False
        if self._error is not None:
            raise self._error
        return True

    def close(self) -> None:
        """Writes what was received so far and ends the files. Closing twice does no harm.

        Raises:
            RecordingError: The disk is full, for example; what was written before can be read.
        """
        with self._closing:
            if self._stopping:
                return
            self._stopping = True
            self._data.set()
            for thread in self._threads:
                thread.join()
            self._participant.unwatch_graph(self._graph)
            self._node.close()
            self._participant.close()
            try:
                self.writer.close()
            except RecordingError as error:
                self._error = self._error or error
            self._ended.set()
        if self._error is not None:
            raise self._error

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _guarded(self, run: Callable[[], None]) -> None:
        """Whatever ends a thread ends the recording, and `wait` and `close` tell of it."""
        try:
            run()
        except Exception as error:  # noqa: BLE001 - it is raised again in the thread that waits
            self._error = self._error or error
            self._ended.set()

    def _listen(self) -> None:
        try:
            while not (self._stopping or self._ended.is_set()):
                self._listen_once()
                self._data.wait(_LISTEN_PERIOD_NS)
            self._listen_once()
        finally:
            self._backlog.close()

    def _listen_once(self) -> None:
        if self._graph.wait(0):
            for topic, ros_type, offered in self._subscriptions.refresh():
                profiles = (OfferedQos(qos.depth, qos.reliable, qos.transient_local, qos.keep_all) for qos in offered)
                self._qos[topic, ros_type] = tuple(dict.fromkeys(profiles))
                self._on_topic(topic, ros_type)
        for message in self._subscriptions.take():
            self._backlog.put(message)

    def _write(self) -> None:
        due = time.monotonic() + _FLUSH_PERIOD
        while not self._backlog.is_done:
            for message in self._backlog.take(max(due - time.monotonic(), 0.0), _BATCH):
                self._put(message)
            if time.monotonic() >= due:
                self.writer.flush()
                due = time.monotonic() + _FLUSH_PERIOD

    def _put(self, message: ReceivedMessage) -> None:
        key = message.source[:2]
        topic = self.writer.add_topic(*key, offered_qos=self._qos.get(key, ()))
        data = message.data if self._frames is None else self._frames.renamed(message.source, message.data)
        self.writer.write(topic, data, message.received, published=message.published, publisher=message.publisher)


def record(
    path: str | os.PathLike[str] | None = None,
    *,
    topics: Iterable[str] | None = None,
    regex: str | None = None,
    exclude: str | None = None,
    domain: int | None = None,
    compression: str = "zstd",
    max_size: int | None = None,
    max_duration: str | int | timedelta | None = None,
    backlog: int = DEFAULT_BACKLOG,
    on_topic: Callable[[str, str], None] | None = None,
    tf_topic: str = "/tf",
    tf_static_topic: str = "/tf_static",
    prefix: str = "",
    keep: Iterable[str] = (),
) -> Recorder:
    """Writes down what is said on the graph, in the background, until the recorder is closed.

    The messages are written as the bytes that they came as, of any type, unless their frames are to be renamed. They
    are given to the operating system twice a second: if the process is killed, at most the last second is missing, and
    the files are whole.

    Args:
        path: The folder, which must not be there yet; None: rosbag2_ and the time.
        topics: Which topics; None: all that are not hidden, or those of `regex`.
        regex: Also topics whose whole name this matches.
        exclude: No topics whose whole name this matches.
        domain: The ROS domain, 0 to 232; None: ROS_DOMAIN_ID, or 0.
        compression: ``zstd``, ``lz4`` or ``none``.
        max_size: Bytes after which the next file begins; None: never.
        max_duration: Time after which the next file begins, such as "10min"; None: never.
        backlog: Bytes that may wait for a slow disk; then the oldest messages make room and are counted.
        on_topic: Is called with the name and the type of each topic that is joined.
        tf_topic: Where the transforms of the robot are sent that `prefix` is for; the other topics of its namespace
            are that robot's, too: of ``/tf`` all.
        tf_static_topic: Where its static transforms are sent.
        prefix: In front of the names of frames in all messages of that robot, as it is: ``robot1/`` makes
            ``robot1/base_link``.
        keep: The frames that get no prefix, as they are shared: ``["map"]``.

    Raises:
        RecordingError: The folder is there already or cannot be made, or a package is missing.
        WireError: cyclonedds is missing, or DDS does not let us in.
        ValueError: One of the arguments makes no sense.

    Example:
        >>> with coframe.record("run", topics=["/tf", "/tf_static"]) as recorder:     # doctest: +SKIP
        ...     recorder.wait(10.0)
    """
    wanted = Wanted(topics, regex, exclude)
    names = renaming(prefix, keep)
    frames = None if names is None else FrameRenamer(names, tf_topic, tf_static_topic)
    folder = datetime.now().astimezone().strftime("rosbag2_%Y_%m_%d-%H_%M_%S") if path is None else path
    participant = Participant.get(domain)  # before there is a folder: this is what may fail
    try:
        writer = Writer(folder, compression=compression, max_size=max_size, max_duration=max_duration)
        tell = on_topic or (lambda _topic, _type: None)
        return Recorder(writer, wanted, domain=domain, backlog=backlog, on_topic=tell, frames=frames)
    finally:
        participant.close()
