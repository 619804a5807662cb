"""Transform: a rigid motion between two named frames at one time, or a batch of them."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from coframe import _core, quaternion
from coframe.covariance import transform_covariance
from coframe.errors import FrameMismatchException, InvalidArgumentException
from coframe.time import stamp_ns

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from coframe.time import StampLike

__all__ = ["Transform"]

Array = NDArray[np.float64]

# How far from a rotation a matrix may be: what float32 and five printed digits leave over.
_MATRIX_TOLERANCE = 1e-5
# Quaternions between these lengths have squares that a float64 holds to full precision.
_SHORT, _LONG = 1e-140, 1e140
_IDENTITY = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0)


class Transform(_core.Transform):
    """An element of SE(3) that takes coordinates in ``source`` to coordinates in ``target``.

    ``point_target = transform @ point_source``. Frames may be None, which fits every frame. A batch has further
    axes in front: ``translation`` (..., 3), ``quaternion`` (..., 4). Instances do not change.

    Args:
        translation: Metres, shape (..., 3): where the origin of ``source`` is, seen from ``target``.
        quaternion: x, y, z, w, shape (..., 4); normalised here.
        target: The frame that coordinates come out in.
        source: The frame that coordinates go in from.
        stamp: Nanoseconds, or anything that :func:`coframe.time.stamp_ns` takes; of a batch also an int64 array.

    Raises:
        InvalidArgumentException: A value is not finite, or a quaternion is zero.
        ValueError: A shape does not end in 3 or 4.

    Example:
        >>> import coframe
        >>> lidar = coframe.Transform.from_rpy([0.1, 0, 0.3], [0, 0, np.pi / 2], target="base", source="lidar")
        >>> (lidar @ [1.0, 0.0, 0.0]).round(3).tolist()
        [0.1, 1.0, 0.3]
    """

    __slots__ = ()
    # `array @ transform` is no product: numpy must not take the transform for an array of objects.
    __array_ufunc__ = None

    def __init__(
        self,
        translation: ArrayLike = (0.0, 0.0, 0.0),
        quaternion: ArrayLike = (0.0, 0.0, 0.0, 1.0),
        *,
        target: str | None = None,
        source: str | None = None,
        stamp: StampLike | NDArray[np.int64] | None = None,
    ) -> None:
        if (values := _single_pose(translation, quaternion)) is not None:
            nanoseconds = None if stamp is None else stamp_ns(stamp)
            super().__init__(*values, target, source, nanoseconds, None)
            return
        t = _vectors(translation, 3, "a translation")
        q = _normalised(_vectors(quaternion, 4, "a quaternion"))
        if t.ndim == 1 and q.ndim == 1:
            nanoseconds = None if stamp is None else stamp_ns(stamp)
            (x, y, z), (qx, qy, qz, qw) = t.tolist(), q.tolist()
            super().__init__(x, y, z, qx, qy, qz, qw, target, source, nanoseconds, None)
            return
        shape = np.broadcast_shapes(t.shape[:-1], q.shape[:-1])
        stamps = _stamps(stamp, shape)
        # A copy: the caller's array may change, a transform does not.
        batch = (np.broadcast_to(t.copy(), (*shape, 3)), np.broadcast_to(q, (*shape, 4)), stamps, None)
        super().__init__(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, target, source, None, batch)

    @classmethod
    def from_rpy(
        cls,
        translation: ArrayLike = (0.0, 0.0, 0.0),
        rpy: ArrayLike = (0.0, 0.0, 0.0),
        *,
        target: str | None = None,
        source: str | None = None,
        stamp: StampLike | None = None,
    ) -> Transform:
        """From roll, pitch, yaw in radians, shape (..., 3): turns about the fixed axes x, then y, then z (REP 103)."""
        q = quaternion.from_rpy(_vectors(rpy, 3, "roll, pitch, yaw"))
        return cls(translation, q, target=target, source=source, stamp=stamp)

    @classmethod
    def from_matrix(
        cls,
        matrix: ArrayLike,
        *,
        target: str | None = None,
        source: str | None = None,
        stamp: StampLike | None = None,
    ) -> Transform:
        """From homogeneous matrices, shape (..., 4, 4).

        Raises:
            ValueError: The shape is another, the last row is not 0 0 0 1, or the upper left is no rotation.
        """
        m = np.asarray(matrix, dtype=np.float64)
        if m.shape[-2:] != (4, 4):
            raise ValueError(f"a matrix must have the shape (..., 4, 4), not {m.shape}")
        rotation = m[..., :3, :3]
        error = np.abs(rotation @ np.swapaxes(rotation, -1, -2) - np.eye(3)).max(initial=0.0)
        if not error <= _MATRIX_TOLERANCE or (np.linalg.det(rotation) < 0).any():
            raise ValueError(f"the upper left 3x3 is not a rotation (R R^T differs from 1 by up to {error:.2g})")
        if not (m[..., 3, :] == (0.0, 0.0, 0.0, 1.0)).all():
            raise ValueError("the last row of a rigid motion's matrix is 0 0 0 1")
        q = quaternion.from_matrix(rotation)
        return cls(m[..., :3, 3], q, target=target, source=source, stamp=stamp)

    @property
    def translation(self) -> Array:
        """Metres, shape (3,), of a batch (..., 3)."""
        return _frozen(self.values[:3]) if self._batch is None else self._batch[0]

    @property
    def quaternion(self) -> Array:
        """x, y, z, w, of unit length, shape (4,), of a batch (..., 4)."""
        return _frozen(self.values[3:]) if self._batch is None else self._batch[1]

    @property
    def stamps(self) -> NDArray[np.int64] | None:
        """Nanoseconds of each pose of a batch, shape ``self.shape``; None where it has none, or no batch axes."""
        return None if self._batch is None else self._batch[2]

    @property
    def extrapolated(self) -> int | NDArray[np.int64]:
        """How many nanoseconds beyond the data of a link the look-up went; 0: not at all. Of a batch ``self.shape``."""
        if self._batch is None:
            return self._beyond
        if self._batch[3] is None:
            return np.zeros(self.shape, dtype=np.int64)
        return np.asarray(self._batch[3])

    @property
    def rotation(self) -> Array:
        """Rotation matrices, shape (3, 3), of a batch (..., 3, 3)."""
        return quaternion.to_matrix(self.quaternion)

    @property
    def matrix(self) -> Array:
        """Homogeneous matrices, shape (4, 4), of a batch (..., 4, 4)."""
        m = np.zeros((*self.shape, 4, 4))
        m[..., :3, :3] = self.rotation
        m[..., :3, 3] = self.translation
        m[..., 3, 3] = 1.0
        return m

    @property
    def rpy(self) -> Array:
        """Roll, pitch, yaw in radians, shape (3,), of a batch (..., 3); fixed axes x, y, z."""
        return quaternion.to_rpy(self.quaternion)

    @property
    def shape(self) -> tuple[int, ...]:
        """The batch axes; () for a single transform."""
        return () if self._batch is None else self._batch[0].shape[:-1]

    def inverse(self) -> Transform:
        """The same relation from the other end: target and source change places."""
        q = quaternion.inverse(self.quaternion)
        return _derived(-quaternion.rotate(q, self.translation), q, self.source, self.target, self._any_stamp())

    @overload
    def __matmul__(self, other: Transform) -> Transform: ...
    @overload
    def __matmul__(self, other: ArrayLike) -> Array: ...

    def __matmul__(self, other: Transform | ArrayLike) -> Transform | Array:
        """``a<-b @ b<-c`` is ``a<-c``; with points (..., 3) in ``source``: the points in ``target``.

        Batch axes are broadcast against each other and against the axes of the points before the last.

        Raises:
            FrameMismatchException: The inner frames are named and differ.
        """
        if isinstance(other, Transform):
            return self._compose(other)
        points = _points(other)
        if self.shape:
            return quaternion.rotate(self.quaternion, points) + self.translation
        moved = np.array(points, order="C")
        x, y, z = moved.reshape(-1, 3).T
        _core.transform_fields(self.values, [(x, y, z)], 1)
        return moved

    def _compose(self, other: Transform) -> Transform:
        if self.source is not None and other.target is not None and self.source != other.target:
            raise FrameMismatchException.with_details(
                f"cannot compose {_arrow(self)} with {_arrow(other)}: {self.source!r} is not {other.target!r}",
                target=self.target,
                source=other.source,
                hint="The inner frames must be the same; is one of the two the wrong way round (inverse())?",
            )
        mine, others = self._any_stamp(), other._any_stamp()
        q = quaternion.multiply(self.quaternion, other.quaternion)
        return _derived(
            quaternion.rotate(self.quaternion, other.translation) + self.translation,
            q / np.linalg.norm(q, axis=-1, keepdims=True),
            self.target,
            other.source,
            _common_stamp(mine, others),
        )

    def transform_pose(
        self, pose: Transform, covariance: ArrayLike, *, own_covariance: ArrayLike | None = None
    ) -> tuple[Transform, Array]:
        """A pose in ``source`` and how sure it is, as both are in ``target``.

        Args:
            pose: In ``source``; a pose is the transform from the thing's own frame.
            covariance: Of the pose, as in ROS's PoseWithCovariance: (..., 6, 6) or (..., 36), over x, y, z (m) and
                turns about the fixed axes x, y, z (rad) of ``source``.
            own_covariance: How sure this transform itself is, over the axes of ``target``; None: exactly known, as in
                tf2.

        Returns:
            ``self @ pose``, and its covariance over the axes of ``target``, in the shape that was given. First order.

        Raises:
            FrameMismatchException: The pose is not in ``source``.
            ValueError: A covariance of another shape.
        """
        return self @ pose, transform_covariance(self, pose, covariance, own_covariance)

    def _any_stamp(self) -> Any:
        return self.stamp if self._batch is None else self.stamps

    def is_close(self, other: Transform, *, translation: float = 1e-9, rotation: float = 1e-9) -> bool:
        """Whether both are the same motion to within metres and radians; frames and stamps are not compared."""
        apart = np.linalg.norm(self.translation - other.translation, axis=-1)
        turn = quaternion.multiply(quaternion.inverse(self.quaternion), other.quaternion)
        angle = 2.0 * np.arctan2(np.linalg.norm(turn[..., :3], axis=-1), np.abs(turn[..., 3]))
        return bool((apart <= translation).all() and (angle <= rotation).all())

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Transform):
            return NotImplemented
        return (
            (self.target, self.source) == (other.target, other.source)
            and np.array_equal(self._any_stamp(), other._any_stamp())
            and np.array_equal(self.translation, other.translation)
            and np.array_equal(self.quaternion, other.quaternion)
        )

    __hash__ = None  # type: ignore[assignment]

    def __bool__(self) -> bool:
        return not self.shape or self.shape[0] > 0

    def __len__(self) -> int:
        if not self.shape:
            raise TypeError("a single transform has no length")
        return self.shape[0]

    def __getitem__(self, index: Any) -> Transform:
        """One pose, or a part, of a batch."""
        if not self.shape:
            raise TypeError("a single transform cannot be indexed")
        picked = np.arange(int(np.prod(self.shape))).reshape(self.shape)[index]
        flat_t, flat_q = self.translation.reshape(-1, 3), self.quaternion.reshape(-1, 4)
        stamp = None if self.stamps is None else self.stamps.reshape(-1)[picked]
        return _derived(flat_t[picked], flat_q[picked], self.target, self.source, stamp)

    def __iter__(self) -> Iterator[Transform]:
        return (self[i] for i in range(len(self)))

    def __repr__(self) -> str:
        frames = f"{_arrow(self)}, " if self.target is not None or self.source is not None else ""
        if self.shape:
            return f"Transform({frames}batch {self.shape})"
        stamp = "" if self.stamp is None else f", stamp={self.stamp}"
        return f"Transform({frames}translation={_numbers(self.translation)}, rpy={_numbers(self.rpy)}{stamp})"

    def __reduce__(self) -> tuple[object, ...]:
        return _rebuild, (self.values, self.target, self.source, self.stamp, self._batch, self._beyond)


def batch_of(
    translation: Array,
    quaternion: Array,
    target: str | None,
    source: str | None,
    stamps: NDArray[np.int64] | None,
    beyond: NDArray[np.int64] | None = None,
) -> Transform:
    """A batch around arrays (..., 3) and (..., 4) that nobody else writes to; rows of NaN stand for no answer."""
    return _rebuild(_IDENTITY, target, source, None, (translation, quaternion, stamps, beyond))


def _derived(translation: Array, quaternion: Array, target: str | None, source: str | None, stamp: Any) -> Transform:
    """From values that come from transforms: unit quaternions, and NaN only where a row of a batch had none."""
    shape = np.broadcast_shapes(translation.shape[:-1], quaternion.shape[:-1])
    if shape:
        t, q = np.broadcast_to(translation, (*shape, 3)), np.broadcast_to(quaternion, (*shape, 4))
        return batch_of(t, q, target, source, _stamps(stamp, shape))
    x, y, z = translation.tolist()
    qx, qy, qz, qw = quaternion.tolist()
    return _rebuild((x, y, z, qx, qy, qz, qw), target, source, None if stamp is None else int(stamp), None)


def _rebuild(
    values: tuple[float, float, float, float, float, float, float],
    target: str | None,
    source: str | None,
    stamp: int | None,
    batch: Any,
    beyond: int = 0,
) -> Transform:
    """Bit for bit what it was: unlike the constructor, this does not normalise again."""
    transform = Transform.__new__(Transform)
    _core.Transform.__init__(transform, *values, target, source, stamp, batch, beyond)
    return transform


def _single_pose(
    translation: ArrayLike, quaternion: ArrayLike
) -> tuple[float, float, float, float, float, float, float] | None:
    """The numbers of what is plainly one pose, without numpy, which takes ten times as long for seven of them.

    None for all else: batches, other kinds of numbers, and what is wrong.
    """
    t, q = _few_numbers(translation, 3), _few_numbers(quaternion, 4)
    if t is None or q is None or not all(type(number) is float for number in (*t, *q)):
        return None
    (x, y, z), (qx, qy, qz, qw) = t, q
    length = math.sqrt(qx * qx + qy * qy + qz * qz + qw * qw)
    if not (_SHORT < length < _LONG and math.isfinite(x) and math.isfinite(y) and math.isfinite(z)):
        return None
    return x, y, z, qx / length, qy / length, qz / length, qw / length


def _few_numbers(values: Any, count: int) -> Sequence[Any] | None:
    if isinstance(values, np.ndarray):
        return values.tolist() if values.shape == (count,) else None
    return values if isinstance(values, tuple | list) and len(values) == count else None


def _vectors(values: ArrayLike, size: int, what: str) -> Array:
    array = np.asarray(values, dtype=np.float64)
    if array.ndim == 0 or array.shape[-1] != size:
        raise ValueError(f"{what} must have the shape (..., {size}), not {array.shape}")
    if not np.isfinite(array).all():
        raise InvalidArgumentException.with_details(
            f"{what} must be finite", hint="Look for NaN or inf where the numbers come from."
        )
    return array


def _frozen(values: tuple[float, ...]) -> Array:
    """An array that refuses to be written to: a transform would not change with it."""
    array = np.array(values)
    array.setflags(write=False)
    return array


def _points(values: ArrayLike) -> Array:
    points = np.asarray(values, dtype=np.float64)
    if points.ndim == 0 or points.shape[-1] != 3:
        raise ValueError(f"points must have the shape (..., 3), not {points.shape}")
    return points


def _normalised(q: Array) -> Array:
    with np.errstate(over="ignore"):
        length = np.sqrt((q * q).sum(axis=-1, keepdims=True))
    if not ((length > _SHORT) & (length < _LONG)).all():  # squares that left the range of float64
        largest = np.abs(q).max(axis=-1, keepdims=True, initial=0.0)
        if not (largest > 0.0).all():
            raise InvalidArgumentException.with_details(
                "a quaternion of length zero is no rotation", hint="Is w unset? It is 1 at rest."
            )
        q = q / largest
        length = np.sqrt((q * q).sum(axis=-1, keepdims=True))
    unit: Array = q / length
    return unit


def stamps_of(stamps: Any) -> NDArray[np.int64]:
    """Nanoseconds from an array of int64 or datetime64.

    Raises:
        TypeError: It is something else; floats of seconds above all.
        ValueError: One of them is NaT.
    """
    array = np.asarray(stamps)
    if array.dtype.kind == "M":
        if np.isnat(array).any():
            raise ValueError("NaT is not a point in time")
        array = array.astype("datetime64[ns]").astype(np.int64)
    if array.dtype.kind not in "iu" and array.size:
        raise TypeError(f"stamps must be int64 nanoseconds or datetime64, not {array.dtype}")
    return array.astype(np.int64)


def _stamps(stamp: Any, shape: tuple[int, ...]) -> NDArray[np.int64] | None:
    return None if stamp is None else np.broadcast_to(stamps_of(stamp), shape)


def _common_stamp(a: Any, b: Any) -> Any:
    if a is None or b is None:
        return b if a is None else a
    return a if np.array_equal(a, b) else None


def _arrow(transform: Transform) -> str:
    return f"{transform.target or '?'} <- {transform.source or '?'}"


def _numbers(values: Array) -> str:
    return "[" + ", ".join(f"{value:.6g}" for value in values.tolist()) + "]"


_core.register_transform_class(Transform)
