# SPDX-License-Identifier: Apache-2.0
"""Transform: a rigid motion between two named frames at one time, or a batch of them."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from coframe import _core, quaternion
from coframe._output import html_tables
from coframe.errors import InvalidArgumentException
from coframe.time import stamp_ns
from coframe.transform import _covariance, _messages
from coframe.transform._algebra import TransformAlgebra
from coframe.transform.values import IDENTITY, any_stamp, arrow, batch_of, broadcast_stamps, derived

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from coframe.time import StampLike
    from coframe.viewer import Viewer

__all__ = ["Transform"]

Array = NDArray[np.float64]

# Maximum deviation of a matrix from a rotation; allows matrices that were stored as float32 or printed with five
# digits.
_MATRIX_TOLERANCE = 1e-5
# Between these lengths, the squared norm of a quaternion fits into a float64 with full precision.
_SHORT, _LONG = 1e-140, 1e140
# Marks arguments that replace() was not given.
_KEEP: Any = object()


class Transform(TransformAlgebra):
    """A rigid motion, an element of SE(3), that transforms coordinates from ``source`` to ``target``.

    ``point_target = transform @ point_source``. A frame of None matches any frame. A batch has additional
    leading axes: ``translation`` (..., 3), ``quaternion`` (..., 4). Transforms are immutable: their arrays are
    read-only, also those of batches. ``np.asarray(transform)`` is a new array of shape (..., 7): x, y, z, qx, qy, qz,
    qw, as ``transform.values``.

    ``Transform(message)`` reads any ROS message that contains a pose, whichever program made its class: Pose,
    TransformStamped, Odometry, Path, Marker, ... Its ``frame_id`` becomes ``target``, its ``child_frame_id``
    ``source``; a list of poses becomes a batch, and a covariance that is not all zero that of the transform.

    Args:
        translation: Position of the origin of ``source`` in ``target``, in meters, shape (..., 3); or a message.
        quaternion: Rotation as x, y, z, w, shape (..., 4); it is normalized.
        target: The frame of the transformed coordinates.
        source: The frame of the coordinates to transform.
        stamp: Nanoseconds, or anything that :func:`coframe.time.stamp_ns` accepts; for a batch also an int64 array of
            its shape.
        covariance: Covariance as in ROS's PoseWithCovariance, shape (6, 6) or (36,), for a batch also (..., 6, 6) or
            (..., 36): see :attr:`covariance`. None means that the pose is exact, or that of the message.

    Raises:
        InvalidArgumentException: A value is not finite, or a quaternion is zero.
        ValueError: An argument has another shape, or the message contains no pose or several.

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
        translation: Any = (0.0, 0.0, 0.0),
        quaternion: ArrayLike = (0.0, 0.0, 0.0, 1.0),
        *,
        target: str | None = None,
        source: str | None = None,
        stamp: StampLike | NDArray[np.int64] | None = None,
        covariance: ArrayLike | None = None,
    ) -> None:
        if covariance is None and (values := _single_pose(translation, quaternion)) is not None:
            nanoseconds = None if stamp is None else stamp_ns(stamp)
            super().__init__(*values, target, source, nanoseconds, None)
            return
        if _messages.is_message(translation):
            self._init_from_message(translation, target, source, stamp, covariance)
            return
        t = _vectors(translation, 3, "translation")
        q = _normalized(_vectors(quaternion, 4, "quaternion"))
        shape = np.broadcast_shapes(t.shape[:-1], q.shape[:-1])
        uncertainty = None
        if covariance is not None:
            matrices = _covariance.checked(covariance, shape)
            matrices.setflags(write=False)
            uncertainty = (matrices, ())
        if not shape:
            nanoseconds = None if stamp is None else stamp_ns(stamp)
            (x, y, z), (qx, qy, qz, qw) = t.tolist(), q.tolist()
            super().__init__(x, y, z, qx, qy, qz, qw, target, source, nanoseconds, None, 0, uncertainty)
            return
        stamps = broadcast_stamps(stamp, shape)
        # A batch keeps a copy, because the caller may modify the array later.
        batch = (np.broadcast_to(t.copy(), (*shape, 3)), np.broadcast_to(q, (*shape, 4)), stamps, None)
        super().__init__(*IDENTITY, target, source, None, batch, 0, uncertainty)

    def _init_from_message(
        self, message: Any, target: str | None, source: str | None, stamp: Any, covariance: ArrayLike | None
    ) -> None:
        found = _messages.contents(message)
        values = np.array([pose.values() for pose in found.poses]).reshape(-1, 7)
        values = values if found.is_list else values[0]
        if stamp is None:
            stamps = [pose.stamp for pose in found.poses]
            known = stamps if found.is_list else stamps[0]
            stamp = None if not stamps or None in stamps else known
        Transform.__init__(
            self,
            values[..., :3],
            values[..., 3:],
            target=found.frame if target is None else target,
            source=found.child if source is None else source,
            stamp=stamp,
            covariance=found.covariance if covariance is None else covariance,
        )

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
    def from_rotvec(
        cls,
        translation: ArrayLike = (0.0, 0.0, 0.0),
        rotvec: ArrayLike = (0.0, 0.0, 0.0),
        *,
        degrees: bool = False,
        target: str | None = None,
        source: str | None = None,
        stamp: StampLike | None = None,
    ) -> Transform:
        """Create a transform from a rotation vector: the axis times the angle.

        Args:
            translation: Position in meters, shape (..., 3).
            rotvec: Rotation vector, shape (..., 3).
            degrees: Whether the angle is in degrees instead of radians.
            target: The target frame.
            source: The source frame.
            stamp: Time, as in :class:`Transform`.

        Raises:
            InvalidArgumentException: A value is not finite.
            ValueError: An argument has another shape.
        """
        vector = _vectors(rotvec, 3, "rotvec")
        q = quaternion.from_rotvec(np.radians(vector) if degrees else vector)
        return cls(translation, q, target=target, source=source, stamp=stamp)

    @classmethod
    def from_axis_angle(
        cls,
        translation: ArrayLike,
        axis: ArrayLike,
        angle: ArrayLike,
        *,
        degrees: bool = False,
        target: str | None = None,
        source: str | None = None,
        stamp: StampLike | None = None,
    ) -> Transform:
        """Create a transform from an axis and an angle.

        Args:
            translation: Position in meters, shape (..., 3).
            axis: Axis of the rotation, of any length but zero, shape (..., 3).
            angle: Angle of the rotation, shape (...).
            degrees: Whether the angle is in degrees instead of radians.
            target: The target frame.
            source: The source frame.
            stamp: Time, as in :class:`Transform`.

        Raises:
            InvalidArgumentException: A value is not finite, or an axis is zero.
            ValueError: An argument has another shape.
        """
        vector = _vectors(axis, 3, "axis")
        length = np.linalg.norm(vector, axis=-1, keepdims=True)
        if not (length > 0.0).all():
            raise InvalidArgumentException.with_details("axis must not be zero", hint="Without rotation, give angle 0.")
        half = 0.5 * np.asarray(angle, dtype=np.float64)[..., None]
        half = np.radians(half) if degrees else half
        unit, half = np.broadcast_arrays(vector / length, half)
        q = np.concatenate([np.sin(half) * unit, np.cos(half[..., :1])], axis=-1)
        return cls(translation, q, target=target, source=source, stamp=stamp)

    @classmethod
    def from_euler(
        cls,
        translation: ArrayLike,
        seq: str,
        angles: ArrayLike,
        *,
        degrees: bool = False,
        target: str | None = None,
        source: str | None = None,
        stamp: StampLike | None = None,
    ) -> Transform:
        """Create a transform from Euler angles in any order, as SciPy's ``Rotation.from_euler`` does.

        Args:
            translation: Position in meters, shape (..., 3).
            seq: One to three axes: capital letters rotate about the axes of the moved frame ("ZYX" is yaw, pitch,
                roll), small letters about fixed axes ("xyz" is roll, pitch, yaw).
            angles: An angle for each axis, shape (..., n); for one axis also a number.
            degrees: Whether the angles are in degrees instead of radians.
            target: The target frame.
            source: The source frame.
            stamp: Time, as in :class:`Transform`.

        Raises:
            InvalidArgumentException: A value is not finite.
            ValueError: ``seq`` is unknown, or an argument has another shape.

        Example:
            >>> import coframe
            >>> coframe.Transform.from_euler([0, 0, 1.5], "ZYX", [90, 0, 10], degrees=True).rpy.round(3).tolist()
            [0.175, 0.0, 1.571]
        """
        given = np.asarray(angles, dtype=np.float64)
        given = given[None] if given.ndim == 0 else given
        given = _vectors(given, len(seq), "angles")
        q = quaternion.from_euler(seq, np.radians(given) if degrees else given)
        return cls(translation, q, target=target, source=source, stamp=stamp)

    @classmethod
    def from_dual_quaternion(
        cls,
        dual_quaternion: ArrayLike,
        *,
        target: str | None = None,
        source: str | None = None,
        stamp: StampLike | None = None,
    ) -> Transform:
        """Create a transform from dual quaternions, as :meth:`as_dual_quaternion` returns them.

        Args:
            dual_quaternion: Shape (..., 8): real part x, y, z, w, then dual part x, y, z, w; it is normalized.
            target: The target frame.
            source: The source frame.
            stamp: Time, as in :class:`Transform`.

        Raises:
            InvalidArgumentException: A value is not finite, or the real part is zero.
            ValueError: ``dual_quaternion`` has another shape.
        """
        given = _vectors(dual_quaternion, 8, "dual_quaternion")
        real = _normalized(given[..., :4])
        dual = given[..., 4:] / np.linalg.norm(given[..., :4], axis=-1, keepdims=True)
        t = 2.0 * quaternion.multiply(dual, quaternion.inverse(real))[..., :3]
        return cls(t, real, target=target, source=source, stamp=stamp)

    @classmethod
    def from_matrix(
        cls,
        matrix: ArrayLike,
        *,
        target: str | None = None,
        source: str | None = None,
        stamp: StampLike | None = None,
    ) -> Transform:
        """Create a transform from homogeneous matrices, or from rotation matrices.

        Args:
            matrix: Shape (..., 4, 4), with translations in meters; or (..., 3, 3), without translation.
            target: The target frame.
            source: The source frame.
            stamp: Time, as in :class:`Transform`.

        Raises:
            InvalidArgumentException: A translation is not finite.
            ValueError: The shape is different, the last row is not 0 0 0 1, or the upper left 3x3 is not a rotation.
        """
        m = np.asarray(matrix, dtype=np.float64)
        if m.shape[-2:] not in {(3, 3), (4, 4)}:
            raise ValueError(f"matrix must have shape (..., 4, 4) or (..., 3, 3), not {m.shape}")
        q = quaternion.from_matrix(_checked_rotation(m[..., :3, :3]))
        if m.shape[-1] == 3:
            return cls((0.0, 0.0, 0.0), q, target=target, source=source, stamp=stamp)
        if not (m[..., 3, :] == (0.0, 0.0, 0.0, 1.0)).all():
            raise ValueError("the last row of the matrix must be 0 0 0 1")
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
        """Create a transform from a SciPy rotation, or from a SciPy rigid transform.

        Args:
            rotation: A ``scipy.spatial.transform.Rotation``, or a ``RigidTransform``, which contains the translation;
                single or with batch axes.
            translation: Position in meters, shape (..., 3).
            target: The target frame.
            source: The source frame.
            stamp: Time, as in :class:`Transform`.

        Raises:
            InvalidArgumentException: A value is not finite.
            TypeError: ``rotation`` is neither of them.
            ValueError: ``translation`` has another shape.
        """
        if hasattr(rotation, "as_dual_quat"):
            rotation, translation = rotation.rotation, rotation.translation
        if not hasattr(rotation, "as_quat"):
            raise TypeError(
                f"rotation must be a scipy.spatial.transform.Rotation or RigidTransform, not {type(rotation).__name__}"
            )
        return cls(translation, rotation.as_quat(), target=target, source=source, stamp=stamp)

    @classmethod
    def from_pinocchio(
        cls,
        pose: Any,
        *,
        target: str | None = None,
        source: str | None = None,
        stamp: StampLike | None = None,
    ) -> Transform:
        """Create a transform from a ``pinocchio.SE3``, or a batch from a sequence of them.

        Args:
            pose: The pose or poses.
            target: The target frame.
            source: The source frame.
            stamp: Time, as in :class:`Transform`.

        Raises:
            TypeError: ``pose`` is something else.
        """
        single = hasattr(pose, "rotation") and hasattr(pose, "translation")
        poses = [pose] if single else list(pose) if hasattr(pose, "__iter__") else [pose]
        if not all(hasattr(each, "rotation") and hasattr(each, "translation") for each in poses):
            raise TypeError(f"pose must be a pinocchio.SE3 or a sequence of them, not {type(pose).__name__}")
        t = np.array([each.translation for each in poses], dtype=np.float64).reshape(-1, 3)
        q = quaternion.from_matrix(np.array([each.rotation for each in poses], dtype=np.float64).reshape(-1, 3, 3))
        return cls(t[0] if single else t, q[0] if single else q, target=target, source=source, stamp=stamp)

    def to_msg(self, message_type: Any, frame: str | None = None, stamp: StampLike | None = None) -> Any:
        """Return the pose as a ROS message.

        Args:
            message_type: A class of coframe or of a sourced ROS that contains a pose, such as
                ``geometry_msgs.msg.PoseStamped``; for a batch of shape (N,) one with a list of them, such as PoseArray
                or Path.
            frame: The ``frame_id`` of the header; by default :attr:`target`. The ``child_frame_id`` is
                :attr:`source`.
            stamp: The stamp of the header; by default that of the transform.

        Raises:
            TypeError: ``message_type`` is not a class.
            ValueError: Its messages contain no pose, or several, or only one for a batch.

        Example:
            >>> import coframe
            >>> from coframe.messages import find
            >>> goal = coframe.Transform([1.0, 2.0, 0.0]).to_msg(find("geometry_msgs/msg/PoseStamped"), "map", 5)
            >>> goal.header.frame_id, goal.pose.position.y
            ('map', 2.0)
        """
        time = self.stamp if stamp is None else stamp_ns(stamp)
        return _messages.filled(message_type, self, self.target if frame is None else frame, time)

    @overload
    def __matmul__(self, other: Transform) -> Transform: ...
    @overload
    def __matmul__(self, other: NDArray[np.float32]) -> NDArray[np.float32]: ...
    @overload
    def __matmul__(self, other: ArrayLike) -> Array: ...
    @overload
    def __matmul__(self, other: Any) -> Any: ...

    def __matmul__(self, other: Any) -> Any:
        """Compose two transforms, ``a<-b @ b<-c`` is ``a<-c``, or transform points or a message to ``target``.

        Batch axes are broadcast against each other and against all axes of the points but the last. A covariance of
        either transform becomes that of the result; both are independent.

        Args:
            other: A transform; points of shape (..., 3) in meters; or a ROS message that contains a pose.

        Returns:
            A transform; the points in ``target``, as float32 if they were; or a copy of the message in ``target``.

        Raises:
            FrameMismatchException: The inner frames are named and differ.
            ValueError: The points have another shape, or the message contains no pose.
        """
        if isinstance(other, Transform):
            return self._compose(other)
        if _messages.is_message(other):
            return _messages.moved(self, other, Transform)
        points = _points(other)
        if self.shape:
            turned = quaternion.rotate(self.quaternion, points.astype(np.float64, copy=False)) + self.translation
            return turned.astype(points.dtype, copy=False)
        moved = np.array(points, order="C")
        x, y, z = moved.reshape(-1, 3).T
        _core.transform_fields(self.values, [(x, y, z)], 1)
        return moved

    def transform_point(self, point: Any) -> NDArray[Any]:
        """Transform points from ``source`` to ``target``, like ``self @ point``.

        Args:
            point: Points in meters, shape (..., 3), or an object with the attributes x, y and z, such as a
                geometry_msgs/Point.

        Returns:
            The points expressed in ``target``, in meters, shape (..., 3), as float32 if they were.

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
        moved: NDArray[Any] = self @ _points(point)
        return moved

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
            ``self @ pose``, and its covariance expressed in ``target``, in the shape of ``covariance``. A transform
            that has its covariance as :attr:`covariance` needs only ``self @ pose``.

        Raises:
            FrameMismatchException: The pose is not expressed in ``source``.
            ValueError: A covariance has another shape.
        """
        given = np.asarray(covariance, dtype=np.float64)
        theirs = _covariance.square(given, "covariance")
        own = None if own_covariance is None else _covariance.square(own_covariance, "own_covariance")
        moved = _covariance.compounded(own, theirs, self.rotation, pose.translation)
        return self @ pose, moved.reshape(*moved.shape[:-2], 36) if given.shape[-2:] != (6, 6) else moved

    def is_close(self, other: Transform, *, translation: float = 1e-9, rotation: float = 1e-9) -> bool:
        """Return whether two transforms are equal within tolerances; frames and stamps are not compared.

        Args:
            other: The other transform, with batch axes that broadcast.
            translation: Maximum distance in meters.
            rotation: Largest angle in radians.
        """
        anywhere = other.replace(target=self.target, source=self.source)
        apart, angle = self.distance(anywhere)
        return bool(np.all(apart <= translation) and np.all(angle <= rotation))

    def replace(
        self,
        *,
        translation: ArrayLike = _KEEP,
        quaternion: ArrayLike = _KEEP,
        target: str | None = _KEEP,
        source: str | None = _KEEP,
        stamp: StampLike | NDArray[np.int64] | None = _KEEP,
        covariance: ArrayLike | None = _KEEP,
    ) -> Transform:
        """Return a copy with other values, which :class:`Transform` describes.

        Args:
            translation: The new position.
            quaternion: The new rotation.
            target: The new target frame; the numbers do not change.
            source: The new source frame; the numbers do not change.
            stamp: The new stamp or stamps; None removes them.
            covariance: The new covariance; None removes it.

        Raises:
            InvalidArgumentException: A value is not finite, or a quaternion is zero.
            ValueError: An argument has another shape.

        Example:
            >>> import coframe
            >>> coframe.Transform([1.0, 2.0, 0.0]).replace(target="map", stamp=5)
            Transform(map <- ?, translation=[1, 2, 0], rpy=[0, 0, 0], stamp=5)
        """
        t, q, when, matrices = self.translation, self.quaternion, any_stamp(self), self.covariance
        if translation is not _KEEP or quaternion is not _KEEP:
            moved = Transform(t if translation is _KEEP else translation, q if quaternion is _KEEP else quaternion)
            t, q = moved.translation, moved.quaternion
        shape = np.broadcast_shapes(t.shape[:-1], q.shape[:-1])
        if stamp is not _KEEP:
            when = stamp_ns(stamp) if stamp is not None and not shape else stamp
        if covariance is not _KEEP:
            matrices = None if covariance is None else _covariance.checked(covariance, shape)
        new_target = self.target if target is _KEEP else target
        new_source = self.source if source is _KEEP else source
        exact = self.exact_edges if covariance is _KEEP else ()
        return derived(t, q, new_target, new_source, when, matrices, exact)

    __replace__ = replace  # copy.replace() of Python 3.13

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Transform):
            return NotImplemented
        return (
            (self.target, self.source) == (other.target, other.source)
            and np.array_equal(any_stamp(self), any_stamp(other))
            and np.array_equal(self.translation, other.translation)
            and np.array_equal(self.quaternion, other.quaternion)
            and (self.covariance is None) == (other.covariance is None)
            and (self.covariance is None or np.array_equal(self.covariance, other.covariance))  # type: ignore[arg-type]
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
        covariance = None if self.covariance is None else self.covariance.reshape(-1, 6, 6)[picked]
        return derived(flat_t[picked], flat_q[picked], self.target, self.source, stamp, covariance, self.exact_edges)

    def __iter__(self) -> Iterator[Transform]:
        return (self[i] for i in range(len(self)))

    def __repr__(self) -> str:
        return self._text(".6g")

    def __format__(self, spec: str) -> str:
        """Return the text of the transform with a format for its numbers: ``f"{transform:.2f}"``."""
        return self._text(spec or ".6g")

    def _text(self, spec: str) -> str:
        frames = f"{arrow(self)}, " if self.target is not None or self.source is not None else ""
        if self.shape:
            return f"Transform({frames}batch {self.shape})"
        stamp = "" if self.stamp is None else f", stamp={self.stamp}"
        numbers = f"translation={_numbers(self.translation, spec)}, rpy={_numbers(self.rpy, spec)}"
        return f"Transform({frames}{numbers}{stamp})"

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
        title = f"Transform {arrow(self)}" + (f", batch {self.shape}" if self.shape else "")
        columns = ("stamp [ns]", "x [m]", "y [m]", "z [m]", "roll [rad]", "pitch [rad]", "yaw [rad]")
        return html_tables.section(title, html_tables.table(columns, rows, total, "transform"))

    def __reduce__(self) -> tuple[object, ...]:
        if self._batch is not None:
            return _rebuild_batch, (*self._batch[:2], self.target, self.source, *self._batch[2:], self._uncertainty)
        return _rebuild, (self.values, self.target, self.source, self.stamp, None, self._beyond, self._uncertainty)


def _rebuild_batch(
    translation: Array,
    quaternion: Array,
    target: str | None,
    source: str | None,
    stamps: NDArray[np.int64] | None,
    beyond: NDArray[np.int64] | None,
    uncertainty: tuple[Array, tuple[str, ...]] | None = None,
) -> Transform:
    """Return a batch from a copy of its arrays, which is writable if it comes from pickle or copy.deepcopy."""
    for array in (translation, quaternion, stamps, beyond, None if uncertainty is None else uncertainty[0]):
        if array is not None:
            array.setflags(write=False)
    return batch_of(translation, quaternion, target, source, stamps, beyond, uncertainty)


def _rebuild(
    values: tuple[float, float, float, float, float, float, float],
    target: str | None,
    source: str | None,
    stamp: int | None,
    batch: Any,
    beyond: int = 0,
    uncertainty: tuple[Array, tuple[str, ...]] | None = None,
) -> Transform:
    """Return a transform with exactly these values; unlike the constructor, this does not normalize again."""
    if uncertainty is not None:
        uncertainty[0].setflags(write=False)
    return _core.new_transform(*values, target, source, stamp, batch, beyond, uncertainty)


def _checked_rotation(rotation: Array) -> Array:
    """Return rotation matrices (..., 3, 3).

    Raises:
        ValueError: A matrix is not a rotation.
    """
    error = np.abs(rotation @ np.swapaxes(rotation, -1, -2) - np.eye(3)).max(initial=0.0)
    if not error <= _MATRIX_TOLERANCE:
        raise ValueError(
            f"the upper left 3x3 of the matrix is not a rotation: R R^T differs from the identity by up to {error:.2g}"
        )
    if (np.linalg.det(rotation) < 0).any():
        raise ValueError(
            "the upper left 3x3 of the matrix is a reflection, not a rotation: its determinant is -1. Is one axis "
            "negated, or are two axes exchanged, as between left-handed and right-handed coordinates?"
        )
    return rotation


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


def _points(values: ArrayLike) -> NDArray[Any]:
    points = np.asarray(values)
    if points.dtype != np.float32:
        points = points.astype(np.float64, copy=False)
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


def _numbers(values: Array, spec: str) -> str:
    return "[" + ", ".join(format(value, spec) for value in values.tolist()) + "]"


_core.register_transform_class(Transform)
