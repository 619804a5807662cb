"""Buffer: transforms over time, and the answer to "where was this frame, seen from that one, then?"."""

from __future__ import annotations

import contextlib
import sys
import time as system_time
from typing import TYPE_CHECKING, Literal, NamedTuple

import numpy as np

from coframe import _core, errors, time
from coframe.dispatcher import Dispatcher
from coframe.errors import InvalidArgumentException, TimeoutException, TransformException
from coframe.transform import batch_of, stamps_of

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import ArrayLike
    from typing_extensions import Self

    from coframe.time import DurationLike, StampLike
    from coframe.transform import Transform

__all__ = ["Buffer", "EdgeInfo", "FrameInfo", "Subscription"]

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
        if not isinstance(transform, _core.Transform):
            raise TypeError(
                f"set() takes a coframe.Transform, not {type(transform).__name__}: make one by "
                "Transform(translation, quaternion), Transform.from_rpy(...) or Transform.from_matrix(...)"
            )
        if transform.shape:
            raise InvalidArgumentException("set() takes a single transform, not a batch")
        _check_frames(parent, child, transform)
        when = transform.stamp if stamp is None else time.stamp_ns(stamp)
        if when is None and not static:
            raise InvalidArgumentException.telling(
                f"a dynamic transform from {parent!r} to {child!r} needs a stamp",
                hint="Give stamp=..., or static=True if it never changes.",
            )
        if self.frozen:
            raise InvalidArgumentException.telling(
                f"the buffer is frozen: the transform from {parent!r} to {child!r} was not stored",
                target=parent,
                source=child,
                hint="A snapshot() and a buffer after freeze() only answer; set it in the buffer that lives on.",
            )
        facts = (parent, child, when or 0, *transform.values)
        refusals = self.set_values(*facts, static, authority)
        errors_found = [text for level, text in _core.insert_texts(refusals, *facts, authority) if level == "error"]
        if errors_found:
            raise InvalidArgumentException.telling(
                "\n".join(errors_found), target=parent, source=child, edge=(parent, child), hint=_REFUSED_HINT
            )
        return refusals == 0

    def lookup_many(
        self,
        target: str,
        source: str,
        stamps: ArrayLike,
        *,
        on_error: Literal["raise", "nan"] = "raise",
        extrapolate: DurationLike | None = None,
        hold: bool = False,
    ) -> Transform:
        """:meth:`lookup` at many times at once.

        Args:
            target: The frame the answers are in.
            source: The frame that is asked about.
            stamps: (N,) int64 nanoseconds or datetime64; 0 asks for the latest. Need not be sorted.
            on_error: ``"raise"`` as the first look-up without an answer does, or fill its row with ``"nan"``.
            extrapolate: As of :meth:`lookup`.
            hold: As of :meth:`lookup`.

        Returns:
            A batch of shape (N,), with its ``stamps``.

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
        if on_error not in {"raise", "nan"}:
            raise ValueError(f'on_error must be "raise" or "nan", not {on_error!r}')
        times = np.array(stamps_of(stamps), dtype=np.int64, ndmin=1)
        translations, quaternions = np.empty((*times.shape, 3)), np.empty((*times.shape, 4))
        beyond = np.zeros_like(times)
        arrays = (times, translations, quaternions, beyond)
        missing = self.lookup_rows(target, source, *arrays, on_error == "nan", extrapolate, hold)
        if missing == 0 and times.size and np.isnan(translations).all():
            self.lookup(target, source, int(np.asarray(stamps_of(stamps)).flat[0]), extrapolate=extrapolate, hold=hold)
        return batch_of(translations, quaternions, target, source, times, beyond if extrapolate is not None else None)

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
        copy.become_snapshot(self)
        copy.dispatcher = Dispatcher()
        return copy

    def edges(self, children: list[str] | None = None, *, now: int | None = None) -> list[EdgeInfo]:
        """The links between frames and their parents, and what came in for them.

        Args:
            children: Only the edges of these frames.
            now: What ages are told from, in nanoseconds; by default the system's clock. Recordings and simulations
                have a time of their own.
        """
        now = system_time.time_ns() if now is None else now
        wanted = None if children is None else set(children)
        found = (_edge_info(*facts, now) for facts in self.edge_tuples())
        return [edge for edge in found if wanted is None or edge.child in wanted]

    def frames(self) -> list[FrameInfo]:
        """Every frame that was ever mentioned, in the order in which they were."""
        return [FrameInfo(*facts) for facts in self.frame_tuples()]

    def __contains__(self, frame: object) -> bool:
        return isinstance(frame, str) and self.frame_exists(frame)

    def __repr__(self) -> str:
        cache = "everything" if self.cache_ns < 0 else f"{self.cache_ns / time.NANOSECONDS_PER_SECOND:g}s"
        return f"Buffer(cache={cache}, frames={len(self.frame_names())})"


_REFUSED_HINT = "Names must differ and not be empty, values must be numbers, and a quaternion must not be zero."


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
        rate=time.NANOSECONDS_PER_SECOND / mean if mean else 0.0,
        jitter=deviation,
        longest_gap=round(longest),
        stored=stored,
        late=late,
        repeated=repeated,
        rejected={reason: count for reason, count in zip(_REASONS, refused, strict=True) if count},
    )


def _in_vain(target: str, source: str, timeout: DurationLike | None, error: TransformException) -> TimeoutException:
    return TimeoutException.telling(
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


def _check_frames(parent: str, child: str, transform: Transform) -> None:
    told = (transform.target or parent, transform.source or child)
    if told != (parent, child):
        raise InvalidArgumentException.telling(
            f"the transform is {told[0]} <- {told[1]}, but is set as {parent} <- {child}",
            target=parent,
            source=child,
            hint="set(parent, child, transform) wants parent as the transform's target and child as its source.",
        )
