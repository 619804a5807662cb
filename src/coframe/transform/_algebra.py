# SPDX-License-Identifier: Apache-2.0
"""The part of Transform with the operations of the group SE(3), for single transforms and batches."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, Any

import coframe.lazy_numpy as np
from coframe import _core, quaternion
from coframe.errors import FrameMismatchException, InvalidArgumentException
from coframe.transform import _covariance
from coframe.transform.interpolation import is_screw
from coframe.transform.values import (
    TransformValues,
    any_stamp,
    arrow,
    common_frame,
    common_stamp,
    derive_transform,
    known_covariance,
    pose_rows,
)

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from coframe.quaternion import Array
    from coframe.transform._covariance import Ellipsoid
    from coframe.transform.interpolation import Interpolation
    from coframe.transform.transform import Transform


@cache
def _identity() -> tuple[Array, Array]:
    """Return a translation and a quaternion, as the native core takes them."""
    return np.zeros((1, 3)), np.array([[0.0, 0.0, 0.0, 1.0]])


class TransformAlgebra(TransformValues):
    """Composition, exponential, interpolation, means, and what they do to covariances."""

    __slots__ = ()

    @classmethod
    def exp(
        cls, twist: ArrayLike, *, target: str | None = None, source: str | None = None, stamp: Any = None
    ) -> Transform:
        """Return the motion of a body that moves with a constant twist for one unit of time.

        Args:
            twist: Shape (..., 6): the linear velocity, then the angular velocity in radians, along the axes of the
                body, as in Pinocchio's ``exp6`` and in ROS's Twist.
            target: The target frame.
            source: The source frame.
            stamp: Time in nanoseconds, for a batch an int64 array of its shape.

        Raises:
            InvalidArgumentException: A value is not finite.
            ValueError: ``twist`` has another shape.

        Example:
            >>> import coframe
            >>> import numpy as np
            >>> coframe.Transform.exp([np.pi / 2, 0, 0, 0, 0, np.pi / 2]).translation.round(3).tolist()
            [1.0, 1.0, 0.0]
        """
        given = np.asarray(twist, dtype=np.float64)
        if given.shape[-1:] != (6,):
            raise ValueError(f"twist must have shape (..., 6), not {given.shape}")
        if not np.isfinite(given).all():
            raise InvalidArgumentException.with_details(
                "twist must be finite, but contains NaN or inf", hint="Check where the values come from."
            )
        rows = np.empty((given.size // 6, 7))
        _core.exponentials(np.ascontiguousarray(given), rows)
        return _transform_of_rows(rows, given.shape[:-1], target, source, stamp)

    def log(self) -> Array:
        """Return the twist whose :meth:`exp` is this transform, with a rotation of at most half a turn.

        Returns:
            Shape (6,), for a batch (..., 6): the linear part in meters, then the angular part in radians, along the
            axes of ``source``.
        """
        rows = np.empty((int(np.prod(self.shape)), 6))
        _core.logarithms(pose_rows(self, self.shape), rows)
        return rows.reshape(*self.shape, 6)

    def pow(self, exponent: ArrayLike) -> Transform:
        """Return this motion repeated, or a part of it, along its screw: ``t ** 0.5`` is half of the way.

        Args:
            exponent: A number, or an array that broadcasts with the batch axes.

        Returns:
            ``exp(exponent * t.log())`` between the same frames, without a covariance.
        """
        factors = np.asarray(exponent, dtype=np.float64)
        stamp = any_stamp(self)
        return self.exp(factors[..., None] * self.log(), target=self.target, source=self.source, stamp=stamp)

    def __pow__(self, exponent: ArrayLike) -> Transform:
        return self.pow(exponent)

    def inverse(self) -> Transform:
        """Return the inverse transform, with target and source exchanged, and its covariance if there is one."""
        if (single := _core.invert_single(self)) is not None:
            return single
        rows = np.empty((int(np.prod(self.shape)), 7))
        _core.compose_batches(pose_rows(self, self.shape), _identity(), True, rows)
        found = _transform_of_rows(rows, self.shape, self.source, self.target, any_stamp(self))
        if self.covariance is None:
            return found
        return _replace_covariance(
            found, _covariance.invert_covariance(self.covariance, self.rotation, self.translation), self.exact_edges
        )

    def interpolate(
        self, other: Transform, fraction: ArrayLike, *, interpolation: Interpolation = "decoupled"
    ) -> Transform:
        """Return poses on the way from this one to another.

        Args:
            other: The transform at fraction 1, between the same frames, with batch axes that broadcast.
            fraction: 0 is this transform, 1 is ``other``; a number, or an array that broadcasts with the batch axes.
                Other numbers extrapolate.
            interpolation: ``"decoupled"``: the translation on a line and the rotation along the shortest arc, as in
                tf2; or ``"screw"``: with a constant twist of the body, exact for a robot that drives along a circle.

        Returns:
            The poses; stamps are interpolated, too, and covariances along the axes of ``source`` if both have one.

        Raises:
            FrameMismatchException: The frames are named and differ.
            ValueError: ``interpolation`` is unknown.

        Example:
            >>> import coframe
            >>> start, end = coframe.Transform(), coframe.Transform.from_rpy([2.0, 0, 0], yaw=1.0)
            >>> start.interpolate(end, [0.25, 0.5]).x.tolist()
            [0.5, 1.0]
        """
        target = common_frame(self.target, other.target, "interpolate between", self, other)
        source = common_frame(self.source, other.source, "interpolate between", self, other)
        s = np.asarray(fraction, dtype=np.float64)
        shape = np.broadcast_shapes(self.shape, other.shape, s.shape)
        given = s.reshape(1) if s.ndim == 0 else np.ascontiguousarray(np.broadcast_to(s, shape)).reshape(-1)
        rows = np.empty((int(np.prod(shape)), 7))
        screw = is_screw(interpolation)
        _core.interpolate_batches(pose_rows(self, shape), pose_rows(other, shape), given, screw, rows)
        found = _transform_of_rows(rows, shape, target, source, _interpolated_stamps(self, other, s))
        if self.covariance is None or other.covariance is None:
            return found
        ends = [_covariance.to_body(known_covariance(t, ""), t.rotation) for t in (self, other)]
        body = (1.0 - s)[..., None, None] * ends[0] + s[..., None, None] * ends[1]
        return _replace_covariance(
            found, _covariance.from_body(body, found.rotation), (*self.exact_edges, *other.exact_edges)
        )

    def adjoint(self) -> Array:
        """Return the matrix that converts twists along the axes of ``source`` into twists along those of ``target``.

        Returns:
            Shape (6, 6), for a batch (..., 6, 6), in the order linear, angular: ``t @ exp(xi)`` is the same as
            ``exp(t.adjoint() @ xi) @ t``.
        """
        return _covariance.adjoint(self.rotation, self.translation)

    def distance(self, other: Transform) -> tuple[Any, Any]:
        """Return how far another pose is away.

        Args:
            other: The other transform, with batch axes that broadcast.

        Returns:
            The distance in meters and the angle of the rotation in radians, floats or arrays of the batch shape.

        Raises:
            FrameMismatchException: The frames are named and differ.
        """
        common_frame(self.target, other.target, "compare", self, other)
        common_frame(self.source, other.source, "compare", self, other)
        apart = np.linalg.norm(self.translation - other.translation, axis=-1)
        rotation_difference = quaternion.multiply(quaternion.inverse(self.quaternion), other.quaternion)
        angle = 2.0 * np.arctan2(
            np.linalg.norm(rotation_difference[..., :3], axis=-1), np.abs(rotation_difference[..., 3])
        )
        return (float(apart), float(angle)) if np.ndim(apart) == np.ndim(angle) == 0 else (apart, angle)

    def mean(self, weights: ArrayLike | None = None) -> Transform:
        """Return the mean of all poses of a batch.

        The translation is the arithmetic mean. The rotation has the least sum of squared distances between rotation
        matrices (F. L. Markley et al., "Averaging Quaternions", 2007), as in SciPy's ``Rotation.mean``.

        Args:
            weights: A weight for each pose, not negative, shape ``self.shape``; None weights all the same.

        Returns:
            A single transform between the same frames, without stamp and covariance.

        Raises:
            ValueError: This is not a batch, or is empty; or the weights have another shape, are negative, or are all
                zero.
        """
        if not self.shape or not np.prod(self.shape):
            raise ValueError("mean() needs a batch of at least one transform")
        w = np.ones(self.shape) if weights is None else np.asarray(weights, dtype=np.float64)
        if w.shape != self.shape:
            raise ValueError(f"weights must have shape {self.shape}, not {w.shape}")
        if not (w >= 0.0).all() or not 0.0 < w.sum() < np.inf:
            raise ValueError("weights must be finite and not negative, and at least one must be positive")
        w = w.reshape(-1) / w.sum()
        q = self.quaternion.reshape(-1, 4)
        _, vectors = np.linalg.eigh((q.T * w) @ q)
        mean = vectors[:, -1] * (-1.0 if vectors[3, -1] < 0.0 else 1.0)
        return derive_transform(w @ self.translation.reshape(-1, 3), mean, self.target, self.source, None)

    @classmethod
    def stack(cls, transforms: Any) -> Transform:
        """Return transforms of the same shape as one batch with a new first axis.

        Args:
            transforms: At least one transform; frames that are named must be the same.

        Returns:
            The batch, with stamps and covariances if all have them.

        Raises:
            FrameMismatchException: The frames differ.
            ValueError: There is no transform, or the shapes differ.
        """
        return _join(list(transforms), "stack", np.stack)

    @classmethod
    def concatenate(cls, transforms: Any) -> Transform:
        """Return single transforms and batches as one batch, joined along the first axis.

        Args:
            transforms: At least one transform; frames that are named must be the same.

        Returns:
            The batch, with stamps and covariances if all have them.

        Raises:
            FrameMismatchException: The frames differ.
            ValueError: There is no transform, or the other axes differ.
        """
        return _join([each if each.shape else cls.stack([each]) for each in transforms], "concatenate", np.concatenate)

    def with_covariance(self, covariance: ArrayLike | None, convention: str = "ros") -> Transform:
        """Return this pose with a covariance; None removes it.

        Args:
            covariance: Shape (6, 6) or (36,), for a batch also (..., 6, 6) or (..., 36).
            convention: The convention of the given matrix; see :meth:`as_covariance`.

        Raises:
            InvalidArgumentException: The matrix is not symmetric, has a negative eigenvalue or is not finite.
            ValueError: It has another shape, or the convention is unknown.
        """
        if covariance is None:
            return _replace_covariance(self, None, ())
        given = _covariance.check_covariances(covariance, self.shape)
        return _replace_covariance(self, _covariance.from_convention(given, self.rotation, convention), ())

    def fuse(self, other: Transform) -> Transform:
        """Return the most likely pose given two independent estimates of it, with its covariance.

        Iterates a Kalman update on SE(3) (T. Barfoot and P. Furgale, "Associating Uncertainty with Three-Dimensional
        Poses", 2014, section IV), so that estimates may be far apart. Where neither has variance, this pose counts.

        Args:
            other: The other estimate, with a covariance and batch axes that broadcast.

        Raises:
            FrameMismatchException: The frames are named and differ.
            ValueError: One of them has no covariance.
        """
        target = common_frame(self.target, other.target, "fuse", self, other)
        source = common_frame(self.source, other.source, "fuse", self, other)
        own_covariance = _covariance.to_body(known_covariance(self, "fuse()"), self.rotation)
        others = _covariance.to_body(known_covariance(other, "fuse()"), other.rotation)
        x, body = _covariance.fuse_poses(
            own_covariance,
            others,
            lambda twist: (other.inverse() @ (self.with_covariance(None) @ self.exp(twist))).log(),
        )
        pose = self.with_covariance(None) @ self.exp(x)
        covariance = _covariance.from_body(body, pose.rotation)
        stamp = common_stamp(any_stamp(self), any_stamp(other))
        exact = (*self.exact_edges, *other.exact_edges)
        return derive_transform(pose.translation, pose.quaternion, target, source, stamp, covariance, exact)

    def mahalanobis(self, other: Transform) -> Any:
        """Return how far another pose is away in standard deviations, by both covariances together.

        Its square has a chi-squared distribution with six degrees of freedom if both are estimates of one pose.

        Args:
            other: The other pose, with or without a covariance, with batch axes that broadcast.

        Returns:
            A float, or an array of the batch shape.

        Raises:
            FrameMismatchException: The frames are named and differ.
            InvalidArgumentException: The sum of the covariances is singular: a direction has no variance.
            ValueError: This transform has no covariance.
        """
        common_frame(self.target, other.target, "compare", self, other)
        common_frame(self.source, other.source, "compare", self, other)
        total = known_covariance(self, "mahalanobis()")
        if other.covariance is not None:
            total = total + other.covariance
        error = (self.with_covariance(None).inverse() @ other.with_covariance(None)).log()
        rotated_error = np.concatenate(
            [quaternion.rotate(self.quaternion, error[..., :3]), quaternion.rotate(self.quaternion, error[..., 3:])],
            axis=-1,
        )
        found = _covariance.mahalanobis(rotated_error, total)
        return float(found) if np.ndim(found) == 0 else found

    def ellipsoid(self, confidence: float = 0.95) -> Ellipsoid:
        """Return the ellipsoid around the position that contains the true position with a probability.

        Args:
            confidence: The probability, between 0 and 1.

        Returns:
            ``pose``, the center and the principal axes in ``target``, and ``radii`` in meters, shape (..., 3), from
            the longest to the shortest.

        Raises:
            ValueError: There is no covariance, or ``confidence`` is not between 0 and 1.
        """
        radii, axes = _covariance.ellipsoid(known_covariance(self, "ellipsoid()"), confidence)
        stamp = any_stamp(self)
        pose = derive_transform(self.translation, quaternion.from_matrix(axes), self.target, None, stamp)
        return _covariance.Ellipsoid(pose, radii)

    def _compose(self, other: Transform) -> Transform:
        if (single := _core.compose_single(self, other)) is not None:
            return single
        if self.source is not None and other.target is not None and self.source != other.target:
            raise FrameMismatchException.with_details(
                f"cannot compose {arrow(self)} with {arrow(other)}: {self.source!r} is not {other.target!r}",
                target=self.target,
                source=other.source,
                hint="The inner frames must be the same. Does one of the transforms need inverse()?",
            )
        shape = np.broadcast_shapes(self.shape, other.shape)
        rows = np.empty((int(np.prod(shape)), 7))
        _core.compose_batches(pose_rows(self, shape), pose_rows(other, shape), False, rows)
        stamp = common_stamp(any_stamp(self), any_stamp(other))
        found = _transform_of_rows(rows, shape, self.target, other.source, stamp)
        if self.covariance is None and other.covariance is None:
            return found
        covariance = _covariance.compound_covariances(
            self.covariance, other.covariance, self.rotation, other.translation
        )
        return _replace_covariance(found, covariance, (*self.exact_edges, *other.exact_edges))


def _transform_of_rows(
    rows: Array, shape: tuple[int, ...], target: str | None, source: str | None, stamp: Any
) -> Transform:
    """Return the transform of an array (n, 7) that no other object uses."""
    rows.setflags(write=False)
    poses = rows.reshape(*shape, 7)
    return derive_transform(poses[..., :3], poses[..., 3:], target, source, stamp)


def _replace_covariance(
    transform: TransformValues, covariance: Array | None, exact_edges: tuple[str, ...]
) -> Transform:
    """Return the same transform with another covariance."""
    if covariance is None and transform._uncertainty is None:
        return transform  # type: ignore[return-value]  # the only class of transforms
    stamp = any_stamp(transform)
    t, q = transform.translation, transform.quaternion
    return derive_transform(
        t, q, transform.target, transform.source, stamp, covariance, tuple(dict.fromkeys(exact_edges))
    )


def _interpolated_stamps(a: TransformValues, b: TransformValues, fraction: Array) -> Any:
    first, last = any_stamp(a), any_stamp(b)
    if first is None or last is None:
        return None
    start, length = np.asarray(first), np.asarray(last) - np.asarray(first)
    return start + np.round(fraction * length).astype(np.int64)


def _join(transforms: list[Any], what: str, join: Any) -> Transform:
    if not transforms:
        raise ValueError(f"{what}() needs at least one transform")
    target, source = transforms[0].target, transforms[0].source
    for other in transforms[1:]:
        target = common_frame(target, other.target, what, transforms[0], other)
        source = common_frame(source, other.source, what, transforms[0], other)
    stamps, found = [any_stamp(each) for each in transforms], [each.covariance for each in transforms]
    exact = tuple(dict.fromkeys(edge for each in transforms for edge in each.exact_edges))
    return derive_transform(
        _read_only(join([each.translation for each in transforms])),
        _read_only(join([each.quaternion for each in transforms])),
        target,
        source,
        None if any(stamp is None for stamp in stamps) else join(stamps),
        None if any(each is None for each in found) else join(found),
        exact,
    )


def _read_only(array: Array) -> Array:
    array.setflags(write=False)
    return array
