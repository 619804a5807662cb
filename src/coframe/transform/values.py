# SPDX-License-Identifier: Apache-2.0
"""The part of Transform that stores poses and returns them in other representations."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import coframe.lazy_numpy as np
from coframe import _core, quaternion
from coframe.errors import FrameMismatchException
from coframe.transform import _covariance

if TYPE_CHECKING:
    from numpy.typing import DTypeLike, NDArray

    from coframe.quaternion import Array
    from coframe.transform.transform import Transform

IDENTITY = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0)
# Rotations by less than this, in radians, have no axis.
_NO_ROTATION = 1e-300


class TransformValues(_core.Transform):
    """Translation, rotation, stamps and covariance of a transform or a batch."""

    __slots__ = ()

    @property
    def translation(self) -> Array:
        """Position of the source frame in the target frame, in meters; shape (3,), for a batch (..., 3)."""
        return _freeze_array(self.values[:3]) if self._batch is None else self._batch[0]

    @property
    def quaternion(self) -> Array:
        """Unit quaternion x, y, z, w of the rotation; shape (4,), for a batch (..., 4)."""
        return _freeze_array(self.values[3:]) if self._batch is None else self._batch[1]

    @property
    def stamps(self) -> NDArray[np.int64] | None:
        """Stamps of a batch in nanoseconds, int64 of shape ``self.shape``, or None without stamps or batch axes."""
        return None if self._batch is None else self._batch[2]

    @property
    def extrapolated(self) -> int | NDArray[np.int64]:
        """The time by which the lookup extrapolated, in nanoseconds; for a batch, an array of shape ``self.shape``."""
        if self._batch is None:
            return self._extrapolated
        if self._batch[3] is None:
            return np.zeros(self.shape, dtype=np.int64)
        extrapolated: NDArray[np.int64] = self._batch[3]
        return extrapolated

    @property
    def covariance(self) -> Array | None:
        """Covariance of the pose, shape (6, 6), for a batch (..., 6, 6), or None if the pose counts as exact.

        The order is that of ROS: x, y, z in meters, then rotations about x, y, z in radians. Its axes are those of
        ``target``, its origin is that of ``source``: the true pose is ``self @ Transform.exp(xi)`` with the error xi
        along the axes of ``source``, and the covariance is that of xi turned to the axes of ``target``.
        """
        return None if self._uncertainty is None else self._uncertainty[0]

    @property
    def exact_edges(self) -> tuple[str, ...]:
        """Child frames of the edges without a covariance, which a lookup with ``covariance=True`` took as exact."""
        return () if self._uncertainty is None else self._uncertainty[1]

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
        """Position along x in meters, as a float; for a batch, an array of shape ``self.shape``."""
        return self._component(self.translation, 0)

    @property
    def y(self) -> Any:
        """Position along y in meters, as a float; for a batch, an array of shape ``self.shape``."""
        return self._component(self.translation, 1)

    @property
    def z(self) -> Any:
        """Position along z in meters, as a float; for a batch, an array of shape ``self.shape``."""
        return self._component(self.translation, 2)

    @property
    def roll(self) -> Any:
        """Rotation about the fixed axis x in radians, as a float; for a batch, an array of shape ``self.shape``."""
        return self._component(self.rpy, 0)

    @property
    def pitch(self) -> Any:
        """Rotation about the fixed axis y in radians, as a float; for a batch, an array of shape ``self.shape``."""
        return self._component(self.rpy, 1)

    @property
    def yaw(self) -> Any:
        """Rotation about the fixed axis z in radians, as a float; for a batch, an array of shape ``self.shape``."""
        return self._component(self.rpy, 2)

    @property
    def shape(self) -> tuple[int, ...]:
        """Shape of the batch axes; () for a single transform."""
        return () if self._batch is None else self._batch[0].shape[:-1]

    def __array__(self, dtype: DTypeLike | None = None, copy: bool | None = None) -> NDArray[Any]:
        """Return the poses as a new array of shape (..., 7): x, y, z in meters and qx, qy, qz, qw.

        Raises:
            ValueError: ``copy`` is False, but a transform is not stored as one array.
        """
        if copy is False:
            raise ValueError("a Transform is not stored as one array, so it cannot be used as one without a copy")
        return np.concatenate([self.translation, self.quaternion], axis=-1).astype(dtype or np.float64, copy=False)

    def as_rotvec(self, *, degrees: bool = False) -> Array:
        """Return the rotation vectors: the axis times the angle, which is at most half a turn.

        Args:
            degrees: Whether the angle is in degrees instead of radians.

        Returns:
            Shape (3,), for a batch (..., 3).
        """
        vector = quaternion.to_rotvec(self.quaternion)
        return np.degrees(vector) if degrees else vector

    def as_axis_angle(self, *, degrees: bool = False) -> tuple[Array, Any]:
        """Return the axis and the angle of the rotation, which is at most half a turn.

        Args:
            degrees: Whether the angle is in degrees instead of radians.

        Returns:
            The axis as a unit vector, shape (..., 3), and the angle, a float or shape (...). Without rotation, the
            axis is x.
        """
        vector = self.as_rotvec()
        angle = np.linalg.norm(vector, axis=-1)
        turns = angle > _NO_ROTATION
        axis = np.where(turns[..., None], vector / np.where(turns, angle, 1.0)[..., None], (1.0, 0.0, 0.0))
        angle = np.degrees(angle) if degrees else angle
        return axis, angle if self.shape else float(angle)

    def as_euler(self, seq: str, *, degrees: bool = False) -> Array:
        """Return Euler angles in any order, as ``scipy.spatial.transform.Rotation.as_euler`` does.

        Args:
            seq: Three axes: upper-case letters rotate about the axes of the moved frame ("ZYX" is yaw, pitch, roll),
                lower-case letters about fixed axes ("xyz" is roll, pitch, yaw).
            degrees: Whether the angles are in degrees instead of radians.

        Returns:
            Shape (3,), for a batch (..., 3). The middle angle is within a quarter turn, or in [0, pi] if the first and
            the last axis are the same. In gimbal lock, the last angle is 0.

        Raises:
            ValueError: ``seq`` is not three such letters, or two that follow each other are the same.

        Example:
            >>> import coframe
            >>> coframe.Transform.from_rpy(yaw=0.5).as_euler("ZYX").tolist()
            [0.5, 0.0, 0.0]
        """
        angles = quaternion.to_euler(self.quaternion, seq)
        return np.degrees(angles) if degrees else angles

    def as_dual_quaternion(self) -> Array:
        """Return unit dual quaternions, shape (..., 8): the rotation as x, y, z, w, then the dual part as x, y, z, w.

        The dual part is half the product of the translation and the rotation, as in SciPy's ``as_dual_quat``.
        """
        real = self.quaternion
        pure = np.concatenate([self.translation, np.zeros((*self.shape, 1))], axis=-1)
        return np.concatenate([real, 0.5 * quaternion.multiply(pure, real)], axis=-1)

    def as_covariance(self, convention: str = "ros") -> Array:
        """Return the covariance in the convention of another program.

        Args:
            convention: ``"ros"``, as :attr:`covariance`; ``"body"``, the same order along the axes of ``source``
                (Pinocchio, Sophus, manif); or ``"gtsam"``, rotation before translation along the axes of ``source``.

        Returns:
            Shape (6, 6), for a batch (..., 6, 6).

        Raises:
            ValueError: The convention is unknown, or the transform has no covariance.
        """
        return _covariance.to_convention(known_covariance(self, "as_covariance()"), self.rotation, convention)

    def as_scipy(self) -> tuple[Any, Array]:
        """Return the rotation as a SciPy object, and the translation.

        Returns:
            A ``scipy.spatial.transform.Rotation`` and the translation in meters, shape (..., 3): the arguments of
            :meth:`from_scipy`.

        Raises:
            ModuleNotFoundError: SciPy is not installed.
        """
        return _scipy("as_scipy").Rotation.from_quat(self.quaternion), self.translation.copy()

    def as_rigid_transform(self) -> Any:
        """Return a ``scipy.spatial.transform.RigidTransform``, which SciPy has since version 1.16.

        Raises:
            ModuleNotFoundError: SciPy is not installed, or is older.
        """
        scipy = _scipy("as_rigid_transform")
        if not hasattr(scipy, "RigidTransform"):
            raise ModuleNotFoundError("as_rigid_transform() needs SciPy 1.16 or newer: pip install -U scipy")
        return scipy.RigidTransform.from_components(self.translation, scipy.Rotation.from_quat(self.quaternion))

    def as_pinocchio(self) -> Any:
        """Return a ``pinocchio.SE3``; for a batch, of shape (N,), a list of them.

        Raises:
            ModuleNotFoundError: Pinocchio is not installed.
            ValueError: The batch has several axes.
        """
        if len(self.shape) > 1:
            raise ValueError(f"as_pinocchio() takes a batch with one axis, not of shape {self.shape}")
        try:
            import pinocchio  # noqa: PLC0415 - coframe itself does not need Pinocchio
        except ModuleNotFoundError as error:
            text = "as_pinocchio() needs Pinocchio, which is not installed. Install it with: pip install pin"
            raise ModuleNotFoundError(text, name=error.name) from None
        rows = [
            pinocchio.SE3(pinocchio.Quaternion(q), t)
            for q, t in zip(self.quaternion.reshape(-1, 4), self.translation.reshape(-1, 3), strict=True)
        ]
        return rows if self.shape else rows[0]

    def _component(self, values: Array, axis: int) -> Any:
        return values[..., axis] if self.shape else float(values[axis])


def batch_of(
    translation: Array,
    quaternion: Array,
    target: str | None,
    source: str | None,
    stamps: NDArray[np.int64] | None,
    extrapolated: NDArray[np.int64] | None = None,
    uncertainty: tuple[Array, tuple[str, ...]] | None = None,
) -> Transform:
    """Return a batch on the given arrays (..., 3) and (..., 4) without copying. Rows of NaN mean "no transform".

    The arrays must be read-only, because transforms are immutable.
    """
    batch = (translation, quaternion, stamps, extrapolated)
    return _core.new_transform(*IDENTITY, target, source, None, batch, 0, uncertainty)


def derive_transform(
    translation: Array,
    quaternion: Array,
    target: str | None,
    source: str | None,
    stamp: Any,
    covariance: Array | None = None,
    exact_edges: tuple[str, ...] = (),
) -> Transform:
    """Return a transform from values computed from other transforms, which need neither checks nor normalisation."""
    shape = np.broadcast_shapes(translation.shape[:-1], quaternion.shape[:-1])
    uncertainty = None
    if covariance is not None:
        covariance = np.broadcast_to(covariance, (*shape, 6, 6))
        covariance.setflags(write=False)
        uncertainty = (covariance, exact_edges)
    if shape:
        t, q = np.broadcast_to(translation, (*shape, 3)), np.broadcast_to(quaternion, (*shape, 4))
        return batch_of(t, q, target, source, broadcast_stamps(stamp, shape), None, uncertainty)
    x, y, z = translation.tolist()
    qx, qy, qz, qw = quaternion.tolist()
    nanoseconds = None if stamp is None else int(stamp)
    return _core.new_transform(x, y, z, qx, qy, qz, qw, target, source, nanoseconds, None, 0, uncertainty)


def with_body_covariance(transform: TransformValues, matrices: Array, exact_edges: tuple[str, ...] = ()) -> Transform:
    """Return a pose with covariances along the axes of its source that need no check."""
    covariance = _covariance.from_body(matrices, transform.rotation)
    t, q, stamp = transform.translation, transform.quaternion, any_stamp(transform)
    return derive_transform(t, q, transform.target, transform.source, stamp, covariance, exact_edges)


def pose_rows(transform: TransformValues, shape: tuple[int, ...]) -> tuple[Array, Array]:
    """Return translations (n, 3) and quaternions (n, 4) as the native core takes them; n is 1 for a single pose."""
    t, q = transform.translation, transform.quaternion
    if transform.shape not in {(), shape}:
        t, q = np.broadcast_to(t, (*shape, 3)), np.broadcast_to(q, (*shape, 4))
    return _make_contiguous(t.reshape(-1, 3)), _make_contiguous(q.reshape(-1, 4))


def any_stamp(transform: TransformValues) -> Any:
    """Return the stamp of a single transform, or the stamps of a batch, or None without."""
    return transform.stamp if transform._batch is None else transform.stamps


def known_covariance(transform: TransformValues, what: str) -> Array:
    """Return the covariance of a transform.

    Raises:
        ValueError: It has none.
    """
    covariance = transform.covariance
    if covariance is None:
        raise ValueError(
            f"{what} needs a covariance, but the transform {arrow(transform)} has none. Add one with "
            "with_covariance(covariance)."
        )
    return covariance


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


def broadcast_stamps(stamp: Any, shape: tuple[int, ...]) -> NDArray[np.int64] | None:
    """Return read-only stamps of a batch, or None without stamps."""
    return None if stamp is None else np.broadcast_to(stamps_of(stamp), shape)


def common_stamp(a: Any, b: Any) -> Any:
    """Return the stamp of a transform made of two: the one that is known, or None if they differ."""
    if a is None or b is None:
        return b if a is None else a
    return a if np.array_equal(a, b) else None


def common_frame(a: str | None, b: str | None, what: str, one: TransformValues, other: TransformValues) -> str | None:
    """Return the frame that two transforms share; None matches any.

    Raises:
        FrameMismatchException: The frames differ.
    """
    if a is not None and b is not None and a != b:
        raise FrameMismatchException.with_details(
            f"cannot {what} {arrow(one)} and {arrow(other)}: {a!r} is not {b!r}",
            target=a,
            source=b,
            hint="Both transforms must be between the same frames. Does one of them need inverse()?",
        )
    return a if b is None else b


def arrow(transform: _core.Transform) -> str:
    """Return the frames of a transform as text."""
    return f"{transform.target or '?'} <- {transform.source or '?'}"


def _make_contiguous(rows: Array) -> Array:
    return rows if rows.strides[-1] == rows.itemsize else np.ascontiguousarray(rows)


def _freeze_array(values: tuple[float, ...]) -> Array:
    """Return a read-only array, because writing to this copy would not change the transform."""
    array = np.array(values)
    array.setflags(write=False)
    return array


def _scipy(method: str) -> Any:
    try:
        from scipy.spatial import transform  # noqa: PLC0415 - coframe itself does not need SciPy
    except ModuleNotFoundError as error:
        text = f"{method}() needs SciPy, which is not installed. Install it with: pip install scipy"
        raise ModuleNotFoundError(text, name=error.name) from None
    return transform
