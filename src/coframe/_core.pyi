"""The native core. Private: use `import coframe`."""

from collections.abc import Sequence
from types import ModuleType
from typing import Any

from coframe.time import DurationLike, StampLike
from coframe.transform import Transform as PublicTransform

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
        beyond: int = 0,
    ) -> None: ...
    @property
    def values(self) -> tuple[float, float, float, float, float, float, float]:
        """(x, y, z, qx, qy, qz, qw) as floats, translation in metres; for a batch the identity."""

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
    def _beyond(self) -> int:
        """How far the lookup extrapolated beyond the samples of an edge, in nanoseconds."""

    @property
    def _batch(self) -> Any:
        """None, or (translations, quaternions, stamps, extrapolated) as arrays; the last two may be None."""

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

class Buffer:
    """The native buffer; coframe.Buffer is the public class on top of it."""

    def __init__(self, cache_ns: int) -> None: ...
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
    ) -> PublicTransform:
        """Return the transform at `stamp` that transforms data from `source` into `target`.

        Args:
            target: The target frame.
            source: The source frame.
            stamp: Time of the lookup: nanoseconds, datetime64, an aware datetime, or a Time; 0 or None means the
                latest time at which all edges between the frames have data.
            timeout: How long to wait for the transform, such as ``"100ms"``; None and 0 do not wait. Other Python
                threads run meanwhile.
            extrapolate: How far the lookup may extrapolate beyond the samples of an edge, such as ``"50ms"``, after
                waiting has not helped; None does not extrapolate, as tf2.
            hold: Whether extrapolation holds the last pose instead of continuing with the last twist.

        Returns:
            A single transform: translation in metres, unit quaternion x, y, z, w, and the time of the lookup in
            ``stamp``. Its ``extrapolated`` is the length of the extrapolation in nanoseconds.

        Raises:
            LookupException: A frame does not exist, or the tree contains a loop.
            ConnectivityException: The frames are in different trees.
            ExtrapolationException: An edge has no sample at that time.
            InvalidArgumentException: A name is empty or has a leading slash.
            TypeError: A stamp or duration has a wrong type, such as a float of seconds.

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
        beyond: Any,
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
        """Do _set_values() for each row; return reasons for refusal, the number stored, and the first refused row."""

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
        """Store a transform from numbers; return 0, or the reasons for refusal as bits (see insert_texts)."""

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

    def _become_snapshot(self, other: Buffer) -> None:
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
        """Counters: ``messages``, ``malformed`` (ingested as bytes); ``stored``, ``refused``, ``old`` (transforms)."""

    @property
    def _changes(self) -> int:
        """A counter that increases with every insertion."""

class Mailbox:
    """Where waits and watches leave their token when something has happened."""

    def __init__(self) -> None: ...
    def put(self, token: int) -> None:
        """Leaves a token from Python."""

    @property
    def empty(self) -> bool: ...
    def take(self) -> list[int]:
        """The tokens that have come."""

    def wait(self, timeout_ns: int) -> bool:
        """Waits, without the GIL, until there are some (True) or the time (negative: for ever) is over."""

class Wait:
    """A look-up that waits for its answer."""

    def transform(self) -> PublicTransform | None:
        """The transform, or None while there is none."""

    def cancel(self) -> None:
        """Waits no more."""

class Watch:
    """Notes which edges change."""

    def take(self) -> list[str]:
        """The child frames of the edges that have changed since the last call."""

    def cancel(self) -> None:
        """Notes no more."""

def wait(buffer: Buffer, mailbox: Mailbox, token: int, target: str, source: str, stamp: StampLike | None) -> Wait:
    """A look-up whose token is put into the mailbox once it has its answer."""

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
    """The same for _lookup_full."""

def watch(buffer: Buffer, mailbox: Mailbox, token: int, child: str) -> Watch:
    """Puts the token into the mailbox when the edge from `child` to its parent changes; "": any edge."""

class Event:
    """A flag that DDS threads and Python set, and one thread waits for without the GIL."""

    def __init__(self) -> None: ...
    def set(self) -> None:
        """Sets the flag and wakes the waiting thread."""

    def clear(self) -> None:
        """Takes the flag back."""

    def wait(self, timeout_ns: int | None) -> bool:
        """Waits until set (True, and cleared) or for timeout_ns nanoseconds (False); None waits for ever."""

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
    """tf2's log lines for a transform that _set_values refused: (level, text)."""

def register_buffer_class(cls: type[Buffer]) -> None:
    """Gives a class on top of Buffer the most frequent methods as its own.

    CPython has a shorter way to call those of an object's very class.
    """

def register_transform_class(cls: type[Transform]) -> None:
    """Look-ups return instances of `cls`, a subclass of Transform."""

def register_messages(
    transform_stamped: type,
    header: type,
    time: type,
    rclpy_time: type,
    transform: type,
    vector3: type,
    quaternion: type,
) -> None:
    """The classes that _set_message() reads and _lookup_message() makes."""

def register_errors(errors: ModuleType) -> None:
    """Failures are raised as the exceptions of this module."""

def register_time(time: ModuleType) -> None:
    """Stamps and durations that are not int are converted by this module."""

CPU_LEVEL: str
CPU_LEVELS: tuple[str, ...]

def mcap_records(data: Any) -> tuple[bytes, bytes, bytes, bytes, bytes, list[tuple[int, int, int]], int]:
    """Where the messages lie among records of MCAP, up to the first record that is cut off or of another kind.

    Returns:
        Of each message its channel (uint16), log time (uint64), and where its record begins, its bytes begin and its
        bytes end (uint64); of each schema and channel its opcode and the two ends of its content; the bytes dealt with.
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
    """Buffer.ingest() of many parts of `data`, told by uint64 arrays: how many are damaged, and why the first is.

    `encoding` is "cdr", or "ros1" for tf2_msgs/TFMessage and tf/tfMessage of ROS 1.
    """

def transform_columns(
    data: Any, starts: Any, ends: Any, encoding: str = "cdr"
) -> tuple[bytes, bytes, bytes, bytes, bytes, list[str], int, str]:
    """The transforms of many TFMessages as they were sent, whatever a buffer would make of them.

    Returns:
        Of each transform the number of its message (uint32), its stamp (int64), the numbers of its parent's and its
        child's name (uint32), x, y, z, qx, qy, qz, qw (float64); the names; how many messages are damaged, and why the
        first.
    """

class JointTree:
    """A tree of joints, and where all its links are.

    Args:
        root: The link that no joint moves.
        joints: Parents before children: name, type, parent link, child link, origin (x, y, z, qx, qy, qz, qw), axis,
            and whom it follows, (joint, multiplier, offset), or None.

    Raises:
        ValueError: A parent stands behind its child, or joints follow each other in a circle.
    """

    def __init__(self, root: str, joints: list[tuple[object, ...]]) -> None: ...
    def transforms(self, positions: dict[str, Any], in_root: bool) -> dict[str, PublicTransform] | None:
        """Of one configuration, by link in the root link, or by joint in the link before it.

        Args:
            positions: By joint: a number, or a list or tuple of them for a joint that has several.
            in_root: Which of the two.

        Returns:
            None where a position is not finite, not of the joint's size, or of no joint that moves.
        """

    def poses_into(
        self, positions: list[tuple[str, Any]], count: int, in_root: bool, out: Any, threads: int
    ) -> str | None:
        """Of many configurations.

        Args:
            positions: (joint, float64 array): (N,), of a joint with several numbers (N, size), of any strides.
            count: N.
            in_root: As of transforms().
            out: Is filled: (J, N, 7) float64, in the order of the joints.
            threads: So many share the work.

        Returns:
            The first joint found with a position that is not finite, or a quaternion of zero; None if there is none.
        """

def transform_fields(pose: Sequence[float], fields: Sequence[Sequence[Any]], threads: int) -> None:
    """Moves points by a pose (x, y, z, qx, qy, qz, qw), in place.

    Args:
        pose: What they are moved by.
        fields: Threes of float32 or float64 arrays of one shape, with one or two axes and any strides: the position,
            then directions, which are turned only.
        threads: How many share the work.
    """

def deskew_fields(
    buffer: Buffer,
    target: str,
    source: str,
    times: Any,
    onward: Sequence[float],
    fields: Sequence[Sequence[Any]],
    nan_for_none: bool,
    threads: int,
) -> tuple[int, int]:
    """Moves points in `source` to `target`, each by its own time, and then by a pose, in place.

    Args:
        buffer: Where the motion is known.
        target: The frame that stands still.
        source: The sensor's frame.
        times: int64 nanoseconds, one a point; 0 is the latest, the least int64 is none.
        onward: The pose of `target`, seen from where the points shall be.
        fields: As in transform_fields().
        nan_for_none: Points without a transform become NaN; else none is touched if one has none.
        threads: How many share the work.

    Returns:
        How many points have no transform, and the first of them. If all of them, none is touched.
    """

class PoseTable:
    """Many frames, looked up together again and again; for one thread.

    Args:
        buffer: Where they are looked up.
        fixed: The frame that the poses are told in.
        frames: N frames.
        roots: None, or the frame that a frame is seen from instead of `fixed`.
    """

    def __init__(self, buffer: Buffer, fixed: str, frames: list[str], roots: list[str | None]) -> None: ...
    def look_up(self, stamp: int, hold: int, poses: Any, states: Any) -> None:
        """Where all of them are at one time.

        Args:
            stamp: Nanoseconds; 0 is the latest, for each frame its own.
            hold: How many nanoseconds beyond its samples a link is taken to stand still.
            poses: (N, 7) float64, gets x, y, z, qx, qy, qz, qw, or NaN.
            states: (N,) uint8, gets 0: exactly; 1: held beyond the samples of a link; 2: not at all; 3: seen from its
                root.
        """

def poses_near(poses: Any, states: Any, origin: Any, fixed: int, limit: float, near: Any) -> int:
    """Poses as float32, relative to an origin; how many are far from it.

    Args:
        poses: (N, 7) float64: x, y, z, qx, qy, qz, qw.
        states: (N,) uint8: how they were found, as of `PoseTable.look_up`.
        origin: (3,) float64.
        fixed: The index of a frame that is never far; -1: none.
        limit: How far from the origin is far, along an axis; frames are counted whose state is 0 or 1.
        near: (N, 7) float32, gets the poses.
    """

class Renaming:
    """Puts a prefix in front of the names of frames, except of those to keep."""

    def __init__(self, prefix: str, keep: Sequence[str]) -> None: ...
    def __call__(self, name: str) -> str:
        """The name among those of others."""

class Relay:
    """TFMessages of several sources into those of one tree. Not for several threads at once."""

    def __init__(self, static: bool, period: int) -> None:
        """With `static`, what is written is always all; else of each edge one transform in `period` nanoseconds."""

    def add_source(self, renaming: Renaming, split: bool) -> int:
        """The number of another source. With `split` only what has the prefix or is kept passes, without the prefix."""

    def add(self, source: int, writer: int, message: bytes, at: int = -1) -> None:
        """Takes a message in that came from a writer of a source.

        Args:
            source: Its number.
            writer: Any number for the writer.
            message: A TFMessage's CDR; what is malformed is counted.
            at: When it came, in nanoseconds of a clock that never goes back; negative: now, by the steady clock.
        """

    def take(self) -> bytes | None:
        """One message of what was taken in since the last one, or None."""

    def forget_writer(self, source: int, writer: int) -> None:
        """The writer has left."""

    def edges(self) -> list[tuple[str, str, int, int, int | None, int, int, int, int, int]]:
        """What is known of each edge.

        Returns:
            Parent and child as they are written; the source that is listened to, and the writer of its last message; a
            source that tells something else, or None, and how often that was; how many transforms were passed on, and
            how many left out for the rate; the newest stamp; when it was heard of last.
        """

    def writers(self, source: int) -> list[tuple[tuple[int, int, int, int, int | None, str, str, str], int, int]]:
        """What each writer of a source has sent: as TfReader.writers(), messages and transforms that were bad."""

def frozen_parts(buffer: Buffer) -> tuple[bytes, int]:
    """Of a frozen buffer the table that a file of it begins with, and how many chunks of samples it has."""

def frozen_chunks(buffer: Buffer, first: int, count: int) -> bytes:
    """Some of these chunks; fewer at the end."""

def become_frozen(buffer: Buffer, file: Any, table: int, table_size: int, samples: int, samples_size: int) -> str:
    """Makes a new buffer one that uses a file's bytes where they lie.

    Args:
        buffer: One that nobody uses yet.
        file: The whole file, by the buffer protocol; held as long as it is needed.
        table: Where the table begins.
        table_size: How many bytes it has.
        samples: Where the chunks of samples begin, at a multiple of 64.
        samples_size: How many bytes they have.

    Returns:
        What is wrong with them; nothing if they are good.
    """

def samples_of(buffer: Buffer, child: str) -> tuple[bytes, bytes, bytes, list[str]]:
    """The samples of one frame of a frozen buffer.

    Returns:
        Stamps (int64), poses (rows of 7 float64: x, y, z, qx, qy, qz, qw), which of the names each parent has (uint32),
        these names.
    """

PUBLICATIONS: int
SUBSCRIPTIONS: int

class DdsError(RuntimeError):
    """DDS has refused something."""

def load_dds(path: str) -> None:
    """Loads the DDS library; RuntimeError where it does not fit."""

def create_unchecked_topic(participant: int, name: str, type_name: str) -> int:
    """A topic for who checks the bytes himself: its number."""

class QosProfile:
    """The four policies ROS programs set."""

    def __init__(self, depth: int, reliable: bool, transient_local: bool, keep_all: bool) -> None: ...

class DomainParticipant:
    """A DDS domain of this process and a participant in it."""

    def __init__(self, domain: int, config: str, user_data: str) -> None: ...
    @property
    def entity(self) -> int:
        """DDS's number for the participant; 0 after close."""

    @property
    def guid(self) -> bytes: ...
    def close(self) -> None:
        """Ends the participant and DDS's threads."""

class Writer:
    """A DDS writer of serialised messages."""

    def __init__(
        self, participant: int, topic: int, qos: QosProfile, user_data: str, unchecked: bool = False
    ) -> None: ...
    def write(self, message: bytes) -> None:
        """Sends one serialised message, without the GIL."""

    def forward(self, message: bytes) -> None:
        """The same on an unchecked topic for a message of any type, whose bytes nobody looks at."""

    @property
    def guid(self) -> bytes: ...
    @property
    def matched(self) -> int:
        """How many readers the writer has found."""

    def matched_handles(self) -> list[int]:
        """The handles of those readers."""

    @property
    def refused_policy(self) -> int:
        """DDS's number of the policy by which the last reader was refused; 0: none was."""

    def close(self) -> None: ...

class Reader:
    """A DDS reader of serialised messages; the event is set whenever some arrive."""

    def __init__(
        self, participant: int, topic: int, qos: QosProfile, user_data: str, on_data: Event | None
    ) -> None: ...
    def take(self, limit: int) -> list[tuple[bytes, int, int]]:
        """Up to `limit` tuples (bytes, source timestamp in ns, writer's handle)."""

    @property
    def pending(self) -> bool:
        """Whether messages may be waiting."""

    @property
    def guid(self) -> bytes: ...
    @property
    def matched(self) -> int:
        """How many writers the reader has found."""

    def matched_handles(self) -> list[int]:
        """The handles of those writers."""

    @property
    def refused_policy(self) -> int:
        """DDS's number of the policy by which the last writer was refused; 0: none was."""

    def close(self) -> None:
        """Ends the reader; no callback runs afterwards."""

class Tap:
    """Notes when messages come, on DDS's thread and without the GIL; whoever looks now and then takes them."""

    def __init__(
        self, participant: int, topic: int, qos: QosProfile, user_data: str, head: int, capacity: int
    ) -> None: ...
    def take(self) -> tuple[bytes, bytes, bytes, bytes, bytes]:
        """The messages since the last call, the oldest first.

        Returns:
            The first `head` bytes of all of them, one after the other; then, as bytes, of each where it ends (uint64),
            when it arrived and when it was sent (int64 nanoseconds since 1970, by the clocks of this machine and of the
            writer's), and its writer's handle (uint64).
        """

    @property
    def missed(self) -> int:
        """How many messages came while `capacity` of them were waiting."""

    @property
    def guid(self) -> bytes: ...
    @property
    def matched(self) -> int:
        """How many writers the reader has found."""

    def matched_handles(self) -> list[int]:
        """The handles of those writers."""

    @property
    def refused_policy(self) -> int:
        """DDS's number of the policy by which the last writer was refused; 0: none was."""

    def close(self) -> None:
        """Ends the reader; no callback runs afterwards."""

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
    ) -> None: ...
    def writers(self) -> list[tuple[int, int, int, int, int | None, str, str, str]]:
        """What each writer has sent.

        Returns:
            The writer's handle; how many messages; when the last one came, in nanoseconds of the steady clock; by how
            much its stamps were behind the system clock, the lower quartile of its last messages, or None; examples of
            names that begin with a slash, have the prefix already, and have not.
        """

    def forget_writer(self, writer: int) -> None:
        """The writer with this handle has left."""

    def name_writer(self, writer: int, authority: str) -> None:
        """The buffer notes `authority` for what the writer with this handle has sent and will send."""

    @property
    def stored_at(self) -> int:
        """When the newest message's transforms were in the buffer, in nanoseconds of the steady clock; 0: never."""

    @property
    def guid(self) -> bytes: ...
    @property
    def matched(self) -> int:
        """How many writers the reader has found."""

    def matched_handles(self) -> list[int]:
        """The handles of those writers."""

    @property
    def refused_policy(self) -> int:
        """DDS's number of the policy by which the last writer was refused; 0: none was."""

    def close(self) -> None:
        """Ends the reader; no callback runs afterwards."""

class EndpointReader:
    """What DDS discovery tells about writers (PUBLICATIONS) or readers (SUBSCRIPTIONS)."""

    def __init__(self, participant: int, topic: int, on_change: Event) -> None: ...
    def take(self) -> list[tuple[int, bool, bytes, bytes, str, str, tuple[int, bool, bool, bool], bytes]]:
        """The changes: (handle, alive, guid, participant's guid, topic, type, four policies of its QoS, user data)."""

    def close(self) -> None: ...
