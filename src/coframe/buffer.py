"""Buffer: transforms over time, and the answer to "where was this frame, seen from that one, then?"."""

from __future__ import annotations

import contextlib
import sys
import time as system_time
from typing import TYPE_CHECKING, Literal, NamedTuple, TypeAlias, overload

import numpy as np

from coframe import _core, errors, time
from coframe.dispatcher import Dispatcher
from coframe.errors import InvalidArgumentException, TimeoutException, TransformException
from coframe.resampling import StepLimits
from coframe.transform import batch_of, stamps_of

if TYPE_CHECKING:
    import os
    from collections.abc import Callable

    from numpy.typing import ArrayLike, NDArray
    from typing_extensions import Self

    from coframe.explanation import Explanation
    from coframe.time import DurationLike, StampLike
    from coframe.transform import Transform

__all__ = ["Buffer", "EdgeInfo", "FrameInfo", "Subscription"]

OnError: TypeAlias = Literal["raise", "nan", "clip"]
Array: TypeAlias = "NDArray[np.float64]"

_KEEP_EVERYTHING = -1
DEFAULT_AUTHORITY = "no recorded authority"

_core.register_errors(errors)
_core.register_time(time)


class FrameInfo(NamedTuple):
    """What a buffer knows of one frame.

    Attributes:
        name: The frame.
        parent: The frame it is told in by the newest sample; "" for the root of a tree or before any data.
        static: Whether it is valid for all time.
        samples: How many samples are kept.
        oldest: Stamp of the oldest sample in nanoseconds; 0 when static or without data.
        newest: Stamp of the newest sample.
        rate: Samples per second over the time that is kept, as tf2 computes it; 0 when static.
        authority: Who said it last.
    """

    name: str
    parent: str
    static: bool
    samples: int
    oldest: int
    newest: int
    rate: float
    authority: str


class EdgeInfo(NamedTuple):
    """What a buffer knows of the link between a frame and its parent. All times are nanoseconds.

    Attributes:
        parent: The frame that the newest sample is told in; "" before any data.
        child: The frame that it tells of.
        static: Whether it is valid for all time; then the times and rates are 0 and the age is None.
        authority: Who said it last.
        samples: How many samples are kept.
        oldest: Stamp of the oldest sample.
        newest: Stamp of the newest sample.
        age: How old the newest sample is; negative if it is ahead of the clock, None if static or without data.
        rate: Samples per second, from the mean interval between the stamps that are kept.
        jitter: Standard deviation of those intervals.
        longest_gap: The longest of them.
        stored: Samples taken in since the buffer exists.
        late: Of these, samples put before newer ones.
        repeated: Exact repetitions, which change nothing.
        rejected: Samples that were refused, by reason: ``"older than the cache"``, ``"not a number"``,
            ``"invalid quaternion"``, ``"its own parent"``. Reasons without a case are left out.
    """

    parent: str
    child: str
    static: bool
    authority: str
    samples: int
    oldest: int
    newest: int
    age: int | None
    rate: float
    jitter: float
    longest_gap: int
    stored: int
    late: int
    repeated: int
    rejected: dict[str, int]


class Subscription:
    """Changes that somebody wants to hear of; usable as a context manager."""

    def __init__(self, cancel: Callable[[], object]) -> None:
        self._cancel = cancel

    def close(self) -> None:
        """Ends it; doing so twice does no harm. A call that has begun goes on."""
        self._cancel()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


class Buffer(_core.Buffer):
    """Transforms over time, by the rules of tf2, for any number of threads.

    All stamps are nanoseconds; 0 or None asks for the latest time at which every link has data. There is no
    extrapolation. A look-up that fails raises the exception tf2 raises, with tf2's text, and with a ``hint``.

    Args:
        cache: How far back dynamic transforms are kept: text such as ``"10s"``, int nanoseconds or timedelta; None
            keeps everything, which suits recordings.

    Example:
        >>> import coframe
        >>> buffer = coframe.Buffer()
        >>> lidar = coframe.Transform.from_rpy([0.1, 0.0, 0.3])
        >>> buffer.set("base_link", "lidar", lidar, static=True)
        True
        >>> buffer.lookup("base_link", "lidar").translation.tolist()
        [0.1, 0.0, 0.3]
    """

    def __init__(self, cache: DurationLike | None = "10s") -> None:
        super().__init__(_KEEP_EVERYTHING if cache is None else _cache_ns(cache))
        self.dispatcher = Dispatcher()

    def set(
        self,
        parent: str,
        child: str,
        transform: Transform,
        stamp: StampLike | None = None,
        *,
        static: bool = False,
        authority: str = DEFAULT_AUTHORITY,
    ) -> bool:
        """Takes in where ``child`` is, seen from ``parent``.

        Args:
            parent: The frame that the transform is told in.
            child: The frame that it tells of.
            transform: A single transform; if it names its frames, they must be these two.
            stamp: When; by default the transform's own stamp. Static transforms need none.
            static: Valid for all time. A frame that changes between static and dynamic starts anew.
            authority: Who says so.

        Returns:
            False if the sample is older than the cache reaches and was not stored.

        Raises:
            InvalidArgumentException: tf2 refuses it (empty or equal names, NaN, ...), with tf2's text; or the
                transform is between other frames, or has no stamp.
        """
        refusals = self._set_plain(parent, child, transform, stamp, static) if authority is DEFAULT_AUTHORITY else None
        if refusals is None:
            refusals = self._set(parent, child, transform, stamp, static, authority)
        if refusals == 0:
            return True
        facts = (parent, child, _stamp_of(transform, stamp), *transform.values)
        errors_found = [text for level, text in _core.insert_texts(refusals, *facts, authority) if level == "error"]
        if errors_found:
            raise InvalidArgumentException.with_details(
                "\n".join(errors_found), target=parent, source=child, edge=(parent, child), hint=_REFUSED_HINT
            )
        return False

    def _set(
        self, parent: str, child: str, transform: Transform, stamp: StampLike | None, static: bool, authority: str
    ) -> int:
        """`set` for all that may be given: the reasons for refusal."""
        if not isinstance(transform, _core.Transform):
            raise TypeError(
                f"set() takes a coframe.Transform, not {type(transform).__name__}: make one by "
                "Transform(translation, quaternion), Transform.from_rpy(...) or Transform.from_matrix(...)"
            )
        if transform.shape:
            raise InvalidArgumentException("set() takes a single transform, not a batch")
        _check_frames(parent, child, transform)
        if stamp is None and transform.stamp is None and not static:
            raise InvalidArgumentException.with_details(
                f"a dynamic transform from {parent!r} to {child!r} needs a stamp",
                hint="Give stamp=..., or static=True if it never changes.",
            )
        self._check_not_frozen(parent, child)
        return self._set_values(parent, child, _stamp_of(transform, stamp), *transform.values, static, authority)

    def set_many(
        self,
        parent: str,
        child: str,
        stamps: ArrayLike | None,
        poses: Transform | ArrayLike,
        *,
        static: bool = False,
        authority: str = DEFAULT_AUTHORITY,
    ) -> int:
        """:meth:`set` for many samples of one edge, as one after the other in the order of their stamps.

        Args:
            parent: The frame that the poses are told in.
            child: The frame that they tell of.
            stamps: (N,) int64 nanoseconds or datetime64, sorted or not; None: those of the batch.
            poses: A batch of shape (N,), or an array (N, 7) of x, y, z in metres and qx, qy, qz, qw.
            static: Valid for all time; then the last one holds.
            authority: Who says so.

        Returns:
            How many were stored: without those that are older than the cache reaches.

        Raises:
            InvalidArgumentException: tf2 refuses one of them, with tf2's text, or the buffer is frozen; then none is
                stored.
        """
        if isinstance(poses, _core.Transform):
            _check_frames(parent, child, poses)
            stamps = poses.stamps if stamps is None else stamps
            poses = np.concatenate([poses.translation, poses.quaternion], axis=-1)
        values = np.ascontiguousarray(poses, dtype=np.float64)
        if stamps is None:
            raise InvalidArgumentException.with_details(
                f"dynamic transforms from {parent!r} to {child!r} need stamps", hint="Give an array of nanoseconds."
            )
        times = np.ascontiguousarray(stamps_of(stamps))
        if times.ndim != 1 or values.shape != (*times.shape, 7):
            raise ValueError(
                f"stamps of the shape (N,) and poses (N, 7) are wanted, not {times.shape} and {values.shape}"
            )
        self._check_not_frozen(parent, child)
        refusals, stored, row = self._set_rows(parent, child, times, values, static, authority)
        if refusals:
            x, y, z, qx, qy, qz, qw = values[row].tolist()
            texts = _core.insert_texts(refusals, parent, child, int(times[row]), x, y, z, qx, qy, qz, qw, authority)
            text = "\n".join(line for _, line in texts)
            raise InvalidArgumentException.with_details(
                f"row {row}: {text}", target=parent, source=child, edge=(parent, child), hint=_REFUSED_HINT
            )
        return stored

    @overload
    def lookup_many(
        self,
        target: str,
        source: str,
        stamps: ArrayLike,
        *,
        out: None = None,
        threads: int = 1,
        on_error: OnError = "raise",
        twist: Literal[False] = False,
        extrapolate: DurationLike | None = None,
        hold: bool = False,
    ) -> Transform: ...
    @overload
    def lookup_many(
        self,
        target: str,
        source: str,
        stamps: ArrayLike,
        *,
        out: Array,
        threads: int = 1,
        on_error: OnError = "raise",
        twist: Literal[False] = False,
        extrapolate: DurationLike | None = None,
        hold: bool = False,
    ) -> Array: ...
    @overload
    def lookup_many(
        self,
        target: str,
        source: str,
        stamps: ArrayLike,
        *,
        out: None = None,
        threads: int = 1,
        on_error: OnError = "raise",
        twist: Literal[True],
        extrapolate: DurationLike | None = None,
        hold: bool = False,
    ) -> tuple[Transform, Array]: ...
    @overload
    def lookup_many(
        self,
        target: str,
        source: str,
        stamps: ArrayLike,
        *,
        out: Array,
        threads: int = 1,
        on_error: OnError = "raise",
        twist: Literal[True],
        extrapolate: DurationLike | None = None,
        hold: bool = False,
    ) -> tuple[Array, Array]: ...

    def lookup_many(
        self,
        target: str,
        source: str,
        stamps: ArrayLike,
        *,
        out: Array | None = None,
        threads: int = 1,
        on_error: OnError = "raise",
        twist: bool = False,
        extrapolate: DurationLike | None = None,
        hold: bool = False,
    ) -> Transform | Array | tuple[Transform | Array, Array]:
        """:meth:`lookup` at many times at once.

        Args:
            target: The frame the answers are in.
            source: The frame that is asked about.
            stamps: (N,) int64 nanoseconds or datetime64; 0 asks for the latest. Need not be sorted.
            out: Filled and returned instead of a new batch: (N, 7) float64 gets x, y, z, qx, qy, qz, qw; (N, 4, 4)
                gets matrices.
            threads: So many share the work.
            on_error: ``"raise"`` as the first look-up without an answer does, fill its row with ``"nan"``, or
                ``"clip"`` its time to those for which all links have data.
            twist: Also tell how fast ``source`` moves, seen from ``target``.
            extrapolate: As of :meth:`lookup`.
            hold: As of :meth:`lookup`.

        Returns:
            A batch of shape (N,), with its ``stamps``, or ``out``. With ``twist`` also an array (N, 6): m/s along x,
            y, z and rad/s about them, of the origin of ``source`` along the axes of ``target``, by the interpolation
            between samples (at a sample, of the interval after it).

        Raises:
            TransformException: As :meth:`lookup`; with ``"nan"`` only if no row at all has an answer.

        Example:
            >>> import coframe
            >>> buffer = coframe.Buffer()
            >>> for second in (1, 2):
            ...     moved = coframe.Transform([second, 0, 0])
            ...     _ = buffer.set("map", "base", moved, second * 1_000_000_000)
            >>> buffer.lookup_many("map", "base", [1_250_000_000, 1_500_000_000]).translation[:, 0].tolist()
            [1.25, 1.5]
        """
        times = np.array(stamps_of(stamps), ndmin=1)
        if times.ndim != 1:
            raise ValueError(f"stamps must have the shape (N,), not {times.shape}")
        rows = out if out is not None and _is_rows(out, times.size) else np.empty((times.size, 7))
        twists = np.empty((times.size, 6)) if twist else None
        beyond = np.empty_like(times) if extrapolate is not None else None
        missing = self._lookup_rows(target, source, times, rows, twists, beyond, on_error, threads, extrapolate, hold)
        if missing == 0 and times.size and np.isnan(rows[:, 0]).all():
            self.lookup(target, source, int(np.ravel(stamps_of(stamps))[0]), extrapolate=extrapolate, hold=hold)
        batch = batch_of(rows[:, :3], rows[:, 3:], target, source, times, beyond)
        if out is not None and out is not rows:
            out[...] = batch.matrix
        result = batch if out is None else out
        return result if twists is None else (result, twists)

    def trajectory(
        self,
        target: str,
        source: str,
        start: StampLike | None = None,
        stop: StampLike | None = None,
        *,
        max_translation: float | None = None,
        max_rotation: float | None = None,
    ) -> Transform:
        """Where ``source`` went, seen from ``target``: at the samples' own times, or as densely as it moves.

        Args:
            target: The frame the poses are in.
            source: The frame that moves.
            start: From when on; None: as far back as all links have data.
            stop: Until when; None: as long as they have.
            max_translation: Metres from one pose to the next at most.
            max_rotation: Radians from one pose to the next at most. With one of the two, there are as few poses as
                that allows, and none where nothing moves, other than the first and the last.

        Returns:
            A batch with its ``stamps``, in order. A single pose where all links are static.

        Raises:
            TransformException: As :meth:`lookup`.
        """
        first, last = self.span(target, source)
        first = first if start is None else max(first, time.stamp_ns(start))
        last = last if stop is None else min(last, time.stamp_ns(stop))
        inside = np.frombuffer(self._stamps_between(target, source, first, last), dtype=np.int64)
        stamps = np.unique(np.concatenate([[first], inside, [last]]).astype(np.int64)) if first <= last else inside
        if max_translation is None and max_rotation is None:
            return self.lookup_many(target, source, stamps)
        steps = StepLimits(max_translation, max_rotation)
        return steps.resample(lambda times: self.lookup_many(target, source, times), stamps)

    def span(self, target: str, source: str) -> tuple[int, int]:
        """From when until when every link between two frames has data, in nanoseconds; (0, 0) if all are static.

        Raises:
            TransformException: As :meth:`lookup`, or the links have no common time.
        """
        ends = np.array([np.iinfo(np.int64).min + 1, np.iinfo(np.int64).max])
        if self.latest_common_time(target, source) == 0:
            return 0, 0
        self._lookup_rows(target, source, ends, np.empty((2, 7)), None, None, "clip", 1)
        return int(ends[0]), int(ends[1])

    def wait(
        self, target: str, source: str, stamp: StampLike | None = None, *, timeout: DurationLike | None = None
    ) -> Transform:
        """Like :meth:`lookup`, but waits for the transform to become possible; ``timeout`` None waits for ever.

        Raises:
            TimeoutException: It did not; ``__cause__`` says what was missing.
        """
        try:
            return self.lookup(target, source, stamp, timeout=sys.maxsize if timeout is None else timeout)
        except TransformException as error:
            raise _in_vain(target, source, timeout, error) from error

    async def wait_async(
        self, target: str, source: str, stamp: StampLike | None = None, *, timeout: DurationLike | None = None
    ) -> Transform:
        """:meth:`wait` for asyncio: other tasks run meanwhile, and no thread is needed per wait.

        Raises:
            TimeoutException: The transform did not become possible in time; ``__cause__`` says what was missing.
        """
        import asyncio  # noqa: PLC0415 - takes as long to import as all else here, and few need it

        loop = asyncio.get_running_loop()
        future: asyncio.Future[Transform | None] = loop.create_future()

        def settle(found: Transform | None) -> None:
            if not future.done():
                future.set_result(found)

        def bring(found: Transform | None) -> None:
            with contextlib.suppress(RuntimeError):  # the loop has ended
                loop.call_soon_threadsafe(settle, found)

        cancel = self.dispatcher.wait(
            lambda mailbox, token: _core.wait(self, mailbox, token, target, source, stamp),
            bring,
            None if timeout is None else time.duration_ns(timeout),
        )
        try:
            found = await future
        finally:
            cancel()
        if found is not None:
            return found
        try:
            return self.lookup(target, source, stamp)
        except TransformException as error:
            raise _in_vain(target, source, timeout, error) from error

    def why(
        self, target: str, source: str, at: StampLike | None = None, *, now: StampLike | None = None
    ) -> Explanation:
        """Why :meth:`lookup` has an answer, or why not: by which links, and which one is missing, late or early.

        Args:
            target: The frame the answer is in.
            source: The frame that is asked about.
            at: When; 0 or None is the latest.
            now: The present, by the clock of the stamps. By default the system's, where the stamps are within an hour
                of it; a buffer that is frozen or keeps everything, as of a recording, has none.

        Returns:
            The facts; ``print()`` draws them.
        """
        from coframe.explanation import explain  # noqa: PLC0415 - it stands on this module

        return explain(self, target, source, at, now=now)

    def on_change(self, callback: Callable[[EdgeInfo], object], *, child: str | None = None) -> Subscription:
        """Calls back when the link between ``child`` and its parent gets a new sample.

        The calls come from a thread of their own, one after another and with no lock held, so they may use the buffer
        at will. Samples that arrive while a call is under way are told of by one more call.

        Args:
            callback: Gets what is known of the edge now.
            child: Which edge, also one that is not there yet; None: every one.

        Returns:
            To be closed when it is no longer wanted; it also ends with the buffer.
        """

        def tell(changed: list[str]) -> None:
            for edge in self.edges(changed):
                callback(edge)

        start = lambda mailbox, token: _core.watch(self, mailbox, token, child or "")  # noqa: E731 - one line of glue
        return Subscription(self.dispatcher.watch(start, tell))

    def snapshot(self) -> Buffer:
        """What is in here now, as a buffer of its own that only answers; the samples are shared, not copied."""
        copy = Buffer.__new__(Buffer)
        _core.Buffer.__init__(copy, self.cache_ns)
        copy._become_snapshot(self)
        copy.dispatcher = Dispatcher()
        return copy

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes what is in here now to a file that :func:`coframe.load` opens at once, however large it is.

        Samples take 72 bytes each, and each moving frame up to 18 kB more. The file appears whole or not at all.

        Args:
            path: The file, by custom ``*.cfz``. One that is there is replaced.

        Raises:
            FrozenFileError: It cannot be written.
        """
        from coframe import frozen  # noqa: PLC0415 - it stands on this module

        frozen.save(self, path)

    def edges(self, children: list[str] | None = None, *, now: int | None = None) -> list[EdgeInfo]:
        """The links between frames and their parents, and what came in for them.

        Args:
            children: Only the edges of these frames.
            now: What ages are told from, in nanoseconds; by default the system's clock. Recordings and simulations
                have a time of their own.
        """
        now = system_time.time_ns() if now is None else now
        return [_edge_info(*facts, now) for facts in self._edge_tuples(children)]

    def frames(self) -> list[FrameInfo]:
        """Every frame that was ever mentioned, in the order in which they were."""
        return [FrameInfo(*facts) for facts in self._frame_tuples()]

    def _check_not_frozen(self, parent: str, child: str) -> None:
        if self.frozen:
            raise InvalidArgumentException.with_details(
                f"the buffer is frozen: the transform from {parent!r} to {child!r} was not stored",
                target=parent,
                source=child,
                hint="A snapshot(), a loaded file or a buffer after freeze() only answers: set it in one that lives.",
            )

    def __contains__(self, frame: object) -> bool:
        return isinstance(frame, str) and self.frame_exists(frame)

    def __repr__(self) -> str:
        cache = "everything" if self.cache_ns < 0 else f"{self.cache_ns / time.SECOND:g}s"
        return f"Buffer(cache={cache}, frames={len(self.frame_names())})"


_core.register_buffer_class(Buffer)


_REFUSED_HINT = "Names must differ and not be empty, values must be numbers, and a quaternion must not be zero."


def _is_rows(out: Array, count: int) -> bool:
    """Whether the poses can go there straight; False for matrices."""
    if out.dtype == np.float64 and out.shape in {(count, 7), (count, 4, 4)}:
        return out.ndim == 2 and out.flags.c_contiguous and out.flags.writeable
    raise ValueError(f"out must be float64 of the shape ({count}, 7) or ({count}, 4, 4), not {out.dtype} {out.shape}")


_REASONS = ("older than the cache", "its own parent", "not a number", "invalid quaternion")


def _edge_info(
    frame: tuple[str, str, bool, int, int, int, float, str],
    intervals: tuple[float, float, float],
    counts: tuple[int, int, int, int, int, int, int],
    now: int,
) -> EdgeInfo:
    child, parent, static, samples, oldest, newest, _, authority = frame
    mean, deviation, longest = intervals
    stored, late, repeated, *refused = counts
    return EdgeInfo(
        parent=parent,
        child=child,
        static=static,
        authority=authority,
        samples=samples,
        oldest=oldest,
        newest=newest,
        age=None if static or not samples else now - newest,
        rate=time.SECOND / mean if mean else 0.0,
        jitter=deviation,
        longest_gap=round(longest),
        stored=stored,
        late=late,
        repeated=repeated,
        rejected={reason: count for reason, count in zip(_REASONS, refused, strict=True) if count},
    )


def _in_vain(target: str, source: str, timeout: DurationLike | None, error: TransformException) -> TimeoutException:
    return TimeoutException.with_details(
        f"waited {timeout} in vain for the transform from {source!r} to {target!r}: {error}",
        target=error.target,
        source=error.source,
        requested=error.requested,
        earliest=error.earliest,
        latest=error.latest,
        edge=error.edge,
        hint=error.hint,
    )


def _cache_ns(cache: DurationLike) -> int:
    nanoseconds = time.duration_ns(cache)
    if nanoseconds < 0:
        raise ValueError(f"a cache of {nanoseconds} ns: it must not be negative; None keeps everything")
    return nanoseconds


def _stamp_of(transform: Transform, stamp: StampLike | None) -> int:
    return (transform.stamp if stamp is None else time.stamp_ns(stamp)) or 0


def _check_frames(parent: str, child: str, transform: Transform) -> None:
    told = (transform.target or parent, transform.source or child)
    if told != (parent, child):
        raise InvalidArgumentException.with_details(
            f"the transform is {told[0]} <- {told[1]}, but is set as {parent} <- {child}",
            target=parent,
            source=child,
            hint="set(parent, child, transform) wants parent as the transform's target and child as its source.",
        )
