# SPDX-License-Identifier: Apache-2.0
"""Transform: a rigid motion between two named frames at one time, or a batch of them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeAlias, overload

import coframe.lazy_numpy as np
from coframe import _core, quaternion
from coframe._output import html_tables
from coframe.time import stamp_ns
from coframe.transform import _covariance, _messages
from coframe.transform._arguments import checked_points, checked_vectors, normalize_quaternions, single_pose
from coframe.transform._constructors import TransformConstructors
from coframe.transform.values import IDENTITY, any_stamp, arrow, batch_of, broadcast_stamps, derive_transform

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import ArrayLike, NDArray

    from coframe.time import StampLike
    from coframe.viewer import Viewer

__all__ = ["Transform"]

Array: TypeAlias = "NDArray[np.float64]"

# Marks arguments that replace() was not given.
_KEEP: Any = object()


class Transform(TransformConstructors):
    """A rigid motion, an element of SE(3), that transforms coordinates from ``source`` to ``target``.

    ``point_target = transform @ point_source``. A frame of None matches any frame. A batch has additional
    leading axes: ``translation`` (..., 3), ``quaternion`` (..., 4). Transforms are immutable: their arrays are
    read-only, including those of batches. ``np.asarray(transform)`` is a new array of shape (..., 7): x, y, z, qx, qy,
    qz, qw, as ``transform.values``.

    ``Transform(message)`` reads any ROS message that contains a pose, regardless of which program made its class: Pose,
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
        if covariance is None and (values := single_pose(translation, quaternion)) is not None:
            nanoseconds = None if stamp is None else stamp_ns(stamp)
            super().__init__(*values, target, source, nanoseconds, None)
            return
        if _messages.is_message(translation):
            self._init_from_message(translation, target, source, stamp, covariance)
            return
        t = checked_vectors(translation, 3, "translation")
        q = normalize_quaternions(checked_vectors(quaternion, 4, "quaternion"))
        shape = np.broadcast_shapes(t.shape[:-1], q.shape[:-1])
        uncertainty = None
        if covariance is not None:
            matrices = _covariance.check_covariances(covariance, shape)
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
        return _messages.fill_message(message_type, self, self.target if frame is None else frame, time)

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
            return _messages.transform_message(self, other, Transform)
        points = checked_points(other)
        if self.shape:
            rotated_points = (
                quaternion.rotate(self.quaternion, points.astype(np.float64, copy=False)) + self.translation
            )
            return rotated_points.astype(points.dtype, copy=False)
        result = np.array(points, order="C")
        x, y, z = result.reshape(-1, 3).T
        _core.transform_fields(self.values, [(x, y, z)], 1)
        return result

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
        result: NDArray[Any] = self @ checked_points(point)
        return result

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
        pose_covariance = _covariance.square(given, "covariance")
        own = None if own_covariance is None else _covariance.square(own_covariance, "own_covariance")
        result = _covariance.compound_covariances(own, pose_covariance, self.rotation, pose.translation)
        return self @ pose, result.reshape(*result.shape[:-2], 36) if given.shape[-2:] != (6, 6) else result

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
            result = Transform(t if translation is _KEEP else translation, q if quaternion is _KEEP else quaternion)
            t, q = result.translation, result.quaternion
        shape = np.broadcast_shapes(t.shape[:-1], q.shape[:-1])
        if stamp is not _KEEP:
            when = stamp_ns(stamp) if stamp is not None and not shape else stamp
        if covariance is not _KEEP:
            matrices = None if covariance is None else _covariance.check_covariances(covariance, shape)
        new_target = self.target if target is _KEEP else target
        new_source = self.source if source is _KEEP else source
        exact = self.exact_edges if covariance is _KEEP else ()
        return derive_transform(t, q, new_target, new_source, when, matrices, exact)

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
        return derive_transform(
            flat_t[picked], flat_q[picked], self.target, self.source, stamp, covariance, self.exact_edges
        )

    def __iter__(self) -> Iterator[Transform]:
        return (self[i] for i in range(len(self)))

    def __repr__(self) -> str:
        return self._text(".6g")

    def __format__(self, spec: str) -> str:
        """Return the transform as a string with a format for its numbers: ``f"{transform:.2f}"``."""
        return self._text(spec or ".6g")

    def _text(self, spec: str) -> str:
        frames = f"{arrow(self)}, " if self.target is not None or self.source is not None else ""
        if self.shape:
            return f"Transform({frames}batch {self.shape})"
        stamp = "" if self.stamp is None else f", stamp={self.stamp}"
        numbers = f"translation={_numbers(self.translation, spec)}, rpy={_numbers(self.rpy, spec)}"
        return f"Transform({frames}{numbers}{stamp})"

    def show(self, **options: Any) -> Viewer:
        """Show the frames in the viewer, or below the cell in a notebook. This is the same as :func:`coframe.show`.

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
        return _rebuild, (
            self.values,
            self.target,
            self.source,
            self.stamp,
            None,
            self._extrapolated,
            self._uncertainty,
        )


def _rebuild_batch(
    translation: Array,
    quaternion: Array,
    target: str | None,
    source: str | None,
    stamps: NDArray[np.int64] | None,
    extrapolated: NDArray[np.int64] | None,
    uncertainty: tuple[Array, tuple[str, ...]] | None = None,
) -> Transform:
    """Return a batch from a copy of its arrays, which is writable if it comes from pickle or copy.deepcopy."""
    for array in (translation, quaternion, stamps, extrapolated, None if uncertainty is None else uncertainty[0]):
        if array is not None:
            array.setflags(write=False)
    return batch_of(translation, quaternion, target, source, stamps, extrapolated, uncertainty)


def _rebuild(
    values: tuple[float, float, float, float, float, float, float],
    target: str | None,
    source: str | None,
    stamp: int | None,
    batch: Any,
    extrapolated: int = 0,
    uncertainty: tuple[Array, tuple[str, ...]] | None = None,
) -> Transform:
    """Return a transform with exactly these values; unlike the constructor, this does not normalize again."""
    if uncertainty is not None:
        uncertainty[0].setflags(write=False)
    return _core.new_transform(*values, target, source, stamp, batch, extrapolated, uncertainty)


def _numbers(values: Array, spec: str) -> str:
    return "[" + ", ".join(format(value, spec) for value in values.tolist()) + "]"


_core.register_transform_class(Transform)
