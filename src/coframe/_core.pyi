# SPDX-License-Identifier: Apache-2.0
"""The native core. Private: use `import coframe`."""

from collections.abc import Callable, Sequence
from types import ModuleType
from typing import Any

from coframe.time import DurationLike, StampLike
from coframe.transform.transform import Transform as PublicTransform

class Transform:
    """One pose with its frames and stamp, or a batch of them."""

    def __init__(
        self,
        x: float,
        y: float,
        z: float,
        qx: float,
        qy: float,
        qz: float,
        qw: float,
        target: str | None,
        source: str | None,
        stamp: int | None,
        batch: Any,
        extrapolated: int = 0,
        uncertainty: Any = None,
    ) -> None: ...
    @property
    def values(self) -> tuple[float, float, float, float, float, float, float]:
        """(x, y, z, qx, qy, qz, qw) as floats, translation in meters; for a batch an array of shape (..., 7)."""

    @property
    def stamp(self) -> int | None:
        """Time in nanoseconds, or None."""

    @property
    def target(self) -> str | None:
        """The target frame, in which the values are expressed, or None."""

    @property
    def source(self) -> str | None:
        """The source frame, whose pose the values are, or None."""

    @property
    def _extrapolated(self) -> int:
        """How far the lookup extrapolated beyond the samples of an edge, in nanoseconds."""

    @property
    def _batch(self) -> Any:
        """None, or (translations, quaternions, stamps, extrapolated) as arrays; the last two may be None."""

    @property
    def _uncertainty(self) -> Any:
        """None, or (covariance (..., 6, 6), names of the edges that count as exact)."""

class Failure:
    """The facts of a failed lookup; str() returns the text of tf2."""

    @property
    def code(self) -> str: ...
    @property
    def target(self) -> str: ...
    @property
    def source(self) -> str: ...
    @property
    def requested(self) -> int | None: ...
    @property
    def earliest(self) -> int | None: ...
    @property
    def latest(self) -> int | None: ...
    @property
    def edge(self) -> tuple[str, str] | None: ...
    @property
    def roots(self) -> tuple[str, str] | None: ...
    @property
    def name(self) -> str: ...
    @property
    def parents(self) -> dict[str, str]: ...
    @property
    def recorded(self) -> bool:
        """Whether the buffer is frozen or keeps everything, as recordings do: no further transforms are expected."""

class Buffer:
    """The native buffer; coframe.Buffer is the public class derived from it."""

    def __init__(self, cache_ns: int, along_screws: bool = False) -> None: ...
    @property
    def _along_screws(self) -> bool:
        """Whether poses are interpolated along screws."""

    @property
    def cache_ns(self) -> int:
        """Length of the cache for dynamic transforms in nanoseconds; negative if the buffer keeps everything."""

    def lookup(
        self,
        target: str,
        source: str,
        stamp: StampLike | None = None,
        *,
        timeout: DurationLike | None = None,
        extrapolate: DurationLike | None = None,
        hold: bool = False,
        max_gap: DurationLike | None = None,
        fixed: str | None = None,
        source_time: StampLike | None = None,
        covariance: bool = False,
    ) -> PublicTransform:
        """Return the transform at `stamp` that transforms data from `source` into `target`.

        Args:
            target: The target frame.
            source: The source frame.
            stamp: Time of the lookup: nanoseconds, datetime64, an aware datetime, or a Time; 0 or None means the
                latest time at which all edges between the frames have data.
            timeout: How long to wait for the transform, such as ``"100ms"``; None and 0 do not wait. Other Python
                threads run in the meantime.
            extrapolate: How far the lookup may extrapolate beyond the samples of an edge, such as ``"50ms"``, after
                waiting has not helped; None does not extrapolate, as tf2.
            hold: Whether extrapolation holds the last pose instead of continuing with the last twist.
            max_gap: The longest interval between two samples of an edge that the lookup may interpolate over, such as
                ``"200ms"``; None interpolates over any, as tf2.
            fixed: A frame that does not move between `source_time` and `stamp`: the lookup returns the pose of
                `source` at `source_time` in `target` at `stamp`, like tf2's lookupTransform with six arguments.
            source_time: Time of `source`, by default `stamp`; needs `fixed`.
            covariance: Whether to compose the covariances of the edges. Edges without one count as exact and are
                listed in the `exact_edges` of the result.

        Returns:
            A single transform: translation in meters, unit quaternion x, y, z, w, and the time of the lookup in
            ``stamp``. Its ``extrapolated`` is the length of the extrapolation in nanoseconds.

        Raises:
            LookupException: A frame does not exist, or the tree contains a loop.
            ConnectivityException: The frames are in different trees.
            ExtrapolationException: An edge has no sample at that time, or that time lies in a gap above `max_gap`.
            InvalidArgumentException: A name is empty or has a leading slash.
            TypeError: A stamp or duration has a wrong type, such as a float of seconds.
            ValueError: A duration is an int below one microsecond, such as 2, or is text without a unit.

        Example:
            >>> import coframe
            >>> buffer = coframe.Buffer()
            >>> for second in (1, 2):
            ...     _ = buffer.set("odom", "base", coframe.Transform([second, 0, 0]), second * 1_000_000_000)
            >>> buffer.lookup("odom", "base", 1_500_000_000).translation.tolist()
            [1.5, 0.0, 0.0]
        """

    def _lookup_full(
        self,
        target: str,
        target_stamp: StampLike | None,
        source: str,
        source_stamp: StampLike | None,
        fixed: str,
        *,
        timeout: DurationLike | None = None,
    ) -> PublicTransform:
        """Return the pose of `source` at `source_stamp` relative to `target` at `target_stamp`.

        The frame `fixed` is assumed not to move between the two times. Raises as lookup().
        """

    def _lookup_rows(
        self,
        target: str,
        source: str,
        stamps: Any,
        poses: Any,
        twists: Any,
        extrapolated: Any,
        on_error: str,
        threads: int,
        extrapolate: DurationLike | None = None,
        hold: bool = False,
    ) -> int:
        """Do lookup() for each of the `stamps`, which become the stamps of the results; the arrays are written to.

        Returns:
            The first row without a transform that is an error, unless NaN marks such rows; the number of rows if there
            is none.
        """

    def _stamps_between(self, target: str, source: str, first: int, last: int) -> bytes:
        """Return the stamps of all samples between two times on the edges between two frames, sorted, as int64."""

    def _set_rows(
        self, parent: str, child: str, stamps: Any, poses: Any, static: bool, authority: str
    ) -> tuple[int, int, int]:
        """Call _set_values() for each row; return rejection reasons, the number stored, and the first rejected row."""

    def can_transform(
        self, target: str, source: str, stamp: StampLike | None = None, *, timeout: DurationLike | None = None
    ) -> bool:
        """Return whether :meth:`lookup` would succeed, or succeeds within `timeout`.

        Args:
            target: The target frame.
            source: The source frame.
            stamp: Time of the lookup, as in :meth:`lookup`.
            timeout: How long to wait for the transform; None and 0 do not wait.
        """

    def _can_transform_full(
        self,
        target: str,
        target_stamp: StampLike | None,
        source: str,
        source_stamp: StampLike | None,
        fixed: str,
        *,
        timeout: DurationLike | None = None,
    ) -> bool:
        """Return whether _lookup_full() would succeed, or succeeds within `timeout`."""

    def _why_not(self, target: str, source: str, stamp: StampLike | None = None) -> str:
        """Return tf2's text for why can_transform() is False; "" if it is True."""

    def _why_not_full(
        self, target: str, target_stamp: StampLike | None, source: str, source_stamp: StampLike | None, fixed: str
    ) -> str:
        """Return tf2's text for why _can_transform_full() is False; "" if it is True."""

    def latest_common_time(self, target: str, source: str) -> int:
        """Return the newest time at which every edge between two frames has data.

        Returns:
            Nanoseconds; 0 if all edges are static.

        Raises:
            LookupException: A frame does not exist.
            TransformException: The frames are in different trees, or the tree contains a loop (tf2 chooses the class).
        """

    def chain(
        self, target: str, target_stamp: StampLike | None, source: str, source_stamp: StampLike | None, fixed: str
    ) -> list[str]:
        """Return the frames on the path from `source` through `fixed` to `target`.

        Args:
            target: The target frame.
            target_stamp: Time of the target, as in :meth:`lookup`.
            source: The source frame.
            source_stamp: Time of the source, as in :meth:`lookup`.
            fixed: A frame that does not move between the two times.

        Raises:
            TransformException: As :meth:`lookup`.
        """

    def _set_values(
        self,
        parent: str,
        child: str,
        stamp: int,
        x: float,
        y: float,
        z: float,
        qx: float,
        qy: float,
        qz: float,
        qw: float,
        static: bool,
        authority: str,
    ) -> int:
        """Store a transform from numbers; return 0, or the reasons for rejection as bits (see insert_texts)."""

    def _set_plain(
        self, parent: str, child: str, transform: PublicTransform, stamp: StampLike | None, static: bool
    ) -> int | None:
        """Do as _set_values() for a dynamic Transform between known frames; return None for any other case."""

    def _set_message(self, message: Any, static: bool, authority: str) -> int | None:
        """Do as _set_values() for a TransformStamped between known frames; return None for any other case."""

    def _lookup_message(self, target: str, source: str, time: Any) -> Any:
        """Return lookup() as a TransformStamped for a Time; None if lookup() has to decide."""

    def ingest(self, cdr: Any, *, static: bool = False, authority: str = "no recorded authority") -> int:
        """Store the transforms of a serialized tf2_msgs/msg/TFMessage, all of them or none.

        Args:
            cdr: The message as CDR bytes.
            static: Whether the transforms are static, as on /tf_static.
            authority: Name of the publisher, as reports show it.

        Returns:
            The number of stored transforms.

        Raises:
            DecodeError: The bytes are not a TFMessage; `statistics` counts such messages.
        """

    def encode(self, *, static: bool) -> bytes:
        """Return the newest sample of every static, or of every dynamic, frame as the CDR bytes of one TFMessage."""

    def clear(self) -> None:
        """Remove all dynamic samples; frames stay known, and static transforms stay, as in tf2."""

    def remove_frame(self, name: str) -> bool:
        """Remove a frame with the edges to its parent and to its children, also static ones.

        Returns:
            Whether the frame existed.
        """

    def freeze(self) -> None:
        """Make the buffer read-only: from now on it stores nothing and removes nothing."""

    @property
    def frozen(self) -> bool:
        """Whether the buffer is read-only."""

    def _on_local_change(self, call: Callable[[], object] | None) -> None: ...
    def _stop_following(self) -> None: ...
    @property
    def _following(self) -> bool: ...
    def _become_snapshot(self, other: Buffer, along_screws: bool) -> None:
        """Become a frozen copy of `other` as it is now; only for a buffer that is not used yet."""

    def _frame_tuples(self) -> list[tuple[str, str, bool, int, int, int, float, str]]: ...
    def _edge_tuples(
        self,
        children: Sequence[str] | None = None,
    ) -> list[
        tuple[
            tuple[str, str, bool, int, int, int, float, str],
            tuple[float, float, float],
            tuple[int, int, int, int, int, int, int],
        ]
    ]: ...
    def _edge_at(self, child: str, stamp: int) -> tuple[str, str, int, int] | None:
        """Return the state of a frame's samples at a time; 0 is the latest. None for a frame without a parent.

        Returns:
            The state (``ok``, or a code of Failure such as ``too_new``), the parent at that time (or the last parent if
            there is no sample at that time; "" without any), and the stamps of the samples before and after.
        """

    def frame_names(self) -> list[str]:
        """Return the names of all frames in the order in which the buffer received them, a child before its parent."""

    def frame_exists(self, name: str) -> bool:
        """Return whether the buffer has received a transform that names the frame."""

    def all_frames_as_string(self) -> str:
        """Return tf2's text of the tree, with one line per frame."""

    def all_frames_as_yaml(self) -> str:
        """Return tf2's YAML of the tree; unlike in tf2, it is valid YAML for every frame name."""

    def all_frames_as_dot(self, now: int = 0) -> str:
        """Return tf2's graphviz text of the tree.

        Args:
            now: Current time in nanoseconds, for ages and a legend; 0 omits them.
        """

    @property
    def statistics(self) -> dict[str, int]:
        """Counters: ``messages``, ``malformed`` (ingested as bytes); ``stored``, ``refused``, ``old`` (transforms).

        ``over_limit`` counts the refused transforms of other nodes with a new frame beyond 250 000 frames or 64 MiB of
        names.
        """

    @property
    def _changes(self) -> int:
        """A counter that increases with every insertion."""

class SegmentError(OSError): ...

class Segment:
    """A transform tree in memory that the processes of a user share."""

    @staticmethod
    def open(folder: str, name: str, cache_ns: int) -> Segment:
        """Open a tree, or create it; raise SegmentError if sharing is not possible here."""

    def follow(self, buffer: Buffer, authority: str = "") -> bool:
        """Let an empty buffer read the tree from now on; return False if it is not empty.

        With an authority, that is the source of all transforms.
        """

    def try_to_write(self) -> bool:
        """Become the writer if there is none; return whether it is."""

    def write(self, buffer: Buffer) -> None:
        """Let a new buffer write the tree, after try_to_write() has succeeded."""

    @property
    def writer_process(self) -> int:
        """The process that writes, or wrote last."""

    def wait_for_vacancy(self, timeout_ns: int) -> None:
        """Wait until there may be no writer, an interrupt, or the timeout (negative: no limit)."""

    def interrupt(self) -> None:
        """End the wait of another thread."""

    @property
    def outdated(self) -> bool:
        """Whether the tree contains static transforms that are no longer published."""

    @property
    def used(self) -> int:
        """Bytes in use."""

    @property
    def lost(self) -> bool:
        """Whether another program has truncated the memory."""

    @property
    def shortage(self) -> str:
        """Why the tree could not grow; empty if it could."""

    def close(self) -> None:
        """Stop writing, and no longer keep the tree."""

class Mailbox:
    """A queue of tokens that waits and watches put when something has happened."""

    def __init__(self) -> None: ...
    def put(self, token: int) -> None:
        """Put a token from Python."""

    @property
    def empty(self) -> bool: ...
    def take(self) -> list[int]:
        """Return and remove the tokens."""

    def wait(self, timeout_ns: int) -> bool:
        """Wait without the GIL until there is a token (True) or the time is over (negative: no limit)."""

class Wait:
    """A lookup that waits until it succeeds."""

    def transform(self) -> PublicTransform | None:
        """Return the transform, or None while there is none."""

    def cancel(self) -> None:
        """Stop waiting."""

class Watch:
    """Records which edges change."""

    def take(self) -> list[str]:
        """Return the child frames of the edges that have changed since the last call."""

    def cancel(self) -> None:
        """Stop watching."""

def wait(buffer: Buffer, mailbox: Mailbox, token: int, target: str, source: str, stamp: StampLike | None) -> Wait:
    """Start a lookup whose token is put into the mailbox once it succeeds."""

def wait_full(
    buffer: Buffer,
    mailbox: Mailbox,
    token: int,
    target: str,
    target_stamp: StampLike | None,
    source: str,
    source_stamp: StampLike | None,
    fixed: str,
) -> Wait:
    """Start a _lookup_full whose token is put into the mailbox once it succeeds."""

def watch(buffer: Buffer, mailbox: Mailbox, token: int, child: str) -> Watch:
    """Put the token into the mailbox when the edge from `child` to its parent changes; "": any edge."""

class MessageCodec:
    """Reads and writes the messages of a class."""

    def __init__(
        self, cls: type, fields: list[tuple[str, str | MessageCodec, int, int, int, Any]], ros1_prefix: int = 0
    ) -> None:
        """Each field is a tuple (slot, item, container, size, text_bound, dtype).

        The item is the struct code of a number, an empty string for strings, or the MessageCodec of a message. The
        container is 0 for a single item, 1 for an array of `size` items, 2 for a sequence of at most `size`. 0 is no
        limit. `dtype` is that of an array of numbers. `ros1_prefix` is how many bytes a message of ROS 1 has before its
        fields.
        """

    def encode(self, message: Any) -> bytes | None:
        """Return the CDR of a message, or None if Python code has to serialize it."""

    def decode(self, data: Any, max_rest: int = ...) -> Any:
        """Return the message in CDR bytes, or None if Python code has to read it.

        Args:
            data: The bytes.
            max_rest: The number of bytes that may follow the message. If there are more, None is returned.
        """

    def decode_ros1(self, data: Any) -> Any:
        """Return the message in bytes of ROS 1, or None if Python code has to read it."""

class Event:
    """A flag that DDS threads and Python set, and for which one thread waits without the GIL."""

    def __init__(self) -> None: ...
    def set(self) -> None:
        """Set the flag and wake the waiting thread."""

    def clear(self) -> None:
        """Clear the flag."""

    def wait(self, timeout_ns: int | None) -> bool:
        """Wait until the flag is set and clear it (True), or until timeout_ns has passed (False); None: no limit."""

def insert_texts(
    refusals: int,
    parent: str,
    child: str,
    stamp: int,
    x: float,
    y: float,
    z: float,
    qx: float,
    qy: float,
    qz: float,
    qw: float,
    authority: str,
) -> list[tuple[str, str]]:
    """Return tf2's log lines for a transform that _set_values rejected: (level, text)."""

def register_buffer_class(cls: type[Buffer]) -> None:
    """Copy the most frequent methods into a class derived from Buffer.

    CPython has a shorter way to call own class faster.
    """

def register_transform_class(cls: type[Transform]) -> None:
    """Register the class of lookup results, a subclass of Transform."""

def new_transform(
    x: float,
    y: float,
    z: float,
    qx: float,
    qy: float,
    qz: float,
    qw: float,
    target: str | None,
    source: str | None,
    stamp: int | None,
    batch: Any,
    extrapolated: int = 0,
    uncertainty: Any = None,
    /,
) -> PublicTransform:
    """Return a transform of the registered class with exactly these values."""

def compose_single(a: Transform, b: Transform) -> PublicTransform | None:
    """Compose two single transforms without covariances; None for others, and if the inner frames differ."""

def invert_single(transform: Transform) -> PublicTransform | None:
    """Invert a single transform without covariance; None for others."""

def compose_batches(a: tuple[Any, Any], b: tuple[Any, Any], inverse: bool, out: Any) -> None:
    """Write a b, or a^-1 b, to `out`, (n, 7) float64: x, y, z, qx, qy, qz, qw.

    The poses are translations (n, 3) and quaternions (n, 4), float64 with contiguous rows; (1, ...) repeats one.
    """

def exponentials(twists: Any, out: Any) -> None:
    """Write the exponentials of twists (n, 6), linear and angular, to `out`, (n, 7)."""

def logarithms(poses: tuple[Any, Any], out: Any) -> None:
    """Write the logarithms of poses, as for compose_batches(), to `out`, (n, 6)."""

def interpolate_batches(a: tuple[Any, Any], b: tuple[Any, Any], fractions: Any, screw: bool, out: Any) -> None:
    """Write poses between a and b to `out`, (n, 7), along screw motions or with slerp; fractions are (n,) or (1,)."""

def register_messages(
    transform_stamped: type,
    header: type,
    time: type,
    rclpy_time: type,
    transform: type,
    vector3: type,
    quaternion: type,
) -> None:
    """Register the classes that _set_message() reads and _lookup_message() creates."""

def register_errors(errors: ModuleType) -> None:
    """Register the module whose exceptions are raised for failures."""

def register_time(time: ModuleType) -> None:
    """Register the module that converts stamps and durations other than int."""

CPU_LEVEL: str
CPU_LEVELS: tuple[str, ...]

def mcap_records(data: Any) -> tuple[bytes, bytes, bytes, bytes, bytes, list[tuple[int, int, int]], int]:
    """Return the positions of the messages in MCAP records, up to the first truncated or other record.

    Returns:
        For each message its channel (uint16), log time (uint64), and the start of its record, the start of its bytes
        and their end (uint64); for each schema and channel its opcode, start and end; the number of bytes processed.
    """

def ingest_slices(
    buffer: Buffer,
    data: Any,
    starts: Any,
    ends: Any,
    static: bool,
    authority: str,
    encoding: str = "cdr",
    renaming: Renaming | None = None,
) -> tuple[int, str]:
    """Ingest many slices of `data`, given by uint64 arrays; return how many are malformed, and why the first is.

    `encoding` is "cdr", or "ros1" for tf2_msgs/TFMessage and tf/tfMessage of ROS 1.
    """

def transform_columns(
    data: Any, starts: Any, ends: Any, encoding: str = "cdr"
) -> tuple[bytes, bytes, bytes, bytes, bytes, list[str], int, str]:
    """Return the transforms of many TFMessages as they were sent, without a buffer's checks.

    Returns:
        For each transform the index of its message (uint32), its stamp (int64), the indices of its parent's and
        child's name (uint32), x, y, z, qx, qy, qz, qw (float64); the names; how many messages are malformed, and why
        the first is.
    """

class JointTree:
    """A joint tree and the forward kinematics of its links.

    Args:
        root: The root link.
        joints: Parents before children: name, type, parent link, child link, origin (x, y, z, qx, qy, qz, qw), axis,
            and the joint it mimics as (joint, multiplier, offset), or None.

    Raises:
        ValueError: A child comes before its parent, or joints mimic each other in a cycle.
    """

    def __init__(self, root: str, joints: list[tuple[object, ...]]) -> None: ...
    def transforms(self, positions: dict[str, Any], in_root: bool) -> dict[str, PublicTransform] | None:
        """Return the transforms of one configuration: of links relative to the root, or of joints to the previous link.

        Args:
            positions: By joint: a number, or a list or tuple of them for a joint that has several.
            in_root: True for links relative to the root link.

        Returns:
            None if a position is not finite, has the wrong size, or belongs to no movable joint.
        """

    def poses_into(
        self, positions: list[tuple[str, Any]], count: int, in_root: bool, out: Any, threads: int
    ) -> str | None:
        """Compute the poses of many configurations.

        Args:
            positions: (joint, float64 array) with the shape (N,), or (N, size) for joints with several numbers.
            count: N.
            in_root: See transforms().
            out: (J, N, 7) float64, filled in the order of the joints.
            threads: Number of threads.

        Returns:
            The first joint with a position that is not finite, or with a zero quaternion; None if there is none.
        """

def transform_fields(pose: Sequence[float], fields: Sequence[Sequence[Any]], threads: int) -> None:
    """Transform points by a pose (x, y, z, qx, qy, qz, qw), in place.

    Args:
        pose: The transform to apply.
        fields: Triples of float32 or float64 arrays of one shape, with one or two axes and any strides: the position,
            then directions, which are only rotated.
        threads: Number of threads.
    """

def unfilter_png(rows: Any, pixels: Any, row_bytes: int, pixel_bytes: int) -> bool:
    """Undo the filters of PNG rows into `pixels`; return whether all filters are known."""

def decode_rvl(words: Any, depths: Any) -> bool:
    """Decode an RVL depth image, uint32 words, to uint16 `depths`; return whether the data is complete."""

def deskew_fields(
    buffer: Buffer,
    target: str,
    source: str,
    times: Any,
    result_from_target: Sequence[float],
    fields: Sequence[Sequence[Any]],
    nan_for_missing: bool,
    threads: int,
) -> tuple[int, int]:
    """Transform points from `source` to `target`, each at its own time, and then by a pose, in place.

    Args:
        buffer: The buffer with the motion.
        target: The fixed frame.
        source: The sensor's frame.
        times: int64 nanoseconds, one per point; 0 is the latest, the smallest int64 means none.
        result_from_target: The pose of `target` relative to the frame of the result.
        fields: See transform_fields().
        nan_for_missing: Points without a transform become NaN; otherwise no point changes if one has no transform.
        threads: Number of threads.

    Returns:
        How many points have no transform, and the first of them. If all of them have none, no point changes.
    """

class PoseTable:
    """Many frames that are looked up together repeatedly, by one thread.

    Args:
        buffer: The buffer to look up in.
        fixed: The frame that the poses are relative to.
        frames: N frames.
        roots: For each frame None, or the frame that its pose is relative to instead of `fixed`.
    """

    def __init__(self, buffer: Buffer, fixed: str, frames: list[str], roots: list[str | None]) -> None: ...
    def look_up(self, stamp: int, hold: int, poses: Any, states: Any) -> None:
        """Compute the poses of all frames at one time.

        Args:
            stamp: Nanoseconds; 0 is the latest of each frame.
            hold: For how many nanoseconds after its last sample an edge is assumed not to move.
            poses: (N, 7) float64, receives x, y, z, qx, qy, qz, qw, or NaN.
            states: (N,) uint8, receives 0: exact; 1: held after the last sample of an edge; 2: no pose; 3: relative to
                its own root.
        """

def poses_near(poses: Any, states: Any, origin: Any, fixed: int, limit: float, near: Any) -> int:
    """Write poses as float32 relative to an origin; return how many are far from it.

    Args:
        poses: (N, 7) float64: x, y, z, qx, qy, qz, qw.
        states: (N,) uint8: the states of `PoseTable.look_up`.
        origin: (3,) float64.
        fixed: The index of a frame that is not counted; -1: none.
        limit: The distance along an axis from which a frame is far; only frames with state 0 or 1 are counted.
        near: (N, 7) float32, receives the poses.
    """

class Renaming:
    """Add a prefix to the names of frames, except those to keep."""

    def __init__(self, prefix: str, keep: Sequence[str]) -> None: ...
    def __call__(self, name: str) -> str:
        """Return the renamed frame."""

class Relay:
    """Merge the TFMessages of several sources into one tree. Not thread-safe."""

    def __init__(self, static: bool, period: int, max_error: tuple[float, float] | None = None) -> None:
        """Write all edges at once if `static`, else at most one transform of each edge per `period` nanoseconds.

        With `max_error`, in meters and radians, transforms are sent only if interpolation would otherwise be wrong by
        more than that; a robot that moves is sent at least once per `period`.

        Raises:
            ValueError: The maximum error is negative, or its angle above 45 degrees.
        """

    def add_source(self, renaming: Renaming, split: bool) -> int:
        """Add a source; return its number. With `split`, only kept or prefixed frames pass; the prefix goes."""

    def add(self, source: int, writer: int, message: bytes, at: int = -1) -> None:
        """Add a message from a writer of a source.

        Args:
            source: Its number.
            writer: Any number for the writer.
            message: A TFMessage as CDR; malformed messages are counted.
            at: The arrival time in nanoseconds of a monotonic clock; negative: now, by the steady clock.
        """

    def take(self, at: int = -1) -> bytes | None:
        """Return one message with everything to send since the last call, or None.

        Args:
            at: The current time, as for `add`.
        """

    def next_due(self) -> int | None:
        """Return when `take` has something to send although nothing is added, or None."""

    def forget_writer(self, source: int, writer: int) -> None:
        """Forget a writer that has disappeared."""

    def edges(self) -> list[tuple[str, str, int, int, int | None, int, int, int, int, int]]:
        """Return the statistics of each edge.

        Returns:
            Parent and child as they are written; the relayed source and the writer of its last message; a source that
            publishes something different, or None, and how often; how many transforms were passed on and how many were
            dropped for the rate or the maximum error; the newest stamp; the arrival time of the last transform.
        """

    def writers(self, source: int) -> list[tuple[tuple[int, int, int, int, int | None, str, str, str], int, int, int]]:
        """Return each writer of a source: see TfReader.writers(); malformed messages; invalid, surplus transforms."""

def frozen_parts(buffer: Buffer) -> tuple[bytes, int]:
    """Return the table of a frozen buffer for a file, and its number of sample chunks."""

def frozen_chunks(buffer: Buffer, first: int, count: int) -> bytes:
    """Return the bytes of some of these chunks; fewer at the end."""

class MemoryGuard:
    """Lets reads of a mapped file fail that another program truncates, which would end this process.

    Args:
        memory: The mapping, an `mmap.mmap`; kept as long as it is needed.
        loss: The text of the error.
    """

    def __init__(self, memory: Any, loss: str) -> None: ...
    def check(self) -> None:
        """Raise the error if the memory is lost."""

def become_frozen(
    buffer: Buffer, file: MemoryGuard, table: int, table_size: int, samples: int, samples_size: int
) -> str:
    """Restore a new buffer from a file's bytes, which are used in place.

    Args:
        buffer: A new buffer.
        file: The whole file; kept as long as it is needed.
        table: Where the table begins.
        table_size: How many bytes it has.
        samples: Where the chunks of samples begin, at a multiple of 64.
        samples_size: How many bytes they have.

    Returns:
        What is wrong with them; "" if they are valid.
    """

def samples_of(buffer: Buffer, child: str) -> tuple[bytes, bytes, bytes, list[str]]:
    """Return the samples of one frame of a frozen buffer.

    Returns:
        Stamps (int64), poses (rows of 7 float64: x, y, z, qx, qy, qz, qw), the index of each parent's name (uint32),
        the names.
    """

PARTICIPANTS: int
PUBLICATIONS: int
SUBSCRIPTIONS: int

class EndpointError(RuntimeError):
    """An operation on an endpoint failed."""

def load_dds(path: str) -> str:
    """Load the DDS library and return its release, "0.10" or "11"; raise RuntimeError if it is not usable."""

def create_unchecked_topic(participant: int, name: str, type_name: str) -> int:
    """Create a topic whose readers check the bytes themselves; return its handle."""

def is_tf_message(message: bytes) -> bool:
    """Return whether the bytes are a serialized TFMessage."""

class QosProfile:
    """The QoS policies that ROS programs set. Durations are in nanoseconds."""

    def __init__(
        self,
        depth: int,
        reliable: bool,
        transient_local: bool,
        keep_all: bool,
        manual_liveliness: bool = False,
        deadline: int = ...,
        lifespan: int = ...,
        lease: int = ...,
        partitions: list[str] = ...,
    ) -> None: ...

DEADLINE_MISSED: int
LIVELINESS: int
INCOMPATIBLE_QOS: int
MATCHED: int
SAMPLE_LOST: int

class DomainParticipant:
    """A DDS domain of this process and a participant in it."""

    def __init__(self, domain: int, config: str, user_data: str) -> None: ...
    @property
    def entity(self) -> int:
        """DDS's number for the participant; 0 after close."""

    @property
    def guid(self) -> bytes: ...
    def set_user_data(self, user_data: str) -> None:
        """Replace the user data. If they differ, DDS announces the participant at once."""

    def close(self) -> None:
        """End the participant and DDS's threads."""

class Writer:
    """A DDS writer of serialized messages."""

    def __init__(
        self,
        participant: int,
        topic: int,
        qos: QosProfile,
        user_data: str,
        checks_transforms: bool = False,
        on_change: Event | None = None,
    ) -> None: ...
    def write(self, message: bytes) -> None:
        """Send one serialized message without the GIL."""

    def publish(self, codec: MessageCodec, message: Any) -> bool:
        """Serialize and send a message; return False if Python code has to serialize it."""

    def direct(
        self, codec: MessageCodec, closed: Event, failure: Callable[[str], BaseException], of_items: bool
    ) -> Callable[[Any], bool]:
        """Return a function that serializes and sends a message, and returns whether it did.

        False leaves the message to Python code, as always once `closed` is set or the writer is closed. `failure`
        returns the exception for an error text. With `of_items`, the function takes the items of the message's only
        field, or a single item.
        """

    def forward(self, message: bytes) -> None:
        """Send a message without checking its bytes."""

    def assert_liveliness(self) -> None:
        """Show the readers that the writer is alive."""

    def wait_for_acks(self, timeout_ns: int) -> bool:
        """Wait until all reliable readers have received all messages; False after the timeout."""

    def take_status(self, kind: int) -> tuple[int, int, int, int] | None:
        """Return the counts of the status DEADLINE_MISSED, ... if it has changed since the last call."""

    @property
    def guid(self) -> bytes: ...
    @property
    def matched(self) -> int:
        """How many readers the writer has found."""

    def matched_handles(self) -> list[int]:
        """Return the handles of those readers."""

    @property
    def refused_policy(self) -> int:
        """DDS's number of the QoS policy that rejected the last reader; 0: none."""

    def close(self) -> None: ...

class Reader:
    """A DDS reader of serialized messages; the event is set whenever some arrive."""

    def __init__(
        self, participant: int, topic: int, qos: QosProfile, user_data: str, on_data: Event | None
    ) -> None: ...
    def take(self, limit: int) -> list[tuple[bytes, int, int]]:
        """Return up to `limit` tuples (bytes, source timestamp in ns, writer's handle)."""

    def take_decoded(self, limit: int, codec: MessageCodec) -> list[tuple[Any, int, int]]:
        """Do the same with messages instead of bytes, except for messages that Python code has to read."""

    @property
    def pending(self) -> bool:
        """Whether messages may be waiting."""

    def take_status(self, kind: int) -> tuple[int, int, int, int] | None:
        """Return the counts of the status DEADLINE_MISSED, ... if it has changed since the last call."""

    @property
    def guid(self) -> bytes: ...
    @property
    def matched(self) -> int:
        """How many writers the reader has found."""

    def matched_handles(self) -> list[int]:
        """Return the handles of those writers."""

    @property
    def refused_policy(self) -> int:
        """DDS's number of the QoS policy that rejected the last writer; 0: none."""

    def close(self) -> None:
        """End the reader; no callback runs afterwards."""

class Tap:
    """Records messages with their arrival times on DDS's thread, without the GIL; polled with take()."""

    def __init__(
        self, participant: int, topic: int, qos: QosProfile, user_data: str, head: int, messages: int, size: int
    ) -> None: ...
    def take(self) -> tuple[bytes, bytes, bytes, bytes, bytes]:
        """Return the messages since the last call, the oldest first.

        Returns:
            The first `head` bytes of all of them, one after the other; then, as bytes, of each where it ends (uint64),
            when it arrived and when it was sent (int64 nanoseconds since 1970, by the clocks of this machine and of the
            writer's), and its writer's handle (uint64).
        """

    @property
    def missed(self) -> int:
        """How many messages arrived while `capacity` messages were waiting."""

    def take_status(self, kind: int) -> tuple[int, int, int, int] | None:
        """Return the counts of the status DEADLINE_MISSED, ... if it has changed since the last call."""

    @property
    def guid(self) -> bytes: ...
    @property
    def matched(self) -> int:
        """How many writers the reader has found."""

    def matched_handles(self) -> list[int]:
        """Return the handles of those writers."""

    @property
    def refused_policy(self) -> int:
        """DDS's number of the QoS policy that rejected the last writer; 0: none."""

    def close(self) -> None:
        """End the reader; no callback runs afterwards."""

class TfReader:
    """Stores the transforms of a topic in a buffer, on DDS's thread and without the GIL."""

    def __init__(
        self,
        participant: int,
        topic: int,
        qos: QosProfile,
        user_data: str,
        buffer: Buffer,
        is_static: bool,
        authority: str,
        renaming: Renaming | None = None,
        on_data: Event | None = None,
    ) -> None: ...
    def arm(self) -> None:
        """Let the next message set the event."""

    @property
    def received(self) -> int:
        """The number of received messages."""

    def writers(self) -> list[tuple[int, int, int, int, int | None, str, str, str]]:
        """Return the statistics of each writer.

        Returns:
            The writer's handle; the number of messages; the arrival time of the last one, in nanoseconds of the steady
            clock; the lower quartile of the delays of its last messages relative to the system clock, or None; examples
            of names that begin with a slash, that already have the prefix, and that do not.
        """

    def forget_writer(self, writer: int) -> None:
        """Forget the writer with this handle."""

    def writer_left(self, writer: int) -> None:
        """Note that the writer with this handle no longer exists, so its static transforms are not published."""

    def settle_statics(self) -> None:
        """From now on, count previously shared static transforms as published only if they were received."""

    def name_writer(self, writer: int, authority: str) -> None:
        """Store `authority` as the source of this writer's past and future transforms."""

    @property
    def stored_at(self) -> int:
        """When the transforms of the newest message were stored, in nanoseconds of the steady clock; 0 if never."""

    def take_status(self, kind: int) -> tuple[int, int, int, int] | None:
        """Return the counts of the status DEADLINE_MISSED, ... if it has changed since the last call."""

    @property
    def guid(self) -> bytes: ...
    @property
    def matched(self) -> int:
        """How many writers the reader has found."""

    def matched_handles(self) -> list[int]:
        """Return the handles of those writers."""

    @property
    def refused_policy(self) -> int:
        """DDS's number of the QoS policy that rejected the last writer; 0: none."""

    def close(self) -> None:
        """End the reader; no callback runs afterwards."""

class TransformStore:
    """Stores the transforms of messages in a buffer, whatever received them."""

    def __init__(
        self,
        buffer: Buffer,
        is_static: bool,
        authority: str,
        renaming: Renaming | None = None,
        on_data: Event | None = None,
    ) -> None: ...
    def add(self, writer: int, message: bytes) -> None:
        """Store the transforms of one serialized message without the GIL."""

    def arm(self) -> None:
        """Let the next message set the event."""

    @property
    def received(self) -> int:
        """The number of received messages."""

    def writers(self) -> list[tuple[int, int, int, int, int | None, str, str, str]]:
        """Return the statistics of each writer.

        Returns:
            The writer's handle; the number of messages; the arrival time of the last one, in nanoseconds of the steady
            clock; the lower quartile of the delays of its last messages relative to the system clock, or None; examples
            of names that begin with a slash, that already have the prefix, and that do not.
        """

    def forget_writer(self, writer: int) -> None:
        """Forget the writer with this handle."""

    def writer_left(self, writer: int) -> None:
        """Note that the writer with this handle no longer exists, so its static transforms are not published."""

    def settle_statics(self) -> None:
        """From now on, count previously shared static transforms as published only if they were received."""

    def name_writer(self, writer: int, authority: str) -> None:
        """Store `authority` as the source of this writer's past and future transforms."""

    @property
    def stored_at(self) -> int:
        """When the transforms of the newest message were stored, in nanoseconds of the steady clock; 0 if never."""

class EndpointReader:
    """The writers (PUBLICATIONS), readers (SUBSCRIPTIONS) or participants (PARTICIPANTS) found by DDS discovery."""

    def __init__(self, participant: int, topic: int, on_change: Event) -> None: ...
    def take(
        self,
    ) -> list[tuple[int, bool, bytes, bytes, str, str, tuple[int, bool, bool, bool], bytes, tuple[str, ...]]]:
        """Return the changes.

        They are (handle, alive, guid, participant's guid, topic, type, QoS policies, user data, partitions). Those
        that are not alive have only the handle and the guid. Participants have no topic, type and QoS.
        """

    def close(self) -> None: ...

middleware: object  # a capsule: native/include/coframe/middleware.h
