"""Point clouds seen from another frame."""

from __future__ import annotations

import copy
from typing import TYPE_CHECKING, Any, TypeVar, overload

from coframe import _core
from coframe.errors import FrameMismatchException
from coframe.sensors import layout
from coframe.time import stamp_ns
from coframe.transform import Transform

if TYPE_CHECKING:
    from collections.abc import Sequence

    from coframe.sensors.layout import Vectors
    from coframe.time import DurationLike, StampLike

__all__ = ["transform_cloud"]

Points = TypeVar("Points")
Values = tuple[float, float, float, float, float, float, float]

IDENTITY: Values = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0)


@overload
def transform_cloud(
    cloud: Points,
    transform: Transform | object,
    *,
    vectors: Vectors = (),
    out: Points | None = None,
    in_place: bool = False,
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
    threads: int = 1,
) -> Points:
    """Points, seen from another frame.

    Positions (x, y, z) are rotated and moved, in float64 whatever they are stored as. Normals (normal_x, normal_y,
    normal_z; nx, ny, nz) and ``vectors`` are rotated. All else stays: other fields, the layout, the byte order, and
    points that are NaN.

    Args:
        cloud: A PointCloud2 message; a structured array with the fields x, y, z; or a float32 or float64 array of
            shape (N, 3) or (rows, columns, 3), or with more columns. Metres.
        transform: A single :class:`coframe.Transform`, a TransformStamped or Transform message, or a buffer to look it
            up in: ``transform_cloud(cloud, buffer, "map")``.
        target: For a buffer: the frame that the points shall be in.
        source: For a buffer: the frame that they are in; a message's header says it.
        stamp: For a buffer: when they were measured, by default when a message's header says; else the latest.
        timeout: For a buffer: how long to wait for the transform.
        vectors: Fields to rotate besides normals: three names, such as ``("vx", "vy", "vz")``, or a sequence of such
            threes; of a plain array the numbers of their columns.
        out: A message or an array of the same shape that the result goes to; its memory is used again if it fits.
        in_place: Change ``cloud`` itself.
        threads: How many threads share the work; worth it from about a million points on.

    Returns:
        What ``cloud`` is: a new message or array, or ``out``, or ``cloud``. A message's frame is the transform's.

    Raises:
        FrameMismatchException: The cloud's header names another frame than the transform's source.
        TransformException: As :meth:`coframe.Buffer.lookup`.
        ValueError: A field is missing or not float32 or float64, or the message's sizes do not fit its data.

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
            raise TypeError(f"transform_cloud() needs {missing}=... to look the transform up in a buffer")
        when = stamp_of(cloud) if stamp is None else stamp
        transform = buffer.lookup(target, frame, when, timeout=timeout)
    elif (target, source, stamp, timeout) != (None, None, None, None):
        raise TypeError("target, source, stamp and timeout are for a look-up in a buffer, and a transform was given")
    else:
        transform = to_transform(transform)
        check_source(transform, frame)
    result = layout.destination(cloud, out, in_place=in_place)
    move(result, transform.values, vectors, threads=threads)
    if transform.target is not None and layout.is_message(result):
        result.header.frame_id = transform.target
    return result  # type: ignore[no-any-return]


def move(
    points: Any,
    values: Values,
    vectors: Vectors = (),
    *,
    normals: Sequence[Sequence[str]] = layout.NORMALS,
    threads: int = 1,
) -> None:
    """Transforms points by a pose, in place."""
    fields = layout.coordinates(points, vectors, normals)
    _core.transform_fields(values, fields, thread_count(threads))


def core_buffer(thing: Any) -> _core.Buffer | None:
    """The buffer that it is, or that a buffer of tf2_ros stands on; None for what is no buffer."""
    thing = getattr(thing, "_coframe_buffer", thing)
    return thing if isinstance(thing, _core.Buffer) else None


def to_transform(transform: Any) -> Transform:
    """A transform from what people have; from a message without knowing how exact its quaternion is.

    Raises:
        TypeError: It is something else.
        ValueError: It is a batch.
    """
    if isinstance(transform, _core.Transform):
        if transform._batch is not None:
            raise ValueError("one transform is needed, not a batch; deskew() gives each point its own")
        return transform  # type: ignore[return-value]
    target = source = None
    if hasattr(transform, "transform") and hasattr(transform, "child_frame_id"):
        target, source = transform.header.frame_id or None, transform.child_frame_id or None
        transform = transform.transform
    if not hasattr(transform, "translation") or not hasattr(transform, "rotation"):
        raise TypeError(f"a Transform, a TransformStamped or a buffer is needed, not {type(transform).__name__}")
    t, q = transform.translation, transform.rotation
    return Transform((t.x, t.y, t.z), (q.x, q.y, q.z, q.w), target=target, source=source)


def check_source(transform: Transform, frame: str | None) -> None:
    """Raises FrameMismatchException if points in `frame` are not what the transform is for."""
    if frame and transform.source is not None and transform.source != frame:
        raise FrameMismatchException.with_details(
            f"the points are in {frame!r}, but the transform is {transform.target} <- {transform.source}",
            target=transform.target,
            source=frame,
            hint="Is the transform the wrong way round (inverse())?",
        )


def frame_of(points: Any) -> str | None:
    """The frame that a message's header names; None if it names none or there is no header."""
    return points.header.frame_id or None if layout.is_message(points) else None


def stamp_of(points: Any) -> int:
    """The stamp of a message's header; 0, the latest, where there is none."""
    return stamp_ns(points.header.stamp) if layout.is_message(points) else 0


def set_stamp(message: Any, stamp: int) -> None:
    """Gives a message's header a stamp of its own."""
    message.header.stamp = copy.copy(message.header.stamp)
    message.header.stamp.sec, message.header.stamp.nanosec = divmod(stamp, 1_000_000_000)


def thread_count(threads: int) -> int:
    """How many threads were asked for.

    Raises:
        ValueError: Less than one.
    """
    if threads < 1:
        raise ValueError(f"threads must be at least 1, not {threads}")
    return threads
