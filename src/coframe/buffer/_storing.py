# SPDX-License-Identifier: Apache-2.0
"""Check the arguments that a buffer stores, and create the errors for transforms that tf2 rejects."""

from __future__ import annotations

from typing import TYPE_CHECKING

import coframe.lazy_numpy as np
from coframe import _core, time
from coframe.errors import InvalidArgumentException
from coframe.transform.values import stamps_of

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from coframe.time import StampLike
    from coframe.transform.transform import Transform

_REJECTION_HINT = "Frame names must differ and not be empty, values must be finite, and a quaternion must not be zero."


def check_single(parent: str, child: str, transform: Transform, stamp: StampLike | None, *, static: bool) -> None:
    """Check that `set` can store a transform.

    Raises:
        InvalidArgumentException: It is a batch, has other frames, or has no stamp.
        TypeError: It is not a :class:`coframe.Transform`.
    """
    if not isinstance(transform, _core.Transform):
        raise TypeError(
            f"set() takes a coframe.Transform, not {type(transform).__name__}. Create one with "
            "Transform(translation, quaternion), Transform.from_rpy(...) or Transform.from_matrix(...)."
        )
    if transform.shape:
        raise InvalidArgumentException.with_details(
            f"set() takes a single transform, not a batch of shape {transform.shape}",
            hint="Use set_many() for a batch.",
        )
    check_frames(parent, child, transform)
    if stamp is None and transform.stamp is None and not static:
        raise InvalidArgumentException.with_details(
            f"the dynamic transform {parent!r} -> {child!r} has no stamp",
            hint="Pass stamp=..., or static=True if the transform never changes.",
        )


def check_rows(
    parent: str, child: str, stamps: ArrayLike | None, poses: Transform | ArrayLike
) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """Return the stamps, shape (N,), and poses, shape (N, 7), that `set_many` stores.

    Raises:
        InvalidArgumentException: The poses have other frames, or have no stamps.
        ValueError: The shapes do not match.
    """
    if isinstance(poses, _core.Transform):
        check_frames(parent, child, poses)
        stamps = poses.stamps if stamps is None else stamps
        poses = np.concatenate([poses.translation, poses.quaternion], axis=-1)
    values = np.ascontiguousarray(poses, dtype=np.float64)
    if stamps is None:
        raise InvalidArgumentException.with_details(
            f"the dynamic transforms {parent!r} -> {child!r} have no stamps",
            hint="Pass stamps=..., an array of nanoseconds.",
        )
    times = np.ascontiguousarray(stamps_of(stamps))
    if times.ndim != 1 or values.shape != (*times.shape, 7):
        raise ValueError(f"stamps must have shape (N,) and poses (N, 7), not {times.shape} and {values.shape}")
    return times, values


def check_not_frozen(buffer: _core.Buffer, parent: str, child: str) -> None:
    """Raise an InvalidArgumentException if a buffer is read-only."""
    if buffer.frozen:
        raise InvalidArgumentException.with_details(
            f"the buffer is frozen: the transform {parent!r} -> {child!r} was not stored",
            target=parent,
            source=child,
            hint="A snapshot, a loaded file and a buffer after freeze() are read-only. Use a new coframe.Buffer().",
        )


def row_rejection_error(
    parent: str, child: str, row: int, rotation: NDArray[np.float64], text: str
) -> InvalidArgumentException:
    """Return the error for a row of `set_many` that tf2 rejects. A zero quaternion is named as such.

    tf2 reports a zero quaternion as NaN, which is the result of its normalization.
    """
    if rotation.any():
        return rejection_error(parent, child, f"row {row}: {text}")
    return InvalidArgumentException.with_details(
        f"row {row}: the quaternion of {parent!r} -> {child!r} is zero, which is not a rotation",
        target=parent,
        source=child,
        edge=(parent, child),
        hint="Is qw unset? The identity rotation is 0 0 0 1, and the columns are x, y, z, qx, qy, qz, qw.",
    )


def rejection_error(parent: str, child: str, text: str) -> InvalidArgumentException:
    """Return the error for a transform that tf2 rejects, with tf2's message."""
    return InvalidArgumentException.with_details(
        text, target=parent, source=child, edge=(parent, child), hint=_REJECTION_HINT
    )


def stamp_of(transform: Transform, stamp: StampLike | None) -> int:
    """Return the stamp with which a transform is stored, in nanoseconds."""
    return (transform.stamp if stamp is None else time.stamp_ns(stamp)) or 0


def check_frames(parent: str, child: str, transform: Transform) -> None:
    """Raise an InvalidArgumentException if the frames of a transform are not those of its edge."""
    frames = (transform.target or parent, transform.source or child)
    if frames != (parent, child):
        raise InvalidArgumentException.with_details(
            f"cannot store the transform {frames[0]} <- {frames[1]} as {parent} <- {child}",
            target=parent,
            source=child,
            hint="In set(parent, child, transform), parent must be the transform's target and child its source.",
        )
