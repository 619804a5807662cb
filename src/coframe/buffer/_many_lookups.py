# SPDX-License-Identifier: Apache-2.0
"""Lookups at many times: batches, trajectories, and the time interval with data."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal, TypeAlias, overload

import coframe.lazy_numpy as np
from coframe import _core, time
from coframe.buffer import _covariances, gaps
from coframe.errors import ExtrapolationException
from coframe.transform.resampling import StepLimits
from coframe.transform.values import batch_of, stamps_of

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from coframe.buffer.gaps import OnGap, Validity
    from coframe.time import DurationLike, StampLike
    from coframe.transform.transform import Transform

OnError: TypeAlias = Literal["raise", "nan", "clip"]
Array: TypeAlias = "NDArray[np.float64]"


class Buffer(_core.Buffer):
    """The lookups of :class:`coframe.Buffer` at many times; error messages contain the name of this class."""

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
        max_gap: DurationLike | None = None,
        on_gap: OnGap = "raise",
        covariance: bool = False,
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
        max_gap: DurationLike | None = None,
        on_gap: OnGap = "raise",
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
        max_gap: DurationLike | None = None,
        on_gap: OnGap = "raise",
        covariance: bool = False,
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
        max_gap: DurationLike | None = None,
        on_gap: OnGap = "raise",
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
        max_gap: DurationLike | None = None,
        on_gap: OnGap = "raise",
        covariance: bool = False,
    ) -> Transform | Array | tuple[Transform | Array, Array]:
        """Look up the transform from ``source`` to ``target`` at many times.

        Args:
            target: The target frame.
            source: The source frame.
            stamps: Times of the lookups, shape (N,), int64 nanoseconds or datetime64, in any order; 0 means the
                latest.
            out: float64 array to fill and return instead of a new batch. Shape (N, 7) receives x, y, z in meters and
                qx, qy, qz, qw; shape (N, 4, 4) receives matrices.
            threads: Number of threads to use.
            on_error: What to do with a time without a transform: ``"raise"`` the exception of :meth:`lookup`, fill
                its row with ``"nan"``, or ``"clip"`` it to the interval in which all edges have data.
            twist: Whether to also return the twist of ``source`` relative to ``target``.
            extrapolate: As in :meth:`lookup`.
            hold: As in :meth:`lookup`.
            max_gap: The maximum interval between two samples of an edge for interpolation, such as ``"200ms"``. None
            means no limit, as in tf2; in a recording, a :class:`coframe.CoframeWarning` then
                reports gaps of more than ten periods of an edge and 500 ms.
            on_gap: What to do with a time in a longer gap: ``"raise"`` an ExtrapolationException, fill its row with
                ``"nan"``, or ``"omit"`` its row. :meth:`validity` returns the gap of each time.
            covariance: As in :meth:`lookup`; the chain of frames must be the same at all times. Not with ``out``.

        Returns:
            A batch of shape (N,) with its ``stamps``, or ``out``. With ``twist``, a tuple of this and an array of
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
        rows = out if out is not None and _is_row_array(out, times.size) else np.empty((times.size, 7))
        twists = np.empty((times.size, 6)) if twist else None
        extrapolated = np.empty_like(times) if extrapolate is not None else None
        limit = gaps.gap_limit(max_gap, on_gap)
        if out is not None:
            _check_out_options(limit, on_gap, covariance=covariance)
        missing = self._lookup_rows(
            target, source, times, rows, twists, extrapolated, on_error, threads, extrapolate, hold
        )
        if missing == 0 and times.size and np.isnan(rows[:, 0]).all():
            self.lookup(target, source, int(np.ravel(stamps_of(stamps))[0]), extrapolate=extrapolate, hold=hold)
        if limit is None:
            gaps.note_gaps(self, target, source, times)
        else:
            kept = self._find_outside_gaps(target, source, times, limit, on_gap)
            if on_gap == "omit":
                rows, times = rows[kept], times[kept]
                twists = None if twists is None else twists[kept]
                extrapolated = None if extrapolated is None else extrapolated[kept]
            else:
                rows[~kept] = np.nan
                if twists is not None:
                    twists[~kept] = np.nan
        if out is None:
            _freeze(rows, times, extrapolated)
        batch = batch_of(rows[:, :3], rows[:, 3:], target, source, times, extrapolated)
        if out is not None and out is not rows:
            out[...] = batch.matrix
        if covariance:
            batch = _covariances.with_covariance(
                self, batch, lambda a, b: self._lookup_without_gap_warning(a, b, times, "nan", extrapolate, hold=hold)
            )
        result = batch if out is None else out
        return result if twists is None else (result, twists)

    def _find_outside_gaps(
        self, target: str, source: str, stamps: NDArray[np.int64], limit: int, on_gap: OnGap
    ) -> NDArray[np.bool_]:
        """Return which times do not lie in a gap that is longer than the limit, or raise for the first one."""
        found = gaps.validity(self, target, source, stamps)
        inside = found.gaps > limit
        if on_gap == "raise" and inside.any():
            row = int(np.argmax(inside))
            rows = int(np.count_nonzero(inside))
            raise gaps.gap_error(found, row, limit, target, source, int(stamps[row]), rows=rows)
        return ~inside

    def validity(self, target: str, source: str, stamps: ArrayLike) -> Validity:
        """Return how far many times are from the samples that their poses are interpolated from.

        Args:
            target: The target frame.
            source: The source frame.
            stamps: Times as in :meth:`lookup_many`, shape (N,).

        Returns:
            For each time ``gaps``, the longest interval between two samples that is interpolated over, ``outside``, how
            far the time is from the first or last sample, both (N,) in nanoseconds, and ``edges``, the child frame of
            that edge.

        Raises:
            TransformException: The frames are not connected.

        Example:
            >>> import coframe
            >>> buffer = coframe.Buffer(None)
            >>> for second in (1, 2, 5):
            ...     _ = buffer.set("map", "base", coframe.Transform([second, 0, 0]), second * 1_000_000_000)
            >>> buffer.validity("map", "base", [2_000_000_000, 3_000_000_000]).gaps.tolist()
            [0, 3000000000]
        """
        return gaps.validity(self, target, source, np.array(stamps_of(stamps), ndmin=1))

    def _check_gap(self, target: str, source: str, stamp: int, max_gap: DurationLike) -> None:
        """Raise for a lookup over a longer gap. The native :meth:`lookup` calls this."""
        gaps.check_gap(self, target, source, stamp, max_gap)

    def trajectory(
        self,
        target: str,
        source: str,
        start: StampLike | None = None,
        stop: StampLike | None = None,
        *,
        max_translation: float | None = None,
        max_rotation: float | None = None,
        max_gap: DurationLike | None = None,
        on_gap: OnGap = "raise",
    ) -> Transform:
        """Return the path of ``source`` relative to ``target``, at the stamps of the samples or with a maximum spacing.

        Args:
            target: The target frame, in which the poses are expressed.
            source: The source frame, whose poses are returned.
            start: Time of the first pose; None starts when all edges have data.
            stop: Time of the last pose; None stops when an edge has no more data.
            max_translation: Maximum distance between two successive poses, in meters.
            max_rotation: Maximum rotation between two successive poses, in radians. With one of these two limits, the
                result has as few poses as the limits allow: where nothing moves, only the first and the last pose.
            max_gap: As in :meth:`lookup_many`.
            on_gap: As in :meth:`lookup_many`.

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
        gaps.gap_limit(max_gap, on_gap)  # Invalid values are refused before the work.
        if max_translation is None and max_rotation is None:
            path = self._lookup_without_gap_warning(target, source, stamps)
        else:
            steps = StepLimits(max_translation, max_rotation)
            path = steps.resample(lambda times: self._lookup_without_gap_warning(target, source, times), stamps)
        if path.stamps is not None and max_gap is not None:
            return self.lookup_many(target, source, path.stamps, max_gap=max_gap, on_gap=on_gap)
        if path.stamps is not None:
            gaps.note_gaps(self, target, source, path.stamps)
        return path

    def _lookup_without_gap_warning(
        self,
        target: str,
        source: str,
        stamps: NDArray[np.int64],
        on_error: OnError = "raise",
        extrapolate: DurationLike | None = None,
        *,
        hold: bool = False,
    ) -> Transform:
        """Return a batch without a word about gaps."""
        times = stamps.copy()
        rows = np.empty((times.size, 7))
        extrapolated = np.empty_like(times) if extrapolate is not None else None
        self._lookup_rows(target, source, times, rows, None, extrapolated, on_error, 1, extrapolate, hold)
        _freeze(rows, times, extrapolated)
        return batch_of(rows[:, :3], rows[:, 3:], target, source, times, extrapolated)

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
        try:
            self._lookup_rows(target, source, ends, np.empty((2, 7)), None, None, "clip", 1)
        except ExtrapolationException as error:
            from coframe.buffer.explanation import explain, no_common_time  # noqa: PLC0415 - only errors need it

            raise no_common_time(explain(self, target, source)) from error  # type: ignore[arg-type]  # the public class
        if ends[0] == np.iinfo(np.int64).min + 1:  # Both names are the same frame, so there are no edges.
            return 0, 0
        return int(ends[0]), int(ends[1])


def _check_out_options(limit: int | None, on_gap: OnGap, *, covariance: bool) -> None:
    """Raise ValueError for an option that the array of a caller has no place for."""
    if limit is not None and on_gap == "omit":
        raise ValueError('on_gap="omit" cannot be combined with out, which has one row for each stamp')
    if covariance:
        raise ValueError("covariance=True cannot be combined with out, which has no place for covariances")


def _freeze(rows: Array, times: NDArray[np.int64], extrapolated: NDArray[np.int64] | None) -> None:
    """Make the arrays of a result and all views of their rows read-only."""
    rows.flags.writeable = False
    times.flags.writeable = False
    if extrapolated is not None:
        extrapolated.flags.writeable = False


def _is_row_array(out: Array, count: int) -> bool:
    """Return whether poses can be written to `out` directly, or False for matrices."""
    if out.dtype == np.float64 and out.shape in {(count, 7), (count, 4, 4)}:
        return out.ndim == 2 and out.flags.c_contiguous and out.flags.writeable
    raise ValueError(
        f"out must be float64 of shape ({count}, 7) or ({count}, 4, 4), not {out.dtype} of shape {out.shape}"
    )
