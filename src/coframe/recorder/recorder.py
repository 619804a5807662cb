# SPDX-License-Identifier: Apache-2.0
"""`coframe.record()`: record topics with one thread that receives and one that writes to disk."""

from __future__ import annotations

import threading
import time
from datetime import datetime
from typing import TYPE_CHECKING, NamedTuple

from coframe import _core
from coframe._output import html_tables
from coframe.bags import OfferedQos, RecordingError, Writer
from coframe.frame_names import renaming
from coframe.recorder._frame_renaming import FrameRenamer
from coframe.recorder._message_queue import MessageQueue, ReceivedMessage
from coframe.recorder._topic_filter import TopicFilter
from coframe.recorder._topic_subscriptions import TopicSubscriptions
from coframe.time import MILLISECOND, duration_seconds
from coframe.wire.participant import Participant

if TYPE_CHECKING:
    import os
    from collections.abc import Callable, Iterable
    from datetime import timedelta

    from typing_extensions import Self

    from coframe.time import DurationLike

__all__ = ["DEFAULT_BACKLOG", "Recorder", "RecorderStatistics", "record"]

DEFAULT_BACKLOG = 128 << 20  # bytes
_FLUSH_PERIOD = 0.5  # seconds; including the duration of a flush, at most the last second is lost
_RECEIVE_PERIOD = 100 * MILLISECOND
_BATCH = 1 << 20  # bytes


class RecorderStatistics(NamedTuple):
    """The statistics of a recorder.

    Attributes:
        messages: The number of messages written.
        size: The size of the files in bytes.
        topics: The number of subscribed topics.
        waiting: The size of received messages not yet written, in bytes.
        dropped: The number of messages, by topic, that were dropped because the disk was too slow.
        missing: The topics that were requested by name and have no publisher yet.
        unrecordable: The topics that cannot be recorded, because their type is not a ROS type or there are too many.
        not_renamed: The topics whose frames get no prefix because the definition of their type is unknown.
    """

    messages: int
    size: int
    topics: int
    waiting: int
    dropped: dict[str, int]
    missing: list[str]
    unrecordable: list[str]
    not_renamed: list[str]

    def _repr_html_(self) -> str:
        return html_tables.record("Recorder", self._asdict().items())


class Recorder:
    """A running recording. Created by :func:`record`; can be used as a context manager. All methods are thread-safe.

    Attributes:
        writer: The writer of the files.
    """

    def __init__(
        self,
        writer: Writer,
        topic_filter: TopicFilter,
        *,
        domain: int | None,
        backlog: int,
        on_topic: Callable[[str, str], None],
        wire: str | None = None,
        frames: FrameRenamer | None = None,
    ) -> None:
        self.writer = writer
        self._filter = topic_filter
        self._on_topic = on_topic
        self._frames = frames
        self._queue = MessageQueue(backlog)
        self._error: Exception | None = None
        self._end_event = threading.Event()
        self._stopping = False
        self._is_paused = False
        self._closing = threading.Lock()
        self._qos: dict[tuple[str, str], tuple[OfferedQos, ...]] = {}
        self._participant = Participant.get(domain, wire)
        try:
            self._node = self._participant.add_node("/", "coframe_record")
            self._data, self._graph = _core.Event(), _core.Event()
            self._subscriptions = TopicSubscriptions(self._participant, self._node, topic_filter, self._data)
            self._participant.watch_graph(self._graph)
        except BaseException:
            self._participant.close()
            raise
        self._graph.set()
        self._threads = [
            threading.Thread(target=self._run_guarded, args=(run,), name=f"coframe-record-{name}", daemon=True)
            for name, run in (("receive", self._receive), ("write", self._write))
        ]
        for thread in self._threads:
            thread.start()

    @property
    def statistics(self) -> RecorderStatistics:
        """The current statistics."""
        subscribed = self._subscriptions.topics()
        return RecorderStatistics(
            messages=self.writer.messages,
            size=self.writer.size,
            topics=len(subscribed),
            waiting=self._queue.size,
            dropped=dict(self._queue.dropped),
            missing=self._filter.missing(subscribed),
            unrecordable=sorted(self._subscriptions.unrecordable_topics()),
            not_renamed=[] if self._frames is None else list(self._frames.not_renamed),
        )

    @property
    def paused(self) -> bool:
        """Whether messages that arrive are not recorded."""
        return self._is_paused

    def pause(self) -> None:
        """Record no messages until `resume` is called; subscriptions are kept."""
        self._is_paused = True

    def resume(self) -> None:
        """Record messages again."""
        self._is_paused = False

    def wait(self, timeout: DurationLike | None = None) -> bool:
        """Wait until the recording is closed or fails.

        Args:
            timeout: How long to wait, such as "2s". If None, wait without a limit.

        Returns:
            True if the recording has ended, False after the timeout.

        Raises:
            RecordingError: Writing failed, for example because the disk is full.
        """
        if not self._end_event.wait(duration_seconds(timeout)):
            return False
        if self._error is not None:
            raise self._error
        return True

    def close(self) -> None:
        """Write the messages received so far and close the files. A second call has no effect.

        Raises:
            RecordingError: Writing failed, for example because the disk is full. Files written before the error are
                readable.
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
            self._end_event.set()
        if self._error is not None:
            raise self._error

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _run_guarded(self, run: Callable[[], None]) -> None:
        """Run a thread's function. If it raises, end the recording; `wait` and `close` raise the exception again."""
        try:
            run()
        except Exception as error:  # noqa: BLE001 - `wait` and `close` raise it in the thread of the caller
            self._error = self._error or error
            self._end_event.set()

    def _receive(self) -> None:
        try:
            while not (self._stopping or self._end_event.is_set()):
                self._receive_once()
                self._data.wait(_RECEIVE_PERIOD)
            self._receive_once()
        finally:
            self._queue.close()

    def _receive_once(self) -> None:
        if self._graph.wait(0):
            for topic, ros_type, offered in self._subscriptions.refresh():
                profiles = (OfferedQos(qos.depth, qos.reliable, qos.transient_local, qos.keep_all) for qos in offered)
                self._qos[topic, ros_type] = tuple(dict.fromkeys(profiles))
                self._on_topic(topic, ros_type)
        for message in self._subscriptions.take():
            if not self._is_paused:
                self._queue.add_message(message)

    def _write(self) -> None:
        due = time.monotonic() + _FLUSH_PERIOD
        while not self._queue.is_done:
            for message in self._queue.take(max(due - time.monotonic(), 0.0), _BATCH):
                self._put(message)
            if time.monotonic() >= due:
                self.writer.flush()
                due = time.monotonic() + _FLUSH_PERIOD

    def _put(self, message: ReceivedMessage) -> None:
        key = message.source[:2]
        topic = self.writer.add_topic(*key, offered_qos=self._qos.get(key, ()))
        data = message.data if self._frames is None else self._frames.rename_message(message.source, message.data)
        self.writer.write(topic, data, message.received, published=message.published, publisher=message.publisher)


def record(
    path: str | os.PathLike[str] | None = None,
    *,
    topics: Iterable[str] | None = None,
    regex: str | None = None,
    exclude: str | None = None,
    types: Iterable[str] = (),
    services: Iterable[str] | bool = (),
    hidden: bool = False,
    exclude_topics: Iterable[str] = (),
    exclude_types: Iterable[str] = (),
    exclude_services: Iterable[str] = (),
    domain: int | None = None,
    wire: str | None = None,
    storage: str = "mcap",
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
    """Record topics in the background until the recorder is closed.

    Messages of any type are written unchanged, unless their frames are renamed. The files are flushed twice per second:
    if the process is killed, at most the last second is lost, and the files are readable.

    Args:
        path: The folder to create. If None, its name is ``rosbag2_`` with the current time.
        topics: The topics to record. If None, all topics are recorded that are not hidden, or those that match `regex`.
        regex: A regular expression. Also record topics whose full name matches it.
        exclude: A regular expression. Topics whose full name matches it are not recorded.
        types: Types whose topics are recorded as well: ["sensor_msgs/msg/LaserScan"].
        services: Services whose requests and responses are recorded as well, or True for all. Their client or server
            publishes them if its introspection is enabled.
        hidden: Whether hidden topics are recorded if no topics are selected.
        exclude_topics: Topics that are not recorded.
        exclude_types: Types whose topics are not recorded.
        exclude_services: Services whose requests and responses are not recorded.
        domain: The ROS domain, 0 to 232. If None, it is ROS_DOMAIN_ID, or 0 if that is not set.
        wire: The middleware, "dds" or "zenoh"; see :func:`coframe.connect`.
        storage: The format of the files, ``mcap`` or ``sqlite3``.
        compression: ``zstd``, ``lz4`` or ``none``; SQLite files are not compressed.
        max_size: The size in bytes after which a new file is started. If None, there is no limit.
        max_duration: The duration after which a new file is started, such as "10min". If None, there is no limit.
        backlog: The size in bytes of the queue for a slow disk. If it is full, the oldest messages are dropped and
            counted.
        on_topic: Called with the name and the type of each topic when its recording starts.
        tf_topic: The topic with the transforms of the robot to which `prefix` applies. All topics in its namespace
            belong to the robot; with ``/tf``, these are all topics.
        tf_static_topic: The topic of the static transforms of that robot.
        prefix: A prefix for the frames in all messages of that robot, used as given: ``robot1/`` turns ``base_link``
            into ``robot1/base_link``.
        keep: The frames that are shared by robots and get no prefix: ``["map"]``.

    Raises:
        RecordingError: The folder exists or cannot be created, or a package is not installed.
        WireError: The middleware is not installed, or it cannot join the graph.
        ValueError: An argument has an invalid value.

    Example:
        >>> with coframe.record("run", topics=["/tf", "/tf_static"]) as recorder:     # doctest: +SKIP
        ...     recorder.wait("10s")
    """
    topic_filter = TopicFilter(
        topics,
        regex,
        exclude,
        types=types,
        services=services,
        hidden=hidden,
        exclude_topics=exclude_topics,
        exclude_types=exclude_types,
        exclude_services=exclude_services,
    )
    names = renaming(prefix, keep)
    frames = None if names is None else FrameRenamer(names, tf_topic, tf_static_topic)
    folder = datetime.now().astimezone().strftime("rosbag2_%Y_%m_%d-%H_%M_%S") if path is None else path
    participant = Participant.get(domain, wire)  # before the folder is created, because it can fail
    try:
        writer = Writer(folder, storage=storage, compression=compression, max_size=max_size, max_duration=max_duration)
        callback = on_topic or (lambda _topic, _type: None)
        return Recorder(
            writer, topic_filter, domain=domain, wire=wire, backlog=backlog, on_topic=callback, frames=frames
        )
    finally:
        participant.close()
