# SPDX-License-Identifier: Apache-2.0
"""Recording: all transforms of a recording in a buffer, and its other messages by topic and time."""

from __future__ import annotations

import warnings
import weakref
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, overload

import numpy as np

from coframe import time
from coframe._base_error import CoframeWarning
from coframe._output import html_tables
from coframe._output.formatting import count
from coframe._sources.remote_error import RemoteFileError
from coframe._sources.sources import as_source
from coframe.bags._contents import read_contents
from coframe.bags._decoding import decoder
from coframe.bags._narrowing import run_query
from coframe.bags._recorded_message import RecordedMessage, RecordedTopic
from coframe.bags._table import edge_table
from coframe.bags._time_window import ALL_TIME, TimeWindow
from coframe.bags.namespaces import TransformChoice, main_clock_span
from coframe.bags.tables import TableQuery
from coframe.bags.tables.columns import FieldSource, PathSource, column
from coframe.bags.tables.topic_poses import topic_poses
from coframe.bags.time_points import parse_time_point
from coframe.errors import DecodeError, RecordingError
from coframe.messages.header_peek import HEADER_BYTES

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Sequence
    from typing import BinaryIO

    from numpy.typing import ArrayLike, NDArray
    from typing_extensions import Buffer as BytesLike
    from typing_extensions import Self

    from coframe._sources.sources import Location, Readable
    from coframe.bags._contents import Buffers, Contents
    from coframe.bags.storage import Channel
    from coframe.bags.tables import ColumnLike, Method, Table
    from coframe.buffer import Buffer
    from coframe.buffer.gaps import OnGap
    from coframe.messages.slices import Slices
    from coframe.time import DurationLike, StampLike
    from coframe.transform.transform import Transform
    from coframe.viewer import Viewer

__all__ = ["RecordedMessage", "RecordedTopic", "Recording", "open_bag"]


def open_bag(
    path: Location | BytesLike | BinaryIO,
    *,
    start: StampLike | str | None = None,
    stop: StampLike | str | None = None,
    namespace: str | None = None,
    tf_topic: str | None = None,
    tf_static_topic: str | None = None,
    prefix: str = "",
    keep: Iterable[str] = (),
    transforms: bool = True,
    progress: Callable[[int, int], object] | None = None,
    on_transforms: Callable[[Channel, NDArray[np.int64], Slices], object] | None = None,
) -> Recording:
    """Open a recording: rosbag2 (MCAP or SQLite, any compression), a bag of ROS 1, or MCAP with Foxglove's transforms.

    Of an MCAP file or a ROS 1 bag on a server, only the index is read; messages and transforms follow when they are
    needed. Their number and rate in ``topics`` are then those of the index.

    Args:
        path: A file, or a folder of rosbag2, with or without its metadata; its URL (``https://``, ``s3://``, ``gs://``,
            ``az://``); the bytes of a file; or a file object for bytes, which is not closed.
        start: Read only messages received from this time on: a stamp, or a string such as ``"10min"`` after the first
            message or ``"-2min"`` before the last one. Dynamic transforms are read from 10 s before until 10 s after
            the messages, static ones from the beginning.
        stop: The end of these messages, in the same form.
        namespace: Read only the transforms of a namespace, such as ``/robot1`` for ``/robot1/tf``; None: all.
        tf_topic: Read only the transforms on this topic and on ``tf_static_topic``. None means all topics, or ``/tf``
        if only the other topic is given.
        tf_static_topic: Read only the transforms on this topic and on ``tf_topic``. None: all, or ``/tf_static``.
        prefix: A prefix for the frame names in the buffers: ``robot1/`` gives ``robot1/base_link``.
        keep: Frames without the prefix because they are shared: ``["map"]``.
        transforms: Whether to read transforms. If False, the buffers are empty.
        progress: Called regularly with the number of bytes read and the total number of bytes.
        on_transforms: Called with all messages that contain transforms, in batches: the channel, the receive times
            and the bytes.

    Returns:
        The recording. Its ``problems`` describe the parts that could not be read.

    Raises:
        RecordingError: Nothing can be read, or a given topic other than /tf and /tf_static does not exist.
        ValueError: The prefix begins with a slash, ``start`` or ``stop`` is not a time, or ``stop`` is not later.
        TypeError: ``path`` is of another type, or a file object for text.

    Example:
        >>> import coframe
        >>> try:
        ...     coframe.open_bag("nowhere.mcap")
        ... except coframe.RecordingError as error:
        ...     print(error)
        nowhere.mcap cannot be read: No such file or directory
    """
    choice = TransformChoice(namespace, tf_topic, tf_static_topic, prefix, keep, transforms)
    window = TimeWindow(start, stop)
    return open_with_choice(path, choice, window=window, progress=progress, on_transforms=on_transforms)


def open_with_choice(
    path: Location | BytesLike | BinaryIO,
    choice: TransformChoice,
    *,
    window: TimeWindow = ALL_TIME,
    progress: Callable[[int, int], object] | None = None,
    on_transforms: Callable[[Channel, NDArray[np.int64], Slices], object] | None = None,
) -> Recording:
    """Open a recording as :func:`open_bag` does, given the choice of transforms and of messages as values."""
    try:
        source = as_source(path)
    except RemoteFileError as error:
        raise RecordingError(str(error), hint=error.hint) from None
    return Recording(read_contents(source, choice, window, progress, on_transforms), choice, window)


def _reopen_recording(path: Readable, choice: TransformChoice, window: TimeWindow) -> Recording:
    """Open the recording of another process."""
    return open_with_choice(path, choice, window=window)


class Recording:
    """An open recording, as returned by :func:`open_bag`. It is a context manager. Reading is thread-safe.

    It can be pickled: another process opens the file again, by its absolute path or its URL.

    Attributes:
        path: The path passed to :func:`open_bag`; for a URL, bytes or a file object, something whose text names it.
        topics: The topics by name, including those without messages.
        files: The path and the size in bytes of each file.
        formats: The file formats, usually one.
        compression: The compression of chunks or messages: ``zstd``, ``lz4``, ``bz2`` or ``none``.
        choice: The selected transforms, to open the recording again.
        window: The selected messages, to open the recording again.
        types: The types of its messages.
    """

    def __init__(self, contents: Contents, choice: TransformChoice, window: TimeWindow = ALL_TIME) -> None:
        self.path = contents.path
        self._read_buffers = contents.read_buffers
        self.topics = contents.topics
        self.files = contents.files
        self.formats = contents.formats
        self.compression = contents.compression
        self.choice = choice
        self.window = window
        self.types = contents.types
        self._index = contents.index
        self._problems = contents.problems
        self._received_span = contents.received_span
        self._renaming = choice.renaming
        self._decoders: dict[int, Callable[[bytes], Any]] = {}
        self._part: Recording | None = None
        self._closing = contents.closing
        weakref.finalize(self, self._closing.close)  # closes the files if the user does not

    @cached_property
    def _buffers(self) -> Buffers:
        return self._index.while_open(self._read_buffers)

    @property
    def buffer(self) -> Buffer:
        """All transforms, with unlimited history.

        If several namespaces contain the same frame names, only the transforms of the first one; see :attr:`buffers`.
        Those of a recording on a server are read when they are first needed.
        """
        return self._buffers.common

    @property
    def buffers(self) -> dict[str, Buffer]:
        """The transforms by namespace: ``""`` for ``/tf``, ``/robot1`` for ``/robot1/tf``."""
        return self._buffers.by_namespace

    @property
    def format(self) -> str:
        """The file format: ``MCAP``, ``SQLite`` or ``ROS 1 bag``; several ones are separated by commas."""
        return ", ".join(each.name for each in self.formats)

    def frame(self, name: str) -> str:
        """Return the buffer's name for a frame in a message: without a leading slash, with the prefix."""
        return name.removeprefix("/") if self._renaming is None else self._renaming(name)

    @property
    def problems(self) -> list[str]:
        """Read errors and unusual data, one message each. Reading messages can add more."""
        return self._problems.sentences()

    @property
    def start(self) -> int:
        """First stamp of the transforms in nanoseconds, on the clock that most of them use: a time for lookups.

        In a simulation, this is the simulated clock, which differs from that of :attr:`received_start`. Without dynamic
        transforms, it is :attr:`received_start`.
        """
        return self.span[0]

    @property
    def end(self) -> int:
        """Last stamp of the transforms in nanoseconds, on the clock of :attr:`start`."""
        return self.span[1]

    @property
    def received_start(self) -> int:
        """Receive time of the first message in nanoseconds, on the recorder's clock, or 0 if there is none."""
        return 0 if self._received_span is None else self._received_span[0]

    @property
    def received_end(self) -> int:
        """Receive time of the last message in nanoseconds, on the recorder's clock, or 0 if there is none."""
        return 0 if self._received_span is None else self._received_span[1]

    @property
    def duration(self) -> int:
        """Time from :attr:`received_start` to :attr:`received_end` in nanoseconds: the recorded duration."""
        return self.received_end - self.received_start

    @cached_property
    def span(self) -> tuple[int, int]:
        """:attr:`start` and :attr:`end`."""
        return main_clock_span(self.buffer) or (self.received_start, self.received_end)

    def messages(
        self, topic: str, start: StampLike | None = None, stop: StampLike | None = None
    ) -> Iterator[RecordedMessage]:
        """Return an iterator over the messages on a topic in receive order. Each one is read on demand.

        Args:
            topic: The name, with or without its leading slash.
            start: The first stamp; earlier messages are skipped.
            stop: The end; messages with this or a later stamp are skipped.

        Raises:
            RecordingError: The topic does not exist.
        """
        name = self._index.find_topic(topic)
        stamps = self._index.stamps(name)
        selection = np.ones(len(stamps), dtype=bool)
        if start is not None:
            selection &= stamps >= time.stamp_ns(start)
        if stop is not None:
            selection &= stamps < time.stamp_ns(stop)
        return self._read_all(name, np.flatnonzero(selection))

    def message_in_row(self, topic: str, row: int) -> RecordedMessage | None:
        """Return a message by its number in receive order, or None if it can no longer be read.

        Args:
            topic: The name, with or without its leading slash.
            row: The number, from 0.

        Raises:
            RecordingError: The topic does not exist.
        """
        return self._read_message(self._index.find_topic(topic), row)

    def find_topic(self, topic: str) -> str:
        """Return the full name of a topic whose leading slash may be missing.

        Raises:
            RecordingError: The topic does not exist.
        """
        return self._index.find_topic(topic)

    def has_stamps(self, topic: str) -> bool:
        """Return whether the messages on a topic begin with a stamp; if not, :meth:`stamps` uses receive times.

        Args:
            topic: The name, with or without its leading slash.

        Raises:
            RecordingError: The topic does not exist.
        """
        return all(track.stamp_reader is not None for track in self._index.tracks(self._index.find_topic(topic)))

    def channels(self) -> list[Channel]:
        """Return the channels of the files: one for each file, topic and type."""
        return [track.channel for track in self._index.tracks()]

    def in_order(
        self, topics: Iterable[str] | None = None, start: int | None = None, stop: int | None = None
    ) -> Iterator[tuple[Channel, int, bytes]]:
        """Yield the messages on several topics in receive order.

        Args:
            topics: Names of the topics, or None for all.
            start: The first receive time in nanoseconds; earlier messages are skipped.
            stop: The end; messages received at this time or later are skipped.

        Yields:
            Channel, receive time in nanoseconds, and bytes.

        Raises:
            RecordingError: A topic does not exist.
        """
        names = None if topics is None else [self._index.find_topic(topic) for topic in topics]
        yield from self._index.in_order(names, start, stop)

    def stamps(self, topic: str) -> NDArray[np.int64]:
        """Return the stamps of a topic's messages in receive order.

        Args:
            topic: The name, with or without its leading slash.

        Returns:
            (N,) nanoseconds, not always sorted: the stamp of the header, or of the first header in a sequence. Messages
            without a stamp use their receive time, converted to the clock of ``/clock`` if that was recorded.

        Raises:
            RecordingError: The topic does not exist.
        """
        return self._index.stamps(self._index.find_topic(topic))

    def received(self, topic: str) -> NDArray[np.int64]:
        """Return the receive times of a topic's messages: (N,) nanoseconds on the recorder's clock, sorted.

        Args:
            topic: The name, with or without its leading slash.

        Raises:
            RecordingError: The topic does not exist.
        """
        return self._index.received(self._index.find_topic(topic))

    def to_ros_time(self, receive_time: NDArray[np.int64]) -> NDArray[np.int64]:
        """Convert receive times to the clock of ``/clock``; unchanged if that was not recorded.

        Args:
            receive_time: (N,) nanoseconds, as returned by :meth:`receive_time`.
        """
        return self._index.to_ros_time(receive_time)

    def message_at(self, topic: str, stamp: StampLike) -> RecordedMessage | None:
        """Return the newest message of a topic at a time, or None before the first one.

        Args:
            topic: The name, with or without its leading slash.
            stamp: The time, on the clock of :meth:`stamps`.

        Raises:
            RecordingError: The topic does not exist.
        """
        name = self._index.find_topic(topic)
        row = self._index.newest_row(name, time.stamp_ns(stamp))
        return None if row is None else self._read_message(name, row)

    def first_frame(self, topic: str) -> str:
        """Return the frame_id in the header of a topic's first message, as published, or "" if it has none.

        Args:
            topic: The name, with or without its leading slash.

        Raises:
            RecordingError: The topic does not exist.
        """
        first = self._index.first_message(self._index.find_topic(topic))
        return "" if first is None else self._frame(*first)

    def frames(self, topic: str, rows: Iterable[int] | None = None) -> list[str]:
        """Return the frame_id in the headers of a topic's messages, as published, or "" where there is none.

        Args:
            topic: The name, with or without its leading slash.
            rows: The numbers of the messages in receive order, from 0, or None for all.

        Raises:
            RecordingError: The topic does not exist.
        """
        name = self._index.find_topic(topic)
        numbers = list(range(len(self._index.received(name))) if rows is None else rows)
        return [self._read_frame(name, row) for row in numbers] if self.may_have_header(name) else [""] * len(numbers)

    def _read_frame(self, name: str, row: int) -> str:
        channel = self._index.channel(name, row)
        header = self.types.peek_header(channel, self._index.head(name, row, HEADER_BYTES))
        if header is not None:
            return header.frame
        data = self._index.read(name, row)
        return "" if data is None else self._frame(channel, data)

    def may_have_header(self, topic: str) -> bool:
        """Return whether messages on a topic have a field ``header``, or True if their definition is unknown.

        Args:
            topic: The name, with or without its leading slash.

        Raises:
            RecordingError: The topic does not exist.
        """
        tracks = self._index.tracks(self._index.find_topic(topic))
        return any(self.types.may_have_header(track.channel) for track in tracks)

    def _frame(self, channel: Channel, data: bytes) -> str:
        header = self.types.peek_header(channel, data)
        if header is not None:
            return header.frame
        if not self.types.may_have_header(channel):
            return ""
        try:
            return str(self._decoder(channel)(data).header.frame_id)
        except (DecodeError, AttributeError):
            return ""

    @overload
    def table(
        self,
        columns: Literal["arrow", "pandas"] = "arrow",
        *,
        max_gap: DurationLike | None = None,
        on_gap: OnGap | None = None,
        validity: bool | None = None,
    ) -> Any: ...
    @overload
    def table(
        self,
        columns: ColumnLike | Sequence[ColumnLike],
        *,
        at: str | ArrayLike | None = None,
        rate: float | None = None,
        start: StampLike | str | None = None,
        stop: StampLike | str | None = None,
        method: Method = "nearest",
        tolerance: DurationLike | None = None,
        max_gap: DurationLike | None = None,
        on_gap: OnGap | None = None,
        covariance: bool = False,
        validity: bool | None = None,
    ) -> Table: ...
    def table(
        self,
        columns: ColumnLike | Sequence[ColumnLike] = "arrow",
        *,
        at: str | ArrayLike | None = None,
        rate: float | None = None,
        start: StampLike | str | None = None,
        stop: StampLike | str | None = None,
        method: Method = "nearest",
        tolerance: DurationLike | None = None,
        max_gap: DurationLike | None = None,
        on_gap: OnGap | None = None,
        covariance: bool = False,
        validity: bool | None = None,
    ) -> Any:
        """Return fields of messages and poses of frames at many times, or all transforms, as a table.

        Args:
            columns: Columns, each as text, as a pair of frames, or as a :class:`coframe.bags.Column`: whole messages
                (``"/odom"``), fields (``"/imu.angular_velocity"``, ``"/scan.ranges[0]"``,
                ``"/joint_states.position[elbow]"``), poses (``("map", "camera")`` or ``"map:camera"``) and their
                quantities (``"map:camera.yaw"``). Text may have a name and a method:
                ``"speed=/odom.twist.twist.linear.x@previous:100ms"``. Without columns, the table has all transforms,
                one row per sample and one edge after the other: ``"arrow"`` for a ``pyarrow.Table``, ``"pandas"`` for
                a ``DataFrame``.
            at: The topic at whose stamps the rows are, or an array of stamps, (N,) nanoseconds or datetime64. None: if
                all columns come from one topic, this one.
            rate: Rows per second (Hz) in the interval in which all columns have values, instead of ``at``.
            start: The first time; nanoseconds, or a string for :func:`coframe.bags.parse_time_point`.
            stop: The last time.
            method: Which messages the values at a time come from: the ``"nearest"``, the ``"previous"``, those
                with an equal stamp (``"match"``; ``tolerance`` is then the permitted difference), or ``"interpolate"``
                between two messages: numbers linearly, quaternions along the shortest arc. Poses of frames are always
                interpolated.
            tolerance: The maximum time between a row and a message, such as ``"20ms"``. None permits any, except for
                ``"match"``; a :class:`coframe.CoframeWarning` then reports values from unusually far away.
            max_gap: The maximum interval for interpolation, between two transforms of an edge or two messages, such as
                ``"200ms"``. None permits any; a :class:`coframe.CoframeWarning` then reports intervals of more than
                ten periods and 500 ms.
            on_gap: What to do about a missing value: mark it by ``"nan"`` (the default for columns), ``"omit"`` its
                row, or ``"raise"`` an ExtrapolationException (the default for all transforms, of which ``"nan"`` marks
                a gap by a row in its middle).
            covariance: Whether poses have the value ``covariance``, 36 numbers row by row. Edges whose covariance is
                not in the buffer get that of the Odometry messages with their frames.
            validity: Whether to add the values ``.valid`` and ``.age_ns`` (the time of the row minus that of the
                message) or ``.gap_ns`` (the interval of the interpolation) of each column; True by default. For all
                transforms, the column ``gap_ns``: the time since the previous sample of the edge; False by default.

        Returns:
            A :class:`coframe.bags.Table`, which converts to Arrow, pandas, polars, xarray and NumPy. For all transforms
            the columns ``stamp_ns`` (int64; 0 if static), ``parent``, ``child``, ``x``, ``y``, ``z`` (meters, expressed
            in the parent), ``qx``, ``qy``, ``qz``, ``qw``, ``static``, ``topic`` (on which the edge was last
            published).

        Raises:
            RecordingError: A topic or field does not exist, a column has no values, or a package is not installed.
            TransformException: A frame does not exist, or the frames are not connected.
            ExtrapolationException: A value is missing, with ``on_gap="raise"``.
            ValueError: A format, method or ``on_gap`` is unknown, or a limit is out of range.
        """
        if isinstance(columns, str) and columns.isidentifier():
            buffers = self.buffers.values()
            return edge_table(buffers, columns, max_gap=max_gap, on_gap=on_gap or "raise", validity=bool(validity))
        topic, stamps = (at, None) if at is None or isinstance(at, str) else (None, at)
        query = TableQuery(
            columns,
            at=topic,
            rate=rate,
            start=start,
            stop=stop,
            method=method,
            tolerance=tolerance,
            max_gap=max_gap,
            on_gap=on_gap or "nan",
            covariance=covariance,
            validity=validity is not False,
        )
        sentences: list[str] = []
        table = run_query(self, query, stamps, sentences.append)
        for sentence in sentences:
            warnings.warn(sentence, CoframeWarning, stacklevel=2)
        return table

    def trajectory(
        self,
        source: str | tuple[str, str],
        *,
        start: StampLike | str | None = None,
        stop: StampLike | str | None = None,
        max_gap: DurationLike | None = None,
    ) -> Transform:
        """Return the poses in the messages on a topic, or those of a frame, as a batch with stamps.

        Args:
            source: A topic with Odometry, PoseStamped, PoseWithCovarianceStamped, TransformStamped or other messages
                that contain a pose (``"/odom"``), or a field (``"/state.pose"``); of Path, the last message counts. Or
                two frames, ``("map", "base_link")`` or ``"map:base_link"``, as in :meth:`coframe.Buffer.trajectory`.
            start: The first stamp; nanoseconds, or a string for :func:`coframe.bags.parse_time_point`.
            stop: The last stamp.
            max_gap: Omit poses of two frames that are interpolated over a longer interval between two transforms of an
                edge, such as ``"500ms"``. None interpolates over any gap.

        Returns:
            A batch of shape (N,), sorted by stamp, with its covariances if the messages have some.

        Raises:
            RecordingError: The topic does not exist, or its messages contain no poses, or there are none between the
                start and the stop.
            TransformException: A frame does not exist, or the frames are not connected.
        """
        parsed = column(source).parsed
        if isinstance(parsed, PathSource):
            raise RecordingError(f"{source} is a file", hint="coframe.trajectories.read_trajectory reads files.")
        if isinstance(parsed, FieldSource):
            sentences: list[str] = []
            poses = topic_poses(self, parsed, sentences.append)
            for sentence in sentences:
                warnings.warn(sentence, CoframeWarning, stacklevel=2)
        else:
            poses = self.buffer.trajectory(parsed.target, parsed.source, max_gap=max_gap, on_gap="omit")
        stamps = np.atleast_1d(np.asarray(poses.stamps, dtype=np.int64))
        inside = np.ones(len(stamps), dtype=bool)
        for when, keep in ((start, np.greater_equal), (stop, np.less_equal)):
            if when is not None:
                inside &= keep(
                    stamps, parse_time_point(when, self.span) if isinstance(when, str) else time.stamp_ns(when)
                )
        if not inside.any():
            raise RecordingError(f"{source} has no poses between start and stop")
        return poses if inside.all() else poses[inside]

    def dataframe(
        self,
        topic: str,
        *,
        start: StampLike | str | None = None,
        stop: StampLike | str | None = None,
    ) -> Any:
        """Return the messages on a topic as a ``pandas.DataFrame``, with a column for each number and string in them.

        Args:
            topic: The name of the topic, or of a field of its messages: ``"/odom"``, ``"/odom.pose.pose"``.
            start: The first stamp; nanoseconds, or a string for :func:`coframe.bags.parse_time_point`.
            stop: The last stamp.

        Returns:
            A data frame with one row per message, sorted by stamp. Its index are the stamps as datetime64; the first
            column is ``stamp_ns``, and the others are named after the fields: ``pose.pose.position.x``.

        Raises:
            RecordingError: The topic or field does not exist, the topic has no messages, or pandas is not installed.
        """
        name = topic if topic.startswith("/") else f"/{topic}"
        table: Table = self.table([name], start=start, stop=stop, validity=False)
        frame = table.to_pandas()
        frame.columns = [each.removeprefix(name).removeprefix(".") or name.rpartition(".")[2] for each in frame.columns]
        frame.index = table.stamps.astype("datetime64[ns]")
        frame.index.name = "stamp"
        return frame

    def _read_all(self, name: str, rows: NDArray[np.intp]) -> Iterator[RecordedMessage]:
        for row in rows.tolist():
            message = self._read_message(name, row)
            if message is not None:
                yield message

    def _read_message(self, name: str, row: int) -> RecordedMessage | None:
        """Return one message, or None if it can no longer be read, which is added to the problems."""
        data = self._index.read(name, row)
        if data is None:
            return None
        channel = self._index.channel(name, row)
        stamp, received = int(self._index.stamps(name)[row]), int(self._index.received(name)[row])
        return RecordedMessage(name, channel.type, stamp, received, data, self._decoder(channel))

    def _decoder(self, channel: Channel) -> Callable[[bytes], Any]:
        key = id(channel)
        if key not in self._decoders:
            self._decoders[key] = decoder(channel, self.types, self._problems)
        return self._decoders[key]

    def close(self) -> None:
        """Close the files. The transforms remain available."""
        self._index.close()
        self._closing.close()

    @property
    def is_waiting(self) -> bool:
        """Whether the recording is on a server, and its transforms have not been read."""
        return self._index.is_waiting and "_buffers" not in self.__dict__

    def part(self, window: TimeWindow) -> Recording:
        """Return a part of a recording on a server. It is closed together with this recording."""
        if self._part is None or self._part.window != window:
            self._part = open_with_choice(self.path, self.choice, window=window)
            self._part.disown()
        return self._part

    def disown(self) -> None:
        """Keep the files open when this recording is closed, because another recording owns them."""
        self._closing.pop_all()

    def __reduce__(self) -> tuple[object, ...]:
        path = self.path
        return _reopen_recording, (path.absolute() if isinstance(path, Path) else path, self.choice, self.window)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __repr__(self) -> str:
        seconds = self.duration / time.SECOND
        return f"Recording({str(self.path)!r}, {len(self.topics)} topics, {seconds:.1f} s)"

    def show(self, **options: Any) -> Viewer:
        """Show the recording in the viewer, or below the cell in a notebook. This is the same as :func:`coframe.show`.

        Args:
            options: The options of :func:`coframe.show`, such as ``fixed="map"``.
        """
        from coframe.viewer.show import show as show_in_browser  # noqa: PLC0415 - the viewer is above this module

        return show_in_browser(self, **options)

    def _repr_html_(self) -> str:
        problems = ((sentence,) for sentence in self.problems)
        return html_tables.section(
            repr(self),
            self.topics.html_table(),
            html_tables.paragraph(f"The buffer has {count(len(self.buffer.frame_names()), 'frame')}."),
            html_tables.table(("problems",), problems, len(self.problems), "problem"),
        )
