# SPDX-License-Identifier: Apache-2.0
"""Buffer: stores transforms over time and answers "what is the pose of frame A relative to frame B at time t?"."""

from __future__ import annotations

import contextlib
import sys
import time as system_time
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, TypeAlias, overload

import numpy as np

from coframe import _core, errors, frozen_file, html_tables, time
from coframe.analysis.clocks import present_for
from coframe.analysis.liveness import buffered_period, is_stale
from coframe.dispatcher import Dispatcher
from coframe.errors import InvalidArgumentException, TimeoutException, TransformException
from coframe.formatting import duration, seconds
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
    from coframe.viewer import Viewer

__all__ = ["Buffer", "CallbackHandle", "EdgeInfo", "FrameInfo"]

OnError: TypeAlias = Literal["raise", "nan", "clip"]
Array: TypeAlias = "NDArray[np.float64]"

_KEEP_EVERYTHING = -1
DEFAULT_AUTHORITY = "no recorded authority"

_core.register_errors(errors)
_core.register_time(time)


class FrameInfo(NamedTuple):
    """The state of one frame in a buffer.

    Attributes:
        name: Name of the frame.
        parent: Parent frame of the newest sample; "" for the root of a tree or before any data.
        static: Whether the transform is valid for all time.
        samples: Number of samples in the buffer.
        oldest: Stamp of the oldest sample in nanoseconds; 0 if static or without data.
        newest: Stamp of the newest sample in nanoseconds; 0 if static or without data.
        rate: Samples per second over the length of the cache, as tf2 computes it; 0 if static.
        authority: Publisher of the newest sample.
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
    """The state of the edge between a frame and its parent. All times are in nanoseconds.

    Attributes:
        parent: Parent frame of the newest sample; "" before any data.
        child: The child frame.
        static: Whether the transform is valid for all time; then the times and rates are 0 and the age is None.
        authority: Publisher of the newest sample.
        samples: Number of samples in the buffer.
        oldest: Stamp of the oldest sample.
        newest: Stamp of the newest sample.
        age: Age of the newest sample; negative if it is ahead of the clock, None if static or without data, and in
            recordings and snapshots if no time was given.
        rate: Samples per second, from the mean interval between the stamps in the buffer.
        jitter: Standard deviation of these intervals.
        longest_gap: The longest of these intervals.
        stored: Number of samples stored since the buffer was created.
        late: Number of stored samples that were older than the newest one at that time.
        repeated: Number of exact repetitions, which change nothing.
        rejected: Number of rejected samples by reason: ``"older than the cache"``, ``"not a number"``,
            ``"invalid quaternion"``, ``"its own parent"``. Reasons that did not occur are omitted.
        stale: Whether the edge is stale: it is not static, and its newest sample is older than 1 s and than 5 times
            the median interval between its stamps. None where the present is not known: in recordings, and where the
            stamps are not on the system clock and no `now` was given.
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
    stale: bool | None


class CallbackHandle:
    """A registered callback, as :meth:`Buffer.on_change` returns it; also a context manager that removes it.

    Example:
        >>> import coframe
        >>> buffer = coframe.Buffer()
        >>> with buffer.on_change(lambda edge: print(edge.child)):
        ...     pass  # the callback is registered here
    """

    def __init__(self, cancel: Callable[[], object]) -> None:
        self._cancel = cancel

    def close(self) -> None:
        """Remove the callback. A call in progress is completed; closing again has no effect."""
        self._cancel()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


class Buffer(_core.Buffer):
    """Store of transforms over time with the semantics of tf2, safe to use from any number of threads.

    All stamps are in nanoseconds; 0 or None means the latest time at which every edge between the frames has data.
    By default there is no extrapolation. A failed lookup raises the same exception as tf2 with the same text, and
    with a ``hint``.

    Args:
        cache: How long dynamic transforms are kept: text such as ``"10s"``, int nanoseconds or a timedelta. None
            keeps everything, which suits recordings.

    Raises:
        TypeError: ``cache`` is not a duration; a float of seconds is not accepted.
        ValueError: ``cache`` is negative, or its text is not a number and a unit, or it is a positive int below
            100 000: such a cache would be shorter than 100 us.

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
        self._dispatcher = Dispatcher()

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
        """Store the pose of ``child`` relative to ``parent`` at one time.

        Args:
            parent: The parent frame, in which the transform is expressed.
            child: The child frame, whose pose the transform describes.
            transform: A single transform. If it names its frames, its target must be ``parent`` and its source
                ``child``.
            stamp: Time of the sample, in nanoseconds or as another :data:`~coframe.time.StampLike`; by default the
                stamp of the transform. Static transforms need no stamp.
            static: Whether the transform is valid for all time. A frame that changes between static and dynamic loses
                its earlier samples.
            authority: Name of the publisher, as shown in reports.

        Returns:
            True if the sample was stored; False if it was older than the cache.

        Raises:
            InvalidArgumentException: tf2 rejects the transform (empty or equal frame names, NaN, ...), with tf2's
                text; or the transform is between other frames, or has no stamp, or the buffer is frozen.
            TypeError: ``transform`` is not a :class:`coframe.Transform`.
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
        """Store any valid arguments of `set`, and return the reasons for refusal as bits."""
        if not isinstance(transform, _core.Transform):
            raise TypeError(
                f"set() takes a coframe.Transform, not {type(transform).__name__}. Create one with "
                "Transform(translation, quaternion), Transform.from_rpy(...) or Transform.from_matrix(...)."
            )
        if transform.shape:
            raise InvalidArgumentException.with_details(
                f"set() takes a single transform, not a batch of shape {transform.shape}",
                hint="Use set_many() for a batch.",
            )
        _check_frames(parent, child, transform)
        if stamp is None and transform.stamp is None and not static:
            raise InvalidArgumentException.with_details(
                f"the dynamic transform {parent!r} -> {child!r} has no stamp",
                hint="Pass stamp=..., or static=True if the transform never changes.",
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
        """Store many samples of one edge, like :meth:`set` for each of them in the order of their stamps.

        Args:
            parent: The parent frame, in which the poses are expressed.
            child: The child frame, whose poses these are.
            stamps: Times of the samples, shape (N,), int64 nanoseconds or datetime64, in any order; None uses the
                stamps of the batch.
            poses: A batch of shape (N,), or an array of shape (N, 7): x, y, z in metres and qx, qy, qz, qw.
            static: Whether the transform is valid for all time; then the last sample is used.
            authority: Name of the publisher, as shown in reports.

        Returns:
            The number of stored samples. Samples older than the cache are not stored.

        Raises:
            InvalidArgumentException: tf2 rejects one of the samples, with tf2's text, or the buffer is frozen; then
                no sample is stored.
            ValueError: The shapes do not match.
        """
        if isinstance(poses, _core.Transform):
            _check_frames(parent, child, poses)
            stamps = poses.stamps if stamps is None else stamps
            poses = np.concatenate([poses.translation, poses.quaternion], axis=-1)
        values = np.ascontiguousarray(poses, dtype=np.float64)
        if stamps is None:
            raise InvalidArgumentException.with_details(
                f"the dynamic transforms {parent!r} -> {child!r} have no stamps",
                hint="Pass stamps=..., an array of nanoseconds.",
            )
        times = np.ascontiguousarray(stamps_of(stamps))
        if times.ndim != 1 or values.shape != (*times.shape, 7):
            raise ValueError(f"stamps must have shape (N,) and poses (N, 7), not {times.shape} and {values.shape}")
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
        """Look up the transform from ``source`` to ``target`` at many times.

        Args:
            target: The target frame.
            source: The source frame.
            stamps: Times of the lookups, shape (N,), int64 nanoseconds or datetime64, in any order; 0 means the
                latest.
            out: float64 array to fill and return instead of a new batch. Shape (N, 7) receives x, y, z in metres and
                qx, qy, qz, qw; shape (N, 4, 4) receives matrices.
            threads: Number of threads to use.
            on_error: What to do with a time without a transform: ``"raise"`` the exception of :meth:`lookup`, fill
                its row with ``"nan"``, or ``"clip"`` it to the interval in which all edges have data.
            twist: Whether to return the twist of ``source`` relative to ``target`` as well.
            extrapolate: As in :meth:`lookup`.
            hold: As in :meth:`lookup`.

        Returns:
            A batch of shape (N,) with its ``stamps``, or ``out``. With ``twist`` a tuple of that and an array of
            shape (N, 6): linear velocity in m/s and angular velocity in rad/s of the origin of ``source``, expressed
            in ``target``, from the interpolation between samples (at a sample: in the interval after it).

        Raises:
            TransformException: As :meth:`lookup`; with ``"nan"`` only if no row has a transform.
            ValueError: ``stamps`` or ``out`` has another shape or type.

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
            raise ValueError(f"stamps must have shape (N,), not {times.shape}")
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
        """Return the path of ``source`` relative to ``target``, at the times of the samples or at a chosen spacing.

        Args:
            target: The target frame, in which the poses are expressed.
            source: The source frame, whose poses these are.
            start: Time of the first pose; None starts when all edges have data.
            stop: Time of the last pose; None stops when an edge has no more data.
            max_translation: Largest distance between two successive poses, in metres.
            max_rotation: Largest rotation between two successive poses, in radians. With one of these two limits, the
                result has as few poses as the limits allow: where nothing moves, only the first and the last pose.

        Returns:
            A batch with its ``stamps``, in order. If all edges are static, a batch of one pose.

        Raises:
            TransformException: As :meth:`lookup`.
            ValueError: A limit is not positive.
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
        """Return the time interval in which every edge between two frames has data.

        Returns:
            The first and the last time in nanoseconds; (0, 0) if all edges are static.

        Raises:
            TransformException: As :meth:`lookup`, or the edges have no common time.
        """
        ends = np.array([np.iinfo(np.int64).min + 1, np.iinfo(np.int64).max])
        if self.latest_common_time(target, source) == 0:
            return 0, 0
        self._lookup_rows(target, source, ends, np.empty((2, 7)), None, None, "clip", 1)
        if ends[0] == np.iinfo(np.int64).min + 1:  # Both names are those of one frame: there are no edges.
            return 0, 0
        return int(ends[0]), int(ends[1])

    def wait(
        self, target: str, source: str, stamp: StampLike | None = None, *, timeout: DurationLike | None = None
    ) -> Transform:
        """Wait until the transform is available, and return it.

        Args:
            target: The target frame.
            source: The source frame.
            stamp: Time of the lookup, as in :meth:`lookup`.
            timeout: How long to wait, such as ``"2s"``; None waits without a limit.

        Returns:
            The transform, as :meth:`lookup` returns it.

        Raises:
            TimeoutException: The transform did not become available in time; ``__cause__`` is the failed lookup.
        """
        try:
            return self.lookup(target, source, stamp, timeout=sys.maxsize if timeout is None else timeout)
        except TransformException as error:
            raise _timed_out(target, source, timeout, error) from error

    async def wait_async(
        self, target: str, source: str, stamp: StampLike | None = None, *, timeout: DurationLike | None = None
    ) -> Transform:
        """Wait until the transform is available, in asyncio: other tasks run meanwhile, and no thread blocks.

        Args:
            target: The target frame.
            source: The source frame.
            stamp: Time of the lookup, as in :meth:`lookup`.
            timeout: How long to wait, such as ``"2s"``; None waits without a limit.

        Returns:
            The transform, as :meth:`lookup` returns it.

        Raises:
            TimeoutException: The transform did not become available in time; ``__cause__`` is the failed lookup.
        """
        import asyncio  # noqa: PLC0415 - asyncio takes as long to import as all of coframe, and few programs need it

        loop = asyncio.get_running_loop()
        future: asyncio.Future[Transform | None] = loop.create_future()

        def settle(found: Transform | None) -> None:
            if not future.done():
                future.set_result(found)

        def settle_in_loop(found: Transform | None) -> None:
            with contextlib.suppress(RuntimeError):  # the event loop is closed
                loop.call_soon_threadsafe(settle, found)

        cancel = self._dispatcher.wait(
            lambda mailbox, token: _core.wait(self, mailbox, token, target, source, stamp),
            settle_in_loop,
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
            raise _timed_out(target, source, timeout, error) from error

    def why(
        self, target: str, source: str, at: StampLike | None = None, *, now: StampLike | None = None
    ) -> Explanation:
        """Explain why :meth:`lookup` succeeds or fails: the chain of edges, and which one is missing, late or early.

        Args:
            target: The target frame.
            source: The source frame.
            at: Time of the lookup; 0 or None means the latest.
            now: The current time on the clock of the stamps, in nanoseconds. By default the system time, if the stamps
                are within an hour of it. Buffers that are frozen or keep everything hold recordings, for which there
                is no current time.

        Returns:
            The explanation; ``print()`` draws it.
        """
        from coframe.explanation import explain  # noqa: PLC0415 - most programs never need an explanation

        return explain(self, target, source, at, now=now)

    def on_change(self, callback: Callable[[EdgeInfo], object], *, child: str | None = None) -> CallbackHandle:
        """Call ``callback`` when the edge between ``child`` and its parent receives a new sample.

        The calls come from a separate thread, one after another and with no lock held, so the callback may use the
        buffer. Samples that arrive during a call lead to one more call.

        Args:
            callback: Called with the current state of the edge.
            child: The child frame of the edge, which need not exist yet; None means every edge.

        Returns:
            A handle. Close it to remove the callback; the callback is also removed together with the buffer.
        """

        def report(changed: list[str]) -> None:
            for edge in self.edges(changed):
                callback(edge)

        start = lambda mailbox, token: _core.watch(self, mailbox, token, child or "")  # noqa: E731 - one expression
        return CallbackHandle(self._dispatcher.watch(start, report))

    def snapshot(self) -> Buffer:
        """Return a frozen copy of the buffer as it is now; the samples are shared, not copied."""
        copy = Buffer.__new__(Buffer)
        _core.Buffer.__init__(copy, self.cache_ns)
        copy._become_snapshot(self)
        copy._dispatcher = Dispatcher()
        return copy

    def save(self, path: str | os.PathLike[str]) -> None:
        """Save the buffer to a file that :func:`coframe.load` opens without reading it first.

        A sample takes 72 bytes, and a moving frame up to 18 kB more. The file is complete or does not appear at all.

        Args:
            path: The file, usually ``*.cfz``. An existing file is replaced.

        Raises:
            FrozenFileError: The file cannot be written.
        """
        frozen_file.save(self.snapshot(), path)

    def edges(self, children: list[str] | None = None, *, now: int | None = None) -> list[EdgeInfo]:
        """Return the state of the edges between frames and their parents.

        Args:
            children: Child frames of the edges to return; None returns all edges.
            now: Current time in nanoseconds, from which ages are computed; by default the system time, and no age for
                recordings. Pass the time of the clock for simulations.
        """
        given = now is not None or self.frozen or self.cache_ns < 0
        wall = system_time.time_ns() if now is None else now
        edges = []
        for facts in self._edge_tuples(children):
            newest = facts[0][5]
            present = now if given else present_for(newest, wall)
            edges.append(_edge_info(self, *facts, None if now is None and given else wall, present))
        return edges

    def frames(self) -> list[FrameInfo]:
        """Return the state of every frame, in the order in which the buffer received them."""
        return [FrameInfo(*facts) for facts in self._frame_tuples()]

    def _check_not_frozen(self, parent: str, child: str) -> None:
        if self.frozen:
            raise InvalidArgumentException.with_details(
                f"the buffer is frozen: the transform {parent!r} -> {child!r} was not stored",
                target=parent,
                source=child,
                hint="A snapshot, a loaded file and a buffer after freeze() are read-only. Use a new coframe.Buffer().",
            )

    def __contains__(self, frame: object) -> bool:
        return isinstance(frame, str) and self.frame_exists(frame)

    def __repr__(self) -> str:
        cache = "everything" if self.cache_ns < 0 else f"{self.cache_ns / time.SECOND:g}s"
        return f"Buffer(cache={cache}, frames={len(self.frame_names())})"

    def show(self, **options: Any) -> Viewer:
        """Show the frames in the viewer, in a notebook below the cell; the same as :func:`coframe.show`.

        Args:
            options: The options of :func:`coframe.show`, such as ``fixed="map"``.
        """
        import coframe  # noqa: PLC0415 - the viewer is above this module

        return coframe.show(self, **options)

    def _repr_html_(self) -> str:
        children = [frame.name for frame in self.frames() if frame.parent]
        edges = self.edges(children[: html_tables.MOST_ROWS])
        rows = [
            (edge.parent, edge.child, edge.samples, "static", "", "", edge.authority)
            if edge.static
            else (
                edge.parent,
                edge.child,
                edge.samples,
                f"{edge.rate:.3g} Hz",
                seconds(edge.oldest),
                seconds(edge.newest),
                edge.authority,
            )
            for edge in edges
        ]
        columns = ("parent", "child", "samples", "rate", "oldest [s]", "newest [s]", "publisher")
        return html_tables.section(repr(self), html_tables.table(columns, rows, len(children), "edge"))


_core.register_buffer_class(Buffer)


_REFUSED_HINT = "Frame names must differ and not be empty, values must be finite, and a quaternion must not be zero."


def _is_rows(out: Array, count: int) -> bool:
    """Return whether poses can be written to `out` directly; False for matrices."""
    if out.dtype == np.float64 and out.shape in {(count, 7), (count, 4, 4)}:
        return out.ndim == 2 and out.flags.c_contiguous and out.flags.writeable
    raise ValueError(
        f"out must be float64 of shape ({count}, 7) or ({count}, 4, 4), not {out.dtype} of shape {out.shape}"
    )


_REASONS = ("older than the cache", "its own parent", "not a number", "invalid quaternion")


def _edge_info(
    buffer: Buffer,
    frame: tuple[str, str, bool, int, int, int, float, str],
    intervals: tuple[float, float, float],
    counts: tuple[int, int, int, int, int, int, int],
    now: int | None,
    present: int | None,
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
        age=None if static or not samples or now is None else now - newest,
        rate=time.SECOND / mean if mean else 0.0,
        jitter=deviation,
        longest_gap=round(longest),
        stored=stored,
        late=late,
        repeated=repeated,
        rejected={reason: count for reason, count in zip(_REASONS, refused, strict=True) if count},
        stale=_is_stale(buffer, frame, present),
    )


def _is_stale(
    buffer: Buffer, frame: tuple[str, str, bool, int, int, int, float, str], present: int | None
) -> bool | None:
    child, parent, static, samples, oldest, newest, *_ = frame
    if static or not samples:
        return False
    if present is None:
        return None
    silence = present - newest
    # The period is read only if the result depends on it.
    return is_stale(silence, 0.0) and is_stale(silence, buffered_period(buffer, parent, child, oldest, newest, samples))


def _timed_out(target: str, source: str, timeout: DurationLike | None, error: TransformException) -> TimeoutException:
    length = "" if timeout is None else f" after {duration(time.duration_ns(timeout))}"
    return TimeoutException.with_details(
        f"timed out{length} waiting for the transform from {source!r} to {target!r}: {error}",
        target=error.target,
        source=error.source,
        requested=error.requested,
        earliest=error.earliest,
        latest=error.latest,
        edge=error.edge,
        hint=error.hint,
        doctor_code=error.doctor_code,
    )


def _cache_ns(cache: DurationLike) -> int:
    nanoseconds = time.duration_ns(cache)
    if nanoseconds < 0:
        raise ValueError(f"cache must not be negative, but is {cache!r}. Use None to keep everything.")
    return nanoseconds


def _stamp_of(transform: Transform, stamp: StampLike | None) -> int:
    return (transform.stamp if stamp is None else time.stamp_ns(stamp)) or 0


def _check_frames(parent: str, child: str, transform: Transform) -> None:
    frames = (transform.target or parent, transform.source or child)
    if frames != (parent, child):
        raise InvalidArgumentException.with_details(
            f"cannot store the transform {frames[0]} <- {frames[1]} as {parent} <- {child}",
            target=parent,
            source=child,
            hint="In set(parent, child, transform), parent must be the transform's target and child its source.",
        )
