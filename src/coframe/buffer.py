"""Buffer: transforms over time, and the answer to "where was this frame, seen from that one, then?"."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, NamedTuple

from coframe import _core, errors, time
from coframe.errors import InvalidArgumentException, TimeoutException, TransformException

if TYPE_CHECKING:
    from coframe.time import DurationLike, StampLike
    from coframe.transform import Transform

__all__ = ["Buffer", "FrameInfo"]

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
        facts = (parent, child, when or 0, *transform.values)
        refusals = self.set_values(*facts, static, authority)
        errors_found = [text for level, text in _core.insert_texts(refusals, *facts, authority) if level == "error"]
        if errors_found:
            raise InvalidArgumentException.telling(
                "\n".join(errors_found), target=parent, source=child, edge=(parent, child), hint=_REFUSED_HINT
            )
        return refusals == 0

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
            raise TimeoutException.telling(
                f"waited {timeout} in vain for the transform from {source!r} to {target!r}: {error}",
                target=error.target,
                source=error.source,
                requested=error.requested,
                earliest=error.earliest,
                latest=error.latest,
                edge=error.edge,
                hint=error.hint,
            ) from error

    def frames(self) -> list[FrameInfo]:
        """Every frame that was ever mentioned, in the order in which they were."""
        return [FrameInfo(*facts) for facts in self.frame_tuples()]

    def __contains__(self, frame: object) -> bool:
        return isinstance(frame, str) and self.frame_exists(frame)

    def __repr__(self) -> str:
        cache = "everything" if self.cache_ns < 0 else f"{self.cache_ns / time.NANOSECONDS_PER_SECOND:g}s"
        return f"Buffer(cache={cache}, frames={len(self.frame_names())})"


_REFUSED_HINT = "Names must differ and not be empty, values must be numbers, and a quaternion must not be zero."


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
