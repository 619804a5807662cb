# SPDX-License-Identifier: Apache-2.0
"""The buffer: a thread-safe store of transforms over time."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any

from coframe import _core, errors, time
from coframe.buffer import _covariances, _frozen_file, _many_lookups
from coframe.buffer._storing import (
    check_not_frozen,
    check_rows,
    check_single,
    rejection_error,
    row_rejection_error,
    stamp_of,
)
from coframe.buffer._waiting import CallbackHandle, timeout_error, transform_or_timeout
from coframe.buffer.dispatcher import Dispatcher
from coframe.buffer.edge_info import FrameInfo, edge_infos, edge_table
from coframe.errors import TransformException
from coframe.transform.interpolation import is_screw
from coframe.transform.transform import Transform

if TYPE_CHECKING:
    import os
    from collections.abc import Callable

    from numpy.typing import ArrayLike

    from coframe.buffer.edge_info import EdgeInfo
    from coframe.buffer.explanation import Explanation
    from coframe.time import DurationLike, StampLike
    from coframe.transform.interpolation import Interpolation
    from coframe.viewer import Viewer

_KEEP_EVERYTHING = -1
DEFAULT_AUTHORITY = "no recorded authority"

_core.register_errors(errors)
_core.register_time(time)


class Buffer(_many_lookups.Buffer):
    """Thread-safe store of transforms over time with the semantics of tf2.

    All stamps are in nanoseconds; 0 or None means the latest time at which every edge between the frames has data.
    By default there is no extrapolation. A failed lookup raises the same exception as tf2 with the same message, plus a
    ``hint``. A buffer can be pickled, which gives the other process a frozen copy.

    Args:
        cache: How long dynamic transforms are kept: a string such as ``"10s"``, int nanoseconds or a timedelta. None
            keeps everything, as needed for recordings.
        interpolation: How poses between two samples are computed: ``"decoupled"``, the translation on a line and the
            rotation along an arc, as in tf2; or ``"screw"``, with a constant twist of the child, which is exact for a
            robot that drives along a circle.

    Raises:
        TypeError: ``cache`` is not a duration; a float of seconds is not accepted.
        ValueError: ``interpolation`` is unknown; or ``cache`` is negative, is not a number with a unit, or is a
            positive int below 100 000, which would be shorter than 100 us.

    Example:
        >>> import coframe
        >>> buffer = coframe.Buffer()
        >>> lidar = coframe.Transform.from_rpy([0.1, 0.0, 0.3])
        >>> buffer.set("base_link", "lidar", lidar, static=True)
        True
        >>> buffer.lookup("base_link", "lidar").translation.tolist()
        [0.1, 0.0, 0.3]
    """

    def __init__(self, cache: DurationLike | None = "10s", *, interpolation: Interpolation = "decoupled") -> None:
        super().__init__(cache_length(cache), is_screw(interpolation))
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
        covariance: ArrayLike | None = None,
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
            covariance: Covariance of the pose as in ROS's PoseWithCovariance, shape (6, 6) or (36,); by default that
                of the transform. See :attr:`coframe.Transform.covariance`.

        Returns:
            True if the sample was stored, or False if it was older than the cache.

        Raises:
            InvalidArgumentException: tf2 rejects the transform (empty or equal frame names, NaN, ...), with tf2's
                message; or the transform has other frames or no stamp, or the buffer is frozen.
            TypeError: ``transform`` is not a :class:`coframe.Transform`.
        """
        if covariance is not None:
            transform = transform.with_covariance(covariance)
        refusals = self._set_plain(parent, child, transform, stamp, static) if authority is DEFAULT_AUTHORITY else None
        if refusals is None:
            refusals = self._set(parent, child, transform, stamp, static, authority)
        if refusals == 0:
            return True
        facts = (parent, child, stamp_of(transform, stamp), *transform.values)
        errors_found = [text for level, text in _core.insert_texts(refusals, *facts, authority) if level == "error"]
        if errors_found:
            raise rejection_error(parent, child, "\n".join(errors_found))
        return False

    def _set(
        self, parent: str, child: str, transform: Transform, stamp: StampLike | None, static: bool, authority: str
    ) -> int:
        """Store any valid arguments of `set`, and return the reasons for rejection as bits."""
        check_single(parent, child, transform, stamp, static=static)
        check_not_frozen(self, parent, child)
        when = stamp_of(transform, stamp)
        refusals = self._set_values(parent, child, when, *transform.values, static, authority)
        if refusals == 0 and transform.covariance is not None:
            _covariances.store_covariances(self, child, transform, when, static=static)
        return refusals

    def set_many(
        self,
        parent: str,
        child: str,
        stamps: ArrayLike | None,
        poses: Transform | ArrayLike,
        *,
        static: bool = False,
        authority: str = DEFAULT_AUTHORITY,
        covariance: ArrayLike | None = None,
    ) -> int:
        """Store many samples of one edge, like :meth:`set` for each of them in the order of their stamps.

        Args:
            parent: The parent frame, in which the poses are expressed.
            child: The child frame, whose poses are stored.
            stamps: Times of the samples, shape (N,), int64 nanoseconds or datetime64, in any order; None uses the
                stamps of the batch.
            poses: A batch of shape (N,), or an array of shape (N, 7): x, y, z in meters and qx, qy, qz, qw.
            static: Whether the transform is valid for all time; if so, the last sample is used.
            authority: Name of the publisher, as shown in reports.
            covariance: Covariances as in :meth:`set`, shape (N, 6, 6) or one for all; by default those of the batch.

        Returns:
            The number of stored samples. Samples older than the cache are not stored.

        Raises:
            InvalidArgumentException: tf2 rejects one of the samples (with tf2's message), or the buffer is frozen. In
                both cases, no sample is stored.
            ValueError: The shapes do not match.
        """
        times, values = check_rows(parent, child, stamps, poses)
        check_not_frozen(self, parent, child)
        rejections, stored, row = self._set_rows(parent, child, times, values, static, authority)
        if rejections:
            x, y, z, qx, qy, qz, qw = values[row].tolist()
            texts = _core.insert_texts(rejections, parent, child, int(times[row]), x, y, z, qx, qy, qz, qw, authority)
            raise row_rejection_error(parent, child, row, values[row, 3:], "\n".join(line for _, line in texts))
        if covariance is not None:
            poses = Transform(values[:, :3], values[:, 3:], covariance=covariance)
        if isinstance(poses, Transform) and poses.covariance is not None and times.size:
            _covariances.store_covariances(self, child, poses, times, static=static)
        return stored

    def set_covariance(self, parent: str, child: str, pose: Transform | Any, *, static: bool = False) -> None:
        """Store only the covariance of a pose, for an edge whose poses come from elsewhere, such as /tf.

        It is interpolated along the axes of ``child`` between the stamps around a time, and held before the first and
        after the last one. It changes no pose, so it may be stored in frozen buffers and those of recordings, too.

        Args:
            parent: The parent frame, in which the pose is expressed.
            child: The child frame.
            pose: A message with a covariance, such as Odometry or PoseWithCovarianceStamped, or a transform or batch
                with covariances and stamps.
            static: Whether the covariance is valid for all time.

        Raises:
            InvalidArgumentException: The pose has no covariance or no stamp, or is between other frames.

        Example:
            >>> import coframe
            >>> import numpy as np
            >>> buffer = coframe.Buffer(None)
            >>> _ = buffer.set("odom", "base", coframe.Transform([1, 0, 0]), 5, covariance=np.eye(6))
            >>> _ = buffer.set("base", "lidar", coframe.Transform([0, 0, 1]), static=True)
            >>> found = buffer.lookup("odom", "lidar", 5, covariance=True)
            >>> found.covariance[0].tolist(), found.exact_edges
            ([2.0, 0.0, 0.0, 0.0, 1.0, 0.0], ('lidar',))
        """
        _covariances.set_covariance(self, parent, child, pose, static=static)

    def frames_with_covariance(self) -> list[str]:
        """Return the child frames of the edges that have a covariance; all other edges count as exact."""
        return list(_covariances.covariances_of(self))

    def _lookup_composed(
        self,
        target: str,
        source: str,
        stamp: StampLike | None,
        timeout: DurationLike | None,
        extrapolate: DurationLike | None,
        hold: bool,
        max_gap: DurationLike | None,
        fixed: str | None,
        source_time: StampLike | None,
        covariance: bool,
    ) -> Transform:
        """Look up at two times, or with a covariance. The native :meth:`lookup` calls this."""

        def lookup(upper: str, lower: str, at: StampLike | None) -> Transform:
            return self.lookup(upper, lower, at, timeout=timeout, extrapolate=extrapolate, hold=hold, max_gap=max_gap)

        if fixed is None:
            if source_time is not None:
                raise ValueError("source_time needs fixed, a frame that does not move between both times")
            pose = lookup(target, source, stamp)
            return _covariances.with_covariance(self, pose, lambda a, b: lookup(a, b, pose.stamp))
        source_stamp = stamp if source_time is None else source_time
        if not covariance and extrapolate is None and max_gap is None:
            return self._lookup_full(target, stamp, source, source_stamp, fixed, timeout=timeout)
        parts = [lookup(target, fixed, stamp), lookup(fixed, source, source_stamp)]
        if covariance:
            parts = [
                _covariances.with_covariance(self, part, lambda a, b, at=part.stamp: lookup(a, b, at))  # type: ignore[misc]
                for part in parts
            ]
        return (parts[0] @ parts[1]).replace(stamp=parts[0].stamp)

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
            raise timeout_error(target, source, timeout, error) from error

    async def wait_async(
        self, target: str, source: str, stamp: StampLike | None = None, *, timeout: DurationLike | None = None
    ) -> Transform:
        """Wait until the transform is available, in asyncio: other tasks run in the meantime, and no thread blocks.

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
        found = await transform_or_timeout(self, target, source, stamp, timeout)
        if found is not None:
            return found
        try:
            return self.lookup(target, source, stamp)
        except TransformException as error:
            raise timeout_error(target, source, timeout, error) from error

    def why(
        self, target: str, source: str, at: StampLike | None = None, *, now: StampLike | None = None
    ) -> Explanation:
        """Explain why :meth:`lookup` succeeds or fails: the chain of edges, and which one is missing, late or early.

        Args:
            target: The target frame.
            source: The source frame.
            at: Time of the lookup; 0 or None means the latest.
            now: The current time on the clock of the stamps, in nanoseconds. By default the system time, if the stamps
                are within an hour of it. Buffers that are frozen or keep everything contain recordings, for which there
                is no current time.

        Returns:
            The explanation; ``print()`` draws it.
        """
        from coframe.buffer.explanation import explain  # noqa: PLC0415 - most programs never need an explanation

        return explain(self, target, source, at, now=now)

    def on_change(self, callback: Callable[[EdgeInfo], object], *, child: str | None = None) -> CallbackHandle:
        """Call ``callback`` when the edge between ``child`` and its parent receives a new sample.

        The calls come from a separate thread, one after another and with no lock held, so the callback may use the
        buffer. Samples that arrive during a call lead to one more call. In a process that is forked later, this thread
        does not exist and the callback is not called; the process logs this once, and can register its own callbacks.

        Args:
            callback: Called with the current state of the edge.
            child: The child frame of the edge, which does not have to exist yet; None means every edge.

        Returns:
            A handle. Close it to remove the callback; the callback is also removed together with the buffer.
        """

        def report(changed_frames: list[str]) -> None:
            for edge in self.edges(changed_frames):
                callback(edge)

        start = lambda mailbox, token: _core.watch(self, mailbox, token, child or "")  # noqa: E731 - one expression
        return CallbackHandle(self._dispatcher.watch(start, report, is_user_watch=True))

    @property
    def interpolation(self) -> Interpolation:
        """How poses between two samples are computed: ``"decoupled"``, as in tf2, or ``"screw"``."""
        return "screw" if self._along_screws else "decoupled"

    def snapshot(self, *, interpolation: Interpolation | None = None) -> Buffer:
        """Return a frozen copy of the current buffer. The samples are shared, not copied.

        Args:
            interpolation: How the copy computes poses between two samples, such as ``"screw"`` for the buffer of a
                recording, or None for the same way.

        Raises:
            ValueError: ``interpolation`` is unknown.
        """
        copy = Buffer.__new__(Buffer)
        _core.Buffer.__init__(copy, self.cache_ns)
        copy._become_snapshot(self, is_screw(interpolation or self.interpolation))
        for child, edge in _covariances.covariances_of(self).items():
            _covariances.covariances_of(copy)[child] = edge.copy()
        copy._dispatcher = Dispatcher()
        return copy

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle the current transforms. The copy in the other process is frozen."""
        from coframe.buffer.frozen import restore_buffer  # noqa: PLC0415 - it imports this module

        return restore_buffer, (_frozen_file.content_of(self.snapshot()), self.interpolation)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Save the buffer to a file that :func:`coframe.load` opens without reading all of it.

        A sample takes 72 bytes, and a moving frame up to 18 kB more. The file is written atomically.

        Args:
            path: The file, usually ``*.cfz``. An existing file is replaced.

        Raises:
            FrozenFileError: The file cannot be written.
        """
        _frozen_file.save(self.snapshot(), path)

    def edges(self, children: list[str] | None = None, *, now: int | None = None) -> list[EdgeInfo]:
        """Return the state of the edges between frames and their parents.

        Args:
            children: Child frames of the edges to return; None returns all edges.
            now: Current time in nanoseconds, from which ages are computed; by default the system time, and no age for
                recordings. In a simulation, pass the simulated time.
        """
        return edge_infos(self, children, now)

    def frames(self) -> list[FrameInfo]:
        """Return the state of every frame, in the order in which the buffer received them."""
        return [FrameInfo(*facts) for facts in self._frame_tuples()]

    def __contains__(self, frame: object) -> bool:
        return isinstance(frame, str) and self.frame_exists(frame)

    def __repr__(self) -> str:
        cache = "everything" if self.cache_ns < 0 else f"{self.cache_ns / time.SECOND:g}s"
        return f"Buffer(cache={cache}, frames={len(self.frame_names())})"

    def show(self, **options: Any) -> Viewer:
        """Show the frames in the viewer, or below the cell in a notebook. This is the same as :func:`coframe.show`.

        Args:
            options: The options of :func:`coframe.show`, such as ``fixed="map"``.
        """
        from coframe.viewer.show import show as show_in_browser  # noqa: PLC0415 - the viewer is above this module

        return show_in_browser(self, **options)

    def _repr_html_(self) -> str:
        return edge_table(self)


_core.register_buffer_class(Buffer)


def cache_length(cache: DurationLike | None) -> int:
    """Return the length of a cache in nanoseconds; negative to keep everything, which is None.

    Raises:
        TypeError: The length is not a duration.
        ValueError: The length is negative, or not a number and a unit.
    """
    if cache is None:
        return _KEEP_EVERYTHING
    nanoseconds = time.duration_ns(cache)
    if nanoseconds < 0:
        raise ValueError(f"cache must not be negative, but is {cache!r}. Use None to keep everything.")
    return nanoseconds
