# SPDX-License-Identifier: Apache-2.0
"""Transform: a rigid motion between two named frames at one time, or a batch of them."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from coframe import _core, quaternion
from coframe._output import html_tables
from coframe.errors import FrameMismatchException, InvalidArgumentException
from coframe.time import stamp_ns
from coframe.transform._covariance import transform_covariance

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from numpy.typing import DTypeLike

    from coframe.time import StampLike
    from coframe.viewer import Viewer

__all__ = ["Transform"]

Array = NDArray[np.float64]

# Maximum deviation of a matrix from a rotation; allows matrices that were stored as float32 or printed with five
# digits.
_MATRIX_TOLERANCE = 1e-5
# Between these lengths, the squared norm of a quaternion fits into a float64 with full precision.
_SHORT, _LONG = 1e-140, 1e140
_IDENTITY = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0)


class Transform(_core.Transform):
    """A rigid motion, an element of SE(3), that transforms coordinates from ``source`` to ``target``.

    ``point_target = transform @ point_source``. A frame of None matches any frame. A batch has additional
    leading axes: ``translation`` (..., 3), ``quaternion`` (..., 4). Transforms are immutable: their arrays are
    read-only, also those of batches. ``np.asarray(transform)`` is a new array of shape (..., 7): x, y, z, qx, qy, qz,
    qw, as ``transform.values``.

    Args:
        translation: Position of the origin of ``source`` in ``target``, in meters, shape (..., 3).
        quaternion: Rotation as x, y, z, w, shape (..., 4); it is normalized.
        target: The frame of the transformed coordinates.
        source: The frame of the coordinates to transform.
        stamp: Nanoseconds, or anything that :func:`coframe.time.stamp_ns` accepts; for a batch also an int64 array of
            its shape.

    Raises:
        InvalidArgumentException: A value is not finite, or a quaternion is zero.
        ValueError: ``translation`` or ``quaternion`` has another shape.

    Example:
        >>> import coframe
        >>> import numpy as np
        >>> lidar = coframe.Transform.from_rpy([0.1, 0, 0.3], [0, 0, np.pi / 2], target="base", source="lidar")
        >>> (lidar @ [1.0, 0.0, 0.0]).round(3).tolist()
        [0.1, 1.0, 0.3]
    """

    __slots__ = ()
    # `array @ transform` is not defined. Without this, NumPy would treat the transform as an array of objects.
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
        t = _vectors(translation, 3, "translation")
        q = _normalized(_vectors(quaternion, 4, "quaternion"))
        if t.ndim == 1 and q.ndim == 1:
            nanoseconds = None if stamp is None else stamp_ns(stamp)
            (x, y, z), (qx, qy, qz, qw) = t.tolist(), q.tolist()
            super().__init__(x, y, z, qx, qy, qz, qw, target, source, nanoseconds, None)
            return
        shape = np.broadcast_shapes(t.shape[:-1], q.shape[:-1])
        stamps = _stamps(stamp, shape)
        # A batch keeps a copy, because the caller may modify the array later.
        batch = (np.broadcast_to(t.copy(), (*shape, 3)), np.broadcast_to(q, (*shape, 4)), stamps, None)
        super().__init__(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, target, source, None, batch)

    @classmethod
    def from_rpy(
        cls,
        translation: ArrayLike = (0.0, 0.0, 0.0),
        rpy: ArrayLike | None = None,
        *,
        roll: ArrayLike | None = None,
        pitch: ArrayLike | None = None,
        yaw: ArrayLike | None = None,
        target: str | None = None,
        source: str | None = None,
        stamp: StampLike | None = None,
    ) -> Transform:
        """Create a transform from roll, pitch and yaw: rotations about the fixed axes x, then y, then z (REP 103).

        Args:
            translation: Position in meters, shape (..., 3).
            rpy: Roll, pitch, yaw in radians, shape (..., 3); alternatively, pass the angles by name.
            roll: Rotation about x in radians, shape (...); 0 if not given.
            pitch: Rotation about y in radians, shape (...); 0 if not given.
            yaw: Rotation about z in radians, shape (...); 0 if not given.
            target: The target frame.
            source: The source frame.
            stamp: Time, as in :class:`Transform`.

        Raises:
            InvalidArgumentException: A value is not finite.
            TypeError: ``rpy`` was given together with an angle by name.
            ValueError: ``translation`` or ``rpy`` has another shape.

        Example:
            >>> import coframe
            >>> coframe.Transform.from_rpy([1.0, 2.0, 0.0], yaw=0.5)
            Transform(translation=[1, 2, 0], rpy=[0, 0, 0.5])
        """
        named = (roll, pitch, yaw)
        if rpy is None:
            angles = [np.asarray(0.0 if angle is None else angle, dtype=np.float64) for angle in named]
            rpy = np.stack(np.broadcast_arrays(*angles), axis=-1)
        elif any(angle is not None for angle in named):
            raise TypeError("from_rpy() takes either rpy or the angles roll, pitch and yaw by name, not both")
        q = quaternion.from_rpy(_vectors(rpy, 3, "rpy"))
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
        """Create a transform from homogeneous matrices.

        Args:
            matrix: Shape (..., 4, 4), with translations in meters.
            target: The target frame.
            source: The source frame.
            stamp: Time, as in :class:`Transform`.

        Raises:
            InvalidArgumentException: A translation is not finite.
            ValueError: The shape is different, the last row is not 0 0 0 1, or the upper left 3x3 is not a rotation.
        """
        m = np.asarray(matrix, dtype=np.float64)
        if m.shape[-2:] != (4, 4):
            raise ValueError(f"matrix must have shape (..., 4, 4), not {m.shape}")
        rotation = m[..., :3, :3]
        error = np.abs(rotation @ np.swapaxes(rotation, -1, -2) - np.eye(3)).max(initial=0.0)
        if not error <= _MATRIX_TOLERANCE:
            raise ValueError(
                "the upper left 3x3 of the matrix is not a rotation: R R^T differs from the identity by up to "
                f"{error:.2g}"
            )
        if (np.linalg.det(rotation) < 0).any():
            raise ValueError(
                "the upper left 3x3 of the matrix is a reflection, not a rotation: its determinant is -1. Is one axis "
                "negated, or are two axes exchanged, as between left-handed and right-handed coordinates?"
            )
        if not (m[..., 3, :] == (0.0, 0.0, 0.0, 1.0)).all():
            raise ValueError("the last row of the matrix must be 0 0 0 1")
        q = quaternion.from_matrix(rotation)
        return cls(m[..., :3, 3], q, target=target, source=source, stamp=stamp)

    @classmethod
    def from_scipy(
        cls,
        rotation: Any,
        translation: ArrayLike = (0.0, 0.0, 0.0),
        *,
        target: str | None = None,
        source: str | None = None,
        stamp: StampLike | None = None,
    ) -> Transform:
        """Create a transform from a SciPy rotation.

        Args:
            rotation: A ``scipy.spatial.transform.Rotation``, single or with batch axes.
            translation: Position in meters, shape (..., 3).
            target: The target frame.
            source: The source frame.
            stamp: Time, as in :class:`Transform`.

        Raises:
            InvalidArgumentException: A value is not finite.
            TypeError: ``rotation`` is not a SciPy rotation.
            ValueError: ``translation`` has another shape.
        """
        if not hasattr(rotation, "as_quat"):
            raise TypeError(f"rotation must be a scipy.spatial.transform.Rotation, not {type(rotation).__name__}")
        return cls(translation, rotation.as_quat(), target=target, source=source, stamp=stamp)

    def as_scipy(self) -> tuple[Any, Array]:
        """Return the rotation as a SciPy object, and the translation.

        Returns:
            A ``scipy.spatial.transform.Rotation`` and the translation in meters, shape (..., 3): the arguments of
            :meth:`from_scipy`.

        Raises:
            ModuleNotFoundError: SciPy is not installed.
        """
        try:
            from scipy.spatial.transform import Rotation  # noqa: PLC0415 - coframe itself does not need SciPy
        except ModuleNotFoundError as error:
            text = "as_scipy() needs SciPy, which is not installed. Install it with: pip install scipy"
            raise ModuleNotFoundError(text, name=error.name) from None
        return Rotation.from_quat(self.quaternion), self.translation.copy()

    @property
    def translation(self) -> Array:
        """Position of the source frame in the target frame, in meters; shape (3,), for a batch (..., 3)."""
        return _frozen(self.values[:3]) if self._batch is None else self._batch[0]

    @property
    def quaternion(self) -> Array:
        """Unit quaternion x, y, z, w of the rotation; shape (4,), for a batch (..., 4)."""
        return _frozen(self.values[3:]) if self._batch is None else self._batch[1]

    @property
    def stamps(self) -> NDArray[np.int64] | None:
        """Stamps of a batch in nanoseconds, int64 of shape ``self.shape``; None without stamps or batch axes."""
        return None if self._batch is None else self._batch[2]

    @property
    def extrapolated(self) -> int | NDArray[np.int64]:
        """The time by which the lookup extrapolated, in nanoseconds; for a batch, an array of shape ``self.shape``."""
        if self._batch is None:
            return self._beyond
        if self._batch[3] is None:
            return np.zeros(self.shape, dtype=np.int64)
        beyond: NDArray[np.int64] = self._batch[3]
        return beyond

    @property
    def rotation(self) -> Array:
        """Rotation matrix; shape (3, 3), for a batch (..., 3, 3)."""
        return quaternion.to_matrix(self.quaternion)

    @property
    def matrix(self) -> Array:
        """Homogeneous matrix; shape (4, 4), for a batch (..., 4, 4)."""
        m = np.zeros((*self.shape, 4, 4))
        m[..., :3, :3] = self.rotation
        m[..., :3, 3] = self.translation
        m[..., 3, 3] = 1.0
        return m

    @property
    def rpy(self) -> Array:
        """Roll, pitch and yaw about the fixed axes x, y, z, in radians; shape (3,), for a batch (..., 3)."""
        return quaternion.to_rpy(self.quaternion)

    @property
    def x(self) -> Any:
        """Position along x in meters, as a float; for a batch an array of shape ``self.shape``."""
        return self._component(self.translation, 0)

    @property
    def y(self) -> Any:
        """Position along y in meters, as a float; for a batch an array of shape ``self.shape``."""
        return self._component(self.translation, 1)

    @property
    def z(self) -> Any:
        """Position along z in meters, as a float; for a batch an array of shape ``self.shape``."""
        return self._component(self.translation, 2)

    @property
    def roll(self) -> Any:
        """Rotation about the fixed axis x in radians, as a float; for a batch an array of shape ``self.shape``."""
        return self._component(self.rpy, 0)

    @property
    def pitch(self) -> Any:
        """Rotation about the fixed axis y in radians, as a float; for a batch an array of shape ``self.shape``."""
        return self._component(self.rpy, 1)

    @property
    def yaw(self) -> Any:
        """Rotation about the fixed axis z in radians, as a float; for a batch an array of shape ``self.shape``."""
        return self._component(self.rpy, 2)

    def __array__(self, dtype: DTypeLike | None = None, copy: bool | None = None) -> NDArray[Any]:
        """Return the poses as a new array of shape (..., 7): x, y, z in meters and qx, qy, qz, qw.

        Raises:
            ValueError: ``copy`` is False, but a transform is not stored as one array.
        """
        if copy is False:
            raise ValueError("a Transform is not stored as one array, so it cannot be used as one without a copy")
        return np.concatenate([self.translation, self.quaternion], axis=-1).astype(dtype or np.float64, copy=False)

    def _component(self, values: Array, axis: int) -> Any:
        return values[..., axis] if self.shape else float(values[axis])

    @property
    def shape(self) -> tuple[int, ...]:
        """Shape of the batch axes; () for a single transform."""
        return () if self._batch is None else self._batch[0].shape[:-1]

    def inverse(self) -> Transform:
        """Return the inverse transform, with target and source exchanged."""
        q = quaternion.inverse(self.quaternion)
        return _derived(-quaternion.rotate(q, self.translation), q, self.source, self.target, self._any_stamp())

    @overload
    def __matmul__(self, other: Transform) -> Transform: ...
    @overload
    def __matmul__(self, other: ArrayLike) -> Array: ...

    def __matmul__(self, other: Transform | ArrayLike) -> Transform | Array:
        """Compose two transforms, ``a<-b @ b<-c`` is ``a<-c``, or transform points from ``source`` to ``target``.

        Batch axes are broadcast against each other and against all axes of the points but the last.

        Args:
            other: A transform, or points of shape (..., 3) in meters.

        Returns:
            A transform, or the points in ``target``.

        Raises:
            FrameMismatchException: The inner frames are named and differ.
            ValueError: The points have another shape.
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
                hint="The inner frames must be the same. Does one of the transforms need inverse()?",
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

    def transform_point(self, point: Any) -> Array:
        """Transform points from ``source`` to ``target``, like ``self @ point``.

        Args:
            point: Points in meters, shape (..., 3), or an object with the attributes x, y and z, such as a
                geometry_msgs/Point.

        Returns:
            The points expressed in ``target``, in meters, shape (..., 3).

        Raises:
            TypeError: ``point`` is a transform.
            ValueError: The points have another shape.

        Example:
            >>> import coframe
            >>> coframe.Transform([1.0, 0.0, 0.0]).transform_point([0.0, 2.0, 0.0]).tolist()
            [1.0, 2.0, 0.0]
        """
        if isinstance(point, _core.Transform):
            raise TypeError("transform_point() takes points, not a Transform. Use `a @ b` to compose two transforms.")
        if all(hasattr(point, axis) for axis in "xyz"):
            point = (point.x, point.y, point.z)
        return self @ np.asarray(point, dtype=np.float64)

    def transform_pose(
        self, pose: Transform, covariance: ArrayLike, *, own_covariance: ArrayLike | None = None
    ) -> tuple[Transform, Array]:
        """Transform a pose and its covariance from ``source`` to ``target``.

        Args:
            pose: Pose expressed in ``source``, as a transform from the frame of the posed object.
            covariance: Covariance of the pose as in ROS's PoseWithCovariance, shape (..., 6, 6) or (..., 36): x, y, z
                in meters and rotations about the fixed axes x, y, z in radians, expressed in ``source``.
            own_covariance: Covariance of this transform itself, expressed in ``target``; None if it is exactly known,
                as in tf2.

        Returns:
            ``self @ pose``, and its covariance expressed in ``target``, to first order, in the shape of ``covariance``.

        Raises:
            FrameMismatchException: The pose is not expressed in ``source``.
            ValueError: A covariance has another shape.
        """
        moved = transform_covariance(self.rotation, pose.translation, covariance, own_covariance)
        return self @ pose, moved

    def _any_stamp(self) -> Any:
        return self.stamp if self._batch is None else self.stamps

    def is_close(self, other: Transform, *, translation: float = 1e-9, rotation: float = 1e-9) -> bool:
        """Return whether two transforms are equal within tolerances; frames and stamps are not compared.

        Args:
            other: The other transform, with batch axes that broadcast.
            translation: Maximum distance in meters.
            rotation: Largest angle in radians.
        """
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
            raise TypeError("a single transform has no length; only a batch has")
        return self.shape[0]

    def __getitem__(self, index: Any) -> Transform:
        """Return a transform or a part of a batch, using NumPy indexing."""
        if not self.shape:
            raise TypeError("a single transform cannot be indexed; only a batch can")
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

    def show(self, **options: Any) -> Viewer:
        """Show the frames in the viewer, or below the cell in a notebook; the same as :func:`coframe.show`.

        Args:
            options: The options of :func:`coframe.show`, such as ``fixed="map"``.
        """
        from coframe.viewer.show import show as show_in_browser  # noqa: PLC0415 - the viewer is above this module

        return show_in_browser(self, **options)

    def _repr_html_(self) -> str:
        total = int(np.prod(self.shape))
        first = min(total, html_tables.MAX_ROWS)
        lengths, angles = self.translation.reshape(-1, 3)[:first], self.rpy.reshape(-1, 3)[:first]
        stamps = self.stamps if self.shape else None if self.stamp is None else np.array([self.stamp])
        times = [""] * first if stamps is None else stamps.reshape(-1)[:first].tolist()
        rows = [
            (stamp, *(f"{value:.6g}" for value in (*xyz, *rpy)))
            for stamp, xyz, rpy in zip(times, lengths.tolist(), angles.tolist(), strict=True)
        ]
        title = f"Transform {_arrow(self)}" + (f", batch {self.shape}" if self.shape else "")
        columns = ("stamp [ns]", "x [m]", "y [m]", "z [m]", "roll [rad]", "pitch [rad]", "yaw [rad]")
        return html_tables.section(title, html_tables.table(columns, rows, total, "transform"))

    def __reduce__(self) -> tuple[object, ...]:
        if self._batch is not None:
            return _rebuild_batch, (*self._batch[:2], self.target, self.source, *self._batch[2:])
        return _rebuild, (self.values, self.target, self.source, self.stamp, None, self._beyond)


def batch_of(
    translation: Array,
    quaternion: Array,
    target: str | None,
    source: str | None,
    stamps: NDArray[np.int64] | None,
    beyond: NDArray[np.int64] | None = None,
) -> Transform:
    """Return a batch on the given arrays (..., 3) and (..., 4) without copying; rows of NaN mean "no transform".

    The arrays must be read-only, because transforms are immutable.
    """
    return _rebuild(_IDENTITY, target, source, None, (translation, quaternion, stamps, beyond))


def _rebuild_batch(
    translation: Array,
    quaternion: Array,
    target: str | None,
    source: str | None,
    stamps: NDArray[np.int64] | None,
    beyond: NDArray[np.int64] | None,
) -> Transform:
    """Return a batch from a copy of its arrays, which is writable if it comes from pickle or copy.deepcopy."""
    for array in (translation, quaternion, stamps, beyond):
        if array is not None:
            array.setflags(write=False)
    return batch_of(translation, quaternion, target, source, stamps, beyond)


def _derived(translation: Array, quaternion: Array, target: str | None, source: str | None, stamp: Any) -> Transform:
    """Return a transform from values computed from other transforms, which need neither checks nor normalisation."""
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
    """Return a transform with exactly these values; unlike the constructor, this does not normalize again."""
    transform = Transform.__new__(Transform)
    _core.Transform.__init__(transform, *values, target, source, stamp, batch, beyond)
    return transform


def _single_pose(
    translation: ArrayLike, quaternion: ArrayLike
) -> tuple[float, float, float, float, float, float, float] | None:
    """Return the values of a single pose of floats without NumPy, which would take ten times as long for seven numbers.

    Returns:
        x, y, z, qx, qy, qz, qw; None for batches, other types of numbers and invalid values.
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


def _vectors(values: ArrayLike, size: int, name: str) -> Array:
    array = np.asarray(values, dtype=np.float64)
    if array.ndim == 0 or array.shape[-1] != size:
        raise ValueError(f"{name} must have shape (..., {size}), not {array.shape}")
    if not np.isfinite(array).all():
        raise InvalidArgumentException.with_details(
            f"{name} must be finite, but contains NaN or inf", hint="Check where the values come from."
        )
    return array


def _frozen(values: tuple[float, ...]) -> Array:
    """Return a read-only array, because writing to this copy would not change the transform."""
    array = np.array(values)
    array.setflags(write=False)
    return array


def _points(values: ArrayLike) -> Array:
    points = np.asarray(values, dtype=np.float64)
    if points.ndim == 0 or points.shape[-1] != 3:
        raise ValueError(f"points must have shape (..., 3), not {points.shape}")
    return points


def _normalized(q: Array) -> Array:
    with np.errstate(over="ignore"):
        length = np.sqrt((q * q).sum(axis=-1, keepdims=True))
    if not ((length > _SHORT) & (length < _LONG)).all():  # The squares overflow or underflow.
        largest = np.abs(q).max(axis=-1, keepdims=True, initial=0.0)
        if not (largest > 0.0).all():
            raise InvalidArgumentException.with_details(
                "quaternion must not be zero", hint="Is w unset? The identity rotation has w = 1."
            )
        q = q / largest
        length = np.sqrt((q * q).sum(axis=-1, keepdims=True))
    unit: Array = q / length
    return unit


def stamps_of(stamps: Any) -> NDArray[np.int64]:
    """Return stamps as an int64 array of nanoseconds.

    Args:
        stamps: An array of integers in nanoseconds, or of datetime64.

    Raises:
        TypeError: The array has another type, such as floats of seconds.
        ValueError: A stamp is NaT.
    """
    array = np.asarray(stamps)
    if array.dtype.kind == "M":
        if np.isnat(array).any():
            raise ValueError("stamps must not contain NaT")
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
