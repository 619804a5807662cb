# SPDX-License-Identifier: Apache-2.0
"""Deskew point clouds that were measured while the sensor moved."""

from __future__ import annotations

import copy
import math
from typing import TYPE_CHECKING, Any, Literal, TypeVar

import numpy as np

from coframe import _core
from coframe.errors import TransformException
from coframe.sensors import layout
from coframe.sensors.clouds import (
    FLOAT64_ADVICE,
    IDENTITY,
    core_buffer,
    destination,
    frame_of,
    move,
    set_stamp,
    stamp_of,
    thread_count,
)
from coframe.sensors.motion import still_frame
from coframe.sensors.point_times import DESKEWED_PREFIX, TIME_FIELDS
from coframe.sensors.rounding import largest_coordinate, warn_of_rounding
from coframe.time import MICROSECOND, MILLISECOND, SECOND, stamp_ns
from coframe.transform.values import stamps_of

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from coframe.sensors.layout import Vectors
    from coframe.time import StampLike

__all__ = ["deskew"]

Points = TypeVar("Points")
Unit = Literal["ns", "us", "ms", "s"]

_UNITS = {"ns": 1, "us": MICROSECOND, "ms": MILLISECOND, "s": SECOND}
# The time of points that have none: no buffer has a transform at this time.
_NO_TIME = np.iinfo(np.int64).min
_MAX_ATTEMPTS = 10


def deskew(
    points: Points,
    times: ArrayLike | str,
    buffer: _core.Buffer | Any,
    target: str,
    *,
    source: str | None = None,
    fixed: str | None = None,
    at: StampLike | None = None,
    unit: Unit | None = None,
    since: StampLike | None = None,
    vectors: Vectors = (),
    on_error: Literal["raise", "nan"] = "raise",
    out: Points | None = None,
    in_place: bool = False,
    float64: bool = False,
    threads: int = 1,
) -> Points:
    """Transform points that were measured at different times to one frame at one time.

    Each point is first transformed to the frame ``fixed`` with the pose of the sensor at the point's own time, and
    from there to ``target`` at the time ``at``:
    ``lookup(target, fixed, at) @ lookup(fixed, source, time) @ point``. Normals and ``vectors`` are rotated.

    Args:
        points: As in :func:`transform_cloud`.
        times: Time of each point: an array of int64 nanoseconds or datetime64 with one value per point, or one per
            column of an organized cloud, 0 for the latest; or the name of a field, together with ``unit``.
        buffer: The buffer with the motion of the sensor.
        target: The frame to transform to.
        source: The frame of the sensor; by default that in the header of the message.
        fixed: A frame that does not move during the measurement, such as ``"odom"``; by default ``target``. Required
            if ``target`` moves with the sensor, such as ``"base_link"`` or the sensor itself.
        at: The time of the result, if ``target`` moves in ``fixed``; by default the stamp in the header of the message.
        unit: Unit of ``times``: ``"ns"``, ``"us"``, ``"ms"`` or ``"s"``. With a unit, times can have any number type.
        since: The time to which ``times`` are relative; by default the stamp of the header for a field of a message,
            otherwise 0. Use ``since=0`` for a field of absolute times.
        vectors: As in :func:`transform_cloud`.
        on_error: How to handle points without a transform: ``"raise"`` an error, or set them to ``"nan"``.
        out: As in :func:`transform_cloud`.
        in_place: Whether to change ``points`` themselves. They are not changed if an exception is raised.
        float64: As in :func:`transform_cloud`.
        threads: Number of threads; more than one helps from about 200 000 points.

    Returns:
        A new message or array, or ``out``, or ``points``. A message gets the frame ``target`` and the stamp ``at``. In
        messages and new arrays, fields of times such as ``t`` are renamed to ``deskewed_t``, so that no program deskews
        the points again.

    Raises:
        TransformException: As :meth:`coframe.Buffer.lookup`, and the message names the point; with ``"nan"`` only if no
            point has a transform.
        ValueError: As :func:`transform_cloud`; or the number of times differs from the number of points, or the unit is
            missing, or ``fixed`` is missing for a target that moves with the sensor.
        TypeError: Times are floats without a unit.

    Example:
        >>> import coframe
        >>> from coframe.sensors import deskew
        >>> buffer = coframe.Buffer()
        >>> for second in (1, 2):
        ...     moved = coframe.Transform([second, 0, 0])
        ...     _ = buffer.set("odom", "lidar", moved, second * 1_000_000_000)
        >>> same_wall = np.array([[5.0, 0.0, 0.0], [4.5, 0.0, 0.0]])
        >>> deskew(same_wall, [1_000_000_000, 1_500_000_000], buffer, "odom", source="lidar").tolist()
        [[6.0, 0.0, 0.0], [6.0, 0.0, 0.0]]
    """
    if on_error not in {"raise", "nan"}:
        raise ValueError(f'on_error must be "raise" or "nan", not {on_error!r}')
    core = core_buffer(buffer)
    if core is None:
        raise TypeError(f"deskew() needs a coframe.Buffer, not {type(buffer).__name__}")
    source = frame_of(points) if source is None else source
    if source is None:
        raise TypeError("deskew() needs source=..., the frame of the points")
    if source == target and fixed in {None, target}:
        raise ValueError(_missing_fixed_text(target, "a frame that does not move during the measurement"))
    stamps = point_times(points, times, unit, since)
    if fixed is None:
        _check_target_is_still(core, target, source, stamps)
        fixed = target
    from_fixed, stamp = _look_up_target_pose(core, points, target, fixed, at)
    result = destination(points, out, in_place=in_place, float64=float64)
    if fixed == source:
        move(result, from_fixed, vectors, threads=threads)
    else:
        fields = layout.coordinates(result, vectors)
        arguments = (stamps, from_fixed, fields, on_error == "nan", thread_count(threads))
        _deskew_fields(core, fixed, source, arguments)
        warn_of_rounding(largest_coordinate(fields[0]), fields[0], FLOAT64_ADVICE)
    used = {*TIME_FIELDS, times} if isinstance(times, str) else {*TIME_FIELDS}
    if layout.is_message(result):
        result.header.frame_id = target
        if stamp is not None:
            set_stamp(result, stamp)
        result.fields = [_mark_field(field, used) for field in result.fields]
    elif out is None and not in_place:
        result = _mark_array(result, used)
    return result  # type: ignore[no-any-return]


def _mark_field(field: Any, used_fields: set[str]) -> Any:
    if field.name not in used_fields:
        return field
    field = copy.copy(field)
    field.name = f"{DESKEWED_PREFIX}{field.name}"
    return field


def _mark_array(points: NDArray[Any], used_fields: set[str]) -> NDArray[Any]:
    if points.dtype.names is None or points.dtype.fields is None or not used_fields & {*points.dtype.names}:
        return points
    kinds = [points.dtype.fields[name] for name in points.dtype.names]
    dtype = np.dtype(
        {
            "names": [f"{DESKEWED_PREFIX}{name}" if name in used_fields else name for name in points.dtype.names],
            "formats": [kind[0] for kind in kinds],
            "offsets": [kind[1] for kind in kinds],
            "itemsize": points.dtype.itemsize,
        }
    )
    return points.view(dtype)


def _check_target_is_still(buffer: _core.Buffer, target: str, source: str, stamps: NDArray[np.int64]) -> None:
    """Raise ValueError if the target moves with the sensor, because deskewing would then have no effect."""
    known = stamps[stamps > 0]
    if not known.size:
        return
    first, last = int(known.min()), int(known.max())
    sweep = np.array([first, first + (last - first) // 2, last])
    if first == last:
        return
    still = still_frame(buffer, target, source, sweep)
    if still not in {None, target}:
        hint = (
            f"for example fixed={still!r}, relative to which the sensor moves. fixed={target!r} insists on {target!r}"
        )
        raise ValueError(_missing_fixed_text(target, hint))


def _missing_fixed_text(target: str, frame: str) -> str:
    return f"deskew() needs fixed=... for the target {target!r}, which moves with the sensor: {frame}"


def point_times(points: Any, times: ArrayLike | str, unit: str | None, since: StampLike | None) -> NDArray[np.int64]:
    """Return the time of each point in nanoseconds, shape (points,)."""
    if unit is not None and unit not in _UNITS:
        raise ValueError(f"unit must be one of {', '.join(map(repr, _UNITS))}, not {unit!r}")
    if isinstance(times, str):
        if unit is None:
            raise ValueError(f"deskew() needs unit=..., the unit of the field {times!r}")
        values = layout.field_of(points, times)
        since = stamp_of(points) if since is None else since
    else:
        values = np.asarray(times)
    stamps = stamps_of(values) if unit is None else _nanoseconds(values, _UNITS[unit])
    if since is not None:
        stamps = np.where(stamps == _NO_TIME, _NO_TIME, stamps + stamp_ns(since))
    grid = layout.grid_shape(points)
    if stamps.size == math.prod(grid):
        return np.ascontiguousarray(stamps.reshape(-1))
    if len(grid) == 2 and stamps.shape == (grid[1],):
        return np.broadcast_to(stamps, grid).reshape(-1)
    raise ValueError(f"times must have one value per point, but there are {stamps.size} for points of shape {grid}")


def _nanoseconds(values: NDArray[Any], scale: int) -> NDArray[np.int64]:
    if values.dtype.kind not in "iuf":
        raise TypeError(f"times with a unit must be numbers, not {values.dtype}")
    if values.dtype.kind != "f":
        return values.astype(np.int64) * scale
    with np.errstate(over="ignore", invalid="ignore"):
        nanoseconds = values.astype(np.float64) * scale
        known = np.abs(nanoseconds) < np.iinfo(np.int64).max
    return np.where(known, np.rint(np.where(known, nanoseconds, 0.0)).astype(np.int64), _NO_TIME)


def _look_up_target_pose(
    buffer: _core.Buffer, points: Any, target: str, fixed: str, at: StampLike | None
) -> tuple[tuple[float, float, float, float, float, float, float], int | None]:
    """Return the pose from the fixed frame to the target, and the stamp of the result; None keeps the stamp."""
    if fixed == target:
        return IDENTITY, None if at is None else stamp_ns(at)
    if at is None:
        if not layout.is_message(points):
            raise TypeError(f"deskew() needs at=..., the time of the moving target {target!r}")
        at = stamp_of(points)
    transform = buffer.lookup(target, fixed, at)
    return transform.values, transform.stamp


def _deskew_fields(buffer: _core.Buffer, fixed: str, source: str, arguments: tuple[Any, ...]) -> None:
    stamps, *_, nan_for_missing, _ = arguments
    for _ in range(_MAX_ATTEMPTS):
        missing, first = _core.deskew_fields(buffer, fixed, source, *arguments)
        if missing == 0 or (nan_for_missing and missing < len(stamps)):
            return
        try:
            # This raises the reason, unless the missing transform was inserted in the meantime.
            buffer.lookup(fixed, source, int(stamps[first]))
        except TransformException as error:
            raise _point_error(error, first, stamps) from error
    raise TransformException(f"the transforms from {source!r} to {fixed!r} change faster than points can be deskewed")


def _point_error(error: TransformException, point: int, stamps: NDArray[np.int64]) -> TransformException:
    return type(error).with_details(
        f"point {point} of {len(stamps)}, measured at {int(stamps[point])} ns: {error}",
        target=error.target,
        source=error.source,
        requested=error.requested,
        earliest=error.earliest,
        latest=error.latest,
        edge=error.edge,
        hint=error.hint,
        doctor_code=error.doctor_code,
    )
