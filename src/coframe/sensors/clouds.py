# SPDX-License-Identifier: Apache-2.0
"""Transform point clouds to another frame."""

from __future__ import annotations

import copy
from typing import TYPE_CHECKING, Any, TypeVar, overload

from coframe import _core
from coframe.errors import FrameMismatchException
from coframe.sensors import layout
from coframe.sensors.rounding import as_float64, warn_of_rounding
from coframe.time import SECOND, stamp_ns
from coframe.transform.transform import Transform

if TYPE_CHECKING:
    from collections.abc import Sequence

    from coframe.sensors.layout import Vectors
    from coframe.time import DurationLike, StampLike

__all__ = ["transform_cloud"]

Points = TypeVar("Points")
Values = tuple[float, float, float, float, float, float, float]

FLOAT64_ADVICE = (
    "float64=True in transform_cloud() and deskew() keeps them; so does a frame near the sensor, such as odom or map."
)
IDENTITY: Values = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0)


@overload
def transform_cloud(
    cloud: Points,
    transform: Transform | object,
    *,
    vectors: Vectors = (),
    out: Points | None = None,
    in_place: bool = False,
    float64: bool = False,
    threads: int = 1,
) -> Points: ...
@overload
def transform_cloud(
    cloud: Points,
    transform: _core.Buffer,
    target: str,
    *,
    source: str | None = None,
    stamp: StampLike | None = None,
    timeout: DurationLike | None = None,
    vectors: Vectors = (),
    out: Points | None = None,
    in_place: bool = False,
    float64: bool = False,
    threads: int = 1,
) -> Points: ...
def transform_cloud(
    cloud: Points,
    transform: Any,
    target: str | None = None,
    *,
    source: str | None = None,
    stamp: StampLike | None = None,
    timeout: DurationLike | None = None,
    vectors: Vectors = (),
    out: Points | None = None,
    in_place: bool = False,
    float64: bool = False,
    threads: int = 1,
) -> Points:
    """Transform the points of a cloud to another frame.

    Positions (x, y, z) are rotated and translated, and computed in float64 regardless of their stored type. Normals
    (normal_x, normal_y, normal_z; nx, ny, nz) and ``vectors`` are rotated. Everything else is kept: other fields, the
    layout, the byte order, and points that are NaN.

    Args:
        cloud: A PointCloud2 message; a structured array with the fields x, y, z; or a float32 or float64 array of
            shape (N, 3) or (rows, columns, 3), or with more columns. Positions are in meters.
        transform: A single :class:`coframe.Transform`, a TransformStamped or Transform message, or a buffer that
            contains the transform: ``transform_cloud(cloud, buffer, "map")``.
        target: Only with a buffer: the frame to transform to.
        source: Only with a buffer: the frame of the points; by default that in the header of the message.
        stamp: Only with a buffer: the time of the measurement; by default that in the header of the message, for
            arrays the latest.
        timeout: Only with a buffer: how long to wait for the transform.
        vectors: Fields to rotate in addition to normals: three names, such as ``("vx", "vy", "vz")``, or a sequence of
            such triples; for a plain array the indices of the columns.
        out: A message or an array of the same shape for the result; its memory is reused if it has the right size.
        in_place: Whether to change ``cloud`` itself.
        float64: Whether the result has float64 coordinates. float32 rounds them by more than a millimeter from 16 km
            on, and to 0.5 m in UTM coordinates, of which a :class:`coframe.CoframeWarning` warns.
        threads: Number of threads; more than one helps from about a million points.

    Returns:
        A new message or array, or ``out``, or ``cloud``. The frame of a message is the target of the transform.

    Raises:
        FrameMismatchException: The frame in the cloud's header is not the source of the transform.
        TransformException: As :meth:`coframe.Buffer.lookup`.
        TypeError: An argument has a wrong type, or ``target`` or ``source`` is missing.
        ValueError: A field is missing or is not float32 or float64, or the sizes in the message do not match its data.

    Example:
        >>> import coframe
        >>> import numpy as np
        >>> from coframe.sensors import transform_cloud
        >>> lidar = coframe.Transform([0.0, 0.0, 0.5], target="base_link", source="lidar")
        >>> transform_cloud(np.array([[1.0, 2.0, 3.0]]), lidar).tolist()
        [[1.0, 2.0, 3.5]]
    """
    frame = frame_of(cloud) if source is None else source
    if (buffer := core_buffer(transform)) is not None:
        if target is None or frame is None:
            missing = "target" if target is None else "source"
            raise TypeError(f"transform_cloud() needs {missing}=... to look up the transform in a buffer")
        when = stamp_of(cloud) if stamp is None else stamp
        transform = buffer.lookup(target, frame, when, timeout=timeout)
    elif (target, source, stamp, timeout) != (None, None, None, None):
        raise TypeError("target, source, stamp and timeout can be used only with a buffer, not with a transform")
    else:
        transform = to_transform(transform)
        check_source(transform, frame)
    result = destination(cloud, out, in_place=in_place, float64=float64)
    move(result, transform.values, vectors, threads=threads)
    if transform.target is not None and layout.is_message(result):
        result.header.frame_id = transform.target
    return result  # type: ignore[no-any-return]


def destination(points: Any, out: Any, *, in_place: bool, float64: bool) -> Any:
    """Return the object to change, as :func:`layout.destination`, or a new one with float64 coordinates.

    Raises:
        ValueError: ``float64`` is combined with ``out`` or ``in_place``.
    """
    if not float64:
        return layout.destination(points, out, in_place=in_place)
    if in_place or out is not None:
        raise ValueError("float64=True creates a new cloud: omit in_place and out")
    return as_float64(points)


def move(
    points: Any,
    values: Values,
    vectors: Vectors = (),
    *,
    normals: Sequence[Sequence[str]] = layout.NORMALS,
    threads: int = 1,
) -> None:
    """Transform points by a pose, in place."""
    fields = layout.coordinates(points, vectors, normals)
    x, y, z, *_ = values
    warn_of_rounding(max(abs(x), abs(y), abs(z)), fields[0], FLOAT64_ADVICE)
    _core.transform_fields(values, fields, thread_count(threads))


def core_buffer(thing: Any) -> _core.Buffer | None:
    """Return the core buffer of a coframe.Buffer or tf2_ros.Buffer, or None for other objects."""
    thing = getattr(thing, "_Coframe__buffer", thing)
    return thing if isinstance(thing, _core.Buffer) else None


def to_transform(transform: Any) -> Transform:
    """Return a single transform from a Transform or a message. The quaternion of a message is normalized.

    Raises:
        TypeError: The argument has another type.
        ValueError: The argument is a batch.
    """
    if isinstance(transform, _core.Transform):
        if transform._batch is not None:
            raise ValueError("transform must be a single transform, not a batch. To move each point, use deskew().")
        return transform  # type: ignore[return-value]
    target = source = None
    if hasattr(transform, "transform") and hasattr(transform, "child_frame_id"):
        target, source = transform.header.frame_id or None, transform.child_frame_id or None
        transform = transform.transform
    if not hasattr(transform, "translation") or not hasattr(transform, "rotation"):
        kind = type(transform).__name__
        raise TypeError(f"transform must be a Transform, a TransformStamped or a buffer, not {kind}")
    t, q = transform.translation, transform.rotation
    return Transform((t.x, t.y, t.z), (q.x, q.y, q.z, q.w), target=target, source=source)


def check_source(transform: Transform, frame: str | None) -> None:
    """Raise FrameMismatchException if `frame` is not the source of the transform."""
    if frame and transform.source is not None and transform.source != frame:
        raise FrameMismatchException.with_details(
            f"cannot transform points in frame {frame!r} by the transform {transform.target} <- {transform.source}",
            target=transform.target,
            source=frame,
            hint="Does the transform need inverse()?",
        )


def frame_of(points: Any) -> str | None:
    """Return the frame in the header of a message, or None if it is empty or there is no header."""
    return points.header.frame_id or None if layout.is_message(points) else None


def stamp_of(points: Any) -> int:
    """Return the stamp in the header of a message in nanoseconds; 0, the latest, for arrays."""
    return stamp_ns(points.header.stamp) if layout.is_message(points) else 0


def set_stamp(message: Any, stamp: int) -> None:
    """Set the stamp of a message's header to a new object, because the old one may be shared."""
    message.header.stamp = copy.copy(message.header.stamp)
    message.header.stamp.sec, message.header.stamp.nanosec = divmod(stamp, SECOND)


def thread_count(threads: int) -> int:
    """Check the number of threads and return it.

    Raises:
        ValueError: The number is less than one.
    """
    if threads < 1:
        raise ValueError(f"threads must be at least 1, not {threads}")
    return threads
