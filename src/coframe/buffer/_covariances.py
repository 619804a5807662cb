# SPDX-License-Identifier: Apache-2.0
"""Covariances of the edges of a buffer, and their composition along a chain.

They are stored beside the samples, because few edges have any. The covariance of an edge is interpolated between the
two stamps around a time, along the axes of the child, and held before the first and after the last one.
"""

from __future__ import annotations

import bisect
import itertools
import struct
import threading
from typing import TYPE_CHECKING, Any

import coframe.lazy_numpy as np
from coframe import _core
from coframe.buffer._storing import check_frames
from coframe.errors import InvalidArgumentException
from coframe.transform.transform import Transform
from coframe.transform.values import derive_transform, stamps_of, with_body_covariance

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from numpy.typing import ArrayLike, NDArray

    from coframe.time import StampLike

    Array = NDArray[np.float64]

# Covariances of an edge that a buffer with a limited cache keeps; as many samples as the core keeps would need 400 MB.
MAX_COVARIANCES = 1 << 17
_EDGE = struct.Struct("<II")
_COVARIANCE_BYTES = 8 + 36 * 8  # of a stamp and a matrix


class EdgeCovariances:
    """The covariances of one edge, along the axes of the child frame.

    Args:
        cache_ns: For how many nanoseconds they are kept; negative keeps everything.
    """

    def __init__(self, cache_ns: int) -> None:
        self._cache_ns = cache_ns
        self._lock = threading.Lock()
        self._stamps: list[int] = []
        self._matrices: list[Array] = []

    def add(self, stamps: list[int], matrices: Array) -> None:
        """Store covariances, shape (N, 6, 6), with their stamps. A stamp that is known is replaced."""
        with self._lock:
            for stamp, matrix in zip(stamps, matrices, strict=True):
                place = bisect.bisect_left(self._stamps, stamp)
                if place < len(self._stamps) and self._stamps[place] == stamp:
                    self._matrices[place] = matrix
                else:
                    self._stamps.insert(place, stamp)
                    self._matrices.insert(place, matrix)
            self._prune()

    def set_static(self, matrix: Array) -> None:
        """Store one covariance for all time, instead of all others."""
        with self._lock:
            self._stamps, self._matrices = [0], [matrix]

    def at(self, times: NDArray[np.int64]) -> Array:
        """Return the covariances at some times, shape (N, 6, 6)."""
        with self._lock:
            # Only those around the times: a lookup at one time must not copy all of them.
            first = max(bisect.bisect_left(self._stamps, int(times.min())) - 1, 0)
            end = bisect.bisect_right(self._stamps, int(times.max())) + 1
            stamps, matrices = np.array(self._stamps[first:end], dtype=np.int64), self._matrices[first:end]
        after = np.searchsorted(stamps, times)
        last = np.minimum(after, len(stamps) - 1)
        before = np.maximum(last - (stamps[last] > times), 0)
        used, places = np.unique(np.concatenate([before, last]), return_inverse=True)
        known = np.array([matrices[i] for i in used])
        older, newer = known[places[: len(times)]], known[places[len(times) :]]
        length = stamps[last] - stamps[before]
        share = np.where(length > 0, np.clip(times - stamps[before], 0, length) / np.maximum(length, 1), 0.0)
        result: Array = older + share[:, None, None] * (newer - older)
        return result

    def arrays(self) -> tuple[NDArray[np.int64], Array]:
        """Return the stamps, (N,) nanoseconds, and the matrices, (N, 6, 6)."""
        with self._lock:
            return np.array(self._stamps, dtype=np.int64), np.array(self._matrices, dtype=np.float64).reshape(-1, 6, 6)

    def copy(self) -> EdgeCovariances:
        """Return an independent copy."""
        copied = EdgeCovariances(self._cache_ns)
        with self._lock:
            copied._stamps, copied._matrices = list(self._stamps), list(self._matrices)
        return copied

    def _prune(self) -> None:
        """Remove covariances older than the cache, except the last of them: it is needed for interpolation."""
        if self._cache_ns < 0:
            return
        old = bisect.bisect_left(self._stamps, self._stamps[-1] - self._cache_ns) - 1
        old = max(old, len(self._stamps) - MAX_COVARIANCES)
        if old > 0:
            del self._stamps[:old], self._matrices[:old]


def covariances_of(buffer: _core.Buffer) -> dict[str, EdgeCovariances]:
    """Return the covariances by child frame."""
    known: dict[str, EdgeCovariances] = buffer.__dict__.setdefault("_Coframe__covariances", {})
    return known


def store_covariances(
    buffer: _core.Buffer, child: str, pose: Transform, stamps: ArrayLike | StampLike | None, *, static: bool
) -> None:
    """Store the covariances of a transform or a batch that has some."""
    matrices = pose.as_covariance("body").reshape(-1, 6, 6)
    edge = covariances_of(buffer).setdefault(child, EdgeCovariances(buffer.cache_ns))
    if static:
        edge.set_static(matrices[-1])
    else:
        edge.add(np.atleast_1d(stamps_of(stamps)).tolist(), matrices)


def set_covariance(buffer: _core.Buffer, parent: str, child: str, pose: Any, *, static: bool) -> None:
    """Store the covariances of a message or transform without its poses. See :meth:`coframe.Buffer.set_covariance`."""
    given = pose if isinstance(pose, Transform) else Transform(pose)
    check_frames(parent, child, given)
    if given.covariance is None:
        raise InvalidArgumentException.with_details(
            f"the pose of {child!r} in {parent!r} has no covariance: it is None, or all of its numbers are zero",
            target=parent,
            source=child,
            hint="Edges without a covariance count as exact, so nothing needs to be stored.",
        )
    stamps = given.stamps if given.shape else given.stamp
    if stamps is None and not static:
        raise InvalidArgumentException.with_details(
            f"the covariance of {parent!r} -> {child!r} has no stamp",
            target=parent,
            source=child,
            hint="Pass a pose with a stamp, or static=True if the covariance never changes.",
        )
    store_covariances(buffer, child, given, stamps, static=static)


def pack(buffer: _core.Buffer) -> bytes:
    """Return the covariances of a buffer as bytes for a file; empty if there are none.

    For each edge: the length of the child's name and the number of covariances (uint32), the name in UTF-8, the stamps
    (int64) and the matrices (36 float64 each), all little endian.
    """
    parts = []
    for child, edge in covariances_of(buffer).items():
        stamps, matrices = edge.arrays()
        name = child.encode()
        parts += [_EDGE.pack(len(name), len(stamps)), name, stamps.astype("<i8").tobytes()]
        parts.append(matrices.astype("<f8").tobytes())
    return b"".join(parts)


def unpack(buffer: _core.Buffer, data: bytes) -> None:
    """Store the covariances that :func:`pack` returned.

    Raises:
        ValueError: The bytes are damaged.
    """
    place = 0
    while place < len(data):
        if len(data) - place < _EDGE.size:
            raise ValueError("the covariances are truncated")
        length, number = _EDGE.unpack_from(data, place)
        name, stamps = place + _EDGE.size, place + _EDGE.size + length
        matrices, place = stamps + 8 * number, stamps + _COVARIANCE_BYTES * number
        if not number or place > len(data):
            raise ValueError("the covariances are truncated")
        times = np.frombuffer(data, "<i8", number, stamps).tolist()
        values = np.frombuffer(data, "<f8", 36 * number, matrices).reshape(-1, 6, 6)
        if not np.isfinite(values).all():
            raise ValueError("a covariance is not finite")
        edge = covariances_of(buffer).setdefault(data[name:stamps].decode(), EdgeCovariances(buffer.cache_ns))
        edge.add(times, values)


def with_covariance(buffer: _core.Buffer, pose: Transform, edge_pose: Callable[[str, str], Transform]) -> Transform:
    """Return the result of a lookup with the covariance along its chain.

    Args:
        buffer: The buffer that stores the covariances of its edges.
        pose: The result, a single transform or a batch.
        edge_pose: Returns the pose of a frame (second) relative to its neighbor (first) at the same times.
    """
    times = pose.stamps if pose.stamps is not None else np.array([pose.stamp or 0], dtype=np.int64)
    known = covariances_of(buffer)
    present = np.isfinite(np.atleast_2d(pose.translation)).all(axis=-1)
    total, exact = Transform(covariance=np.zeros((6, 6))), []
    for upper, lower, child in _edges(buffer, pose, times[present]):
        step = edge_pose(upper, lower)
        if child in known:
            matrices = known[child].at(times)
            matrices = matrices if pose.shape else matrices[0]
            own = step if child == lower else step.inverse()  # the pose of the child in its parent
            own = with_body_covariance(_fill_missing_rows(own), matrices)
            step = own if child == lower else own.inverse()
        else:
            exact.append(child)
        total = total @ step.replace(target=None, source=None, stamp=None)
    matrices = np.broadcast_to(total.covariance, (*pose.shape, 6, 6))  # type: ignore[arg-type]  # it has one
    missing = np.isnan(pose.translation[..., :1, None])
    matrices = np.where(missing, np.nan, matrices)
    return _core.new_transform(
        *(pose.values if not pose.shape else (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0)),
        pose.target,
        pose.source,
        pose.stamp,
        pose._batch,
        pose._extrapolated,
        (_read_only(matrices), tuple(exact)),
    )


def _edges(buffer: _core.Buffer, pose: Transform, times: NDArray[np.int64]) -> Iterator[tuple[str, str, str]]:
    """Yield each edge from the target to the source as the nearer frame, the farther frame, and the child of the two.

    The chain is that of the first time.
    """
    target, source = pose.target or "", pose.source or ""
    if target == source or not times.size:
        return
    time = int(times[0])
    frames = buffer.chain(target, time, source, time, target)
    for lower, upper in reversed(list(itertools.pairwise(frames))):
        state = buffer._edge_at(lower, time)
        yield upper, lower, lower if state is not None and state[1] == upper else upper


def _fill_missing_rows(pose: Transform) -> Transform:
    """Return poses whose missing rows are the identity. The caller marks them in its result."""
    missing = ~np.isfinite(pose.translation).all(axis=-1)
    if not np.any(missing):
        return pose
    t, q = pose.translation.copy(), pose.quaternion.copy()
    t[missing], q[missing] = 0.0, (0.0, 0.0, 0.0, 1.0)
    return derive_transform(_read_only(t), _read_only(q), None, None, None)


def _read_only(array: Array) -> Array:
    array.setflags(write=False)
    return array
