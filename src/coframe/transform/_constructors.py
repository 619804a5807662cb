# SPDX-License-Identifier: Apache-2.0
"""The part of Transform that creates transforms from other representations of a pose."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import coframe.lazy_numpy as np
from coframe import quaternion
from coframe.errors import InvalidArgumentException
from coframe.transform._algebra import TransformAlgebra
from coframe.transform._arguments import checked_rotation, checked_vectors, normalize_quaternions

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from coframe.time import StampLike
    from coframe.transform.transform import Transform


class TransformConstructors(TransformAlgebra):
    """Constructors from angles, matrices, dual quaternions and the poses of other libraries."""

    __slots__ = ()

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
            roll: Rotation about x in radians, shape (...), or 0 if not given.
            pitch: Rotation about y in radians, shape (...), or 0 if not given.
            yaw: Rotation about z in radians, shape (...), or 0 if not given.
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
        q = quaternion.from_rpy(checked_vectors(rpy, 3, "rpy"))
        return _create(cls, translation, q, target=target, source=source, stamp=stamp)

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
        vector = checked_vectors(rotvec, 3, "rotvec")
        q = quaternion.from_rotvec(np.radians(vector) if degrees else vector)
        return _create(cls, translation, q, target=target, source=source, stamp=stamp)

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
        vector = checked_vectors(axis, 3, "axis")
        length = np.linalg.norm(vector, axis=-1, keepdims=True)
        if not (length > 0.0).all():
            raise InvalidArgumentException.with_details("axis must not be zero", hint="Without rotation, give angle 0.")
        half = 0.5 * np.asarray(angle, dtype=np.float64)[..., None]
        half = np.radians(half) if degrees else half
        unit, half = np.broadcast_arrays(vector / length, half)
        q = np.concatenate([np.sin(half) * unit, np.cos(half[..., :1])], axis=-1)
        return _create(cls, translation, q, target=target, source=source, stamp=stamp)

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
            seq: One to three axes: upper-case letters rotate about the axes of the moved frame ("ZYX" is yaw, pitch,
                roll), lower-case letters about fixed axes ("xyz" is roll, pitch, yaw).
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
        given = checked_vectors(given, len(seq), "angles")
        q = quaternion.from_euler(seq, np.radians(given) if degrees else given)
        return _create(cls, translation, q, target=target, source=source, stamp=stamp)

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
        given = checked_vectors(dual_quaternion, 8, "dual_quaternion")
        real = normalize_quaternions(given[..., :4])
        dual = given[..., 4:] / np.linalg.norm(given[..., :4], axis=-1, keepdims=True)
        t = 2.0 * quaternion.multiply(dual, quaternion.inverse(real))[..., :3]
        return _create(cls, t, real, target=target, source=source, stamp=stamp)

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
        q = quaternion.from_matrix(checked_rotation(m[..., :3, :3]))
        if m.shape[-1] == 3:
            return _create(cls, (0.0, 0.0, 0.0), q, target=target, source=source, stamp=stamp)
        if not (m[..., 3, :] == (0.0, 0.0, 0.0, 1.0)).all():
            raise ValueError("the last row of the matrix must be 0 0 0 1")
        return _create(cls, m[..., :3, 3], q, target=target, source=source, stamp=stamp)

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
        return _create(cls, translation, rotation.as_quat(), target=target, source=source, stamp=stamp)

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
        return _create(cls, t[0] if single else t, q[0] if single else q, target=target, source=source, stamp=stamp)


def _create(cls: Any, translation: ArrayLike, q: ArrayLike, **frames: Any) -> Transform:
    """Return ``cls(translation, q, **frames)``: only the complete class Transform has this constructor."""
    transform: Transform = cls(translation, q, **frames)
    return transform
