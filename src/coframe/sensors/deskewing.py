"""Point clouds that were measured while the sensor moved."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, Literal, TypeVar

import numpy as np

from coframe import _core
from coframe.errors import TransformException
from coframe.sensors import layout
from coframe.sensors.clouds import IDENTITY, core_buffer, frame_of, move, set_stamp, stamp_of, thread_count
from coframe.time import stamp_ns
from coframe.transform import stamps_of

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from coframe.sensors.layout import Vectors
    from coframe.time import StampLike

__all__ = ["deskew"]

Points = TypeVar("Points")
Unit = Literal["ns", "us", "ms", "s"]

_UNITS = {"ns": 1, "us": 1_000, "ms": 1_000_000, "s": 1_000_000_000}
# A time for which no buffer has a transform: of points that have none.
_NO_TIME = np.iinfo(np.int64).min
_ATTEMPTS = 10


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
    threads: int = 1,
) -> Points:
    """Points that were measured at different times, in one frame at one time.

    Each point is first put into the frame ``fixed``, by where the sensor was at the point's own time, and from there
    into ``target`` as it was at the time ``at``: ``lookup(target, fixed, at) @ lookup(fixed, source, time) @ point``.
    Normals and ``vectors`` are rotated along.

    Args:
        points: As in :func:`transform_cloud`.
        times: When each point was measured: an array of int64 nanoseconds or datetime64, one a point, or one a column
            of an organised cloud, 0 for the latest; or the name of a field, with ``unit``.
        buffer: Where the motion is known.
        target: The frame that the points shall be in.
        source: The sensor's frame; a message's header says it.
        fixed: A frame that stands still while the points are measured, such as ``"odom"``; by default ``target``. A
            target that moves, such as the sensor itself, needs one.
        at: The time at which ``target`` is meant if it moves in ``fixed``; by default when a message's header says.
        unit: What ``times`` are told in: ``"ns"``, ``"us"``, ``"ms"`` or ``"s"``. Then they may be of any number type.
        since: What ``times`` count from; by default the header's stamp for a field of a message, else 0. A field of
            absolute times has ``since=0``.
        vectors: As in :func:`transform_cloud`.
        on_error: ``"raise"`` if there is no transform for a point, or make such points ``"nan"``.
        out: As in :func:`transform_cloud`.
        in_place: Change ``points`` themselves. They stay as they are if this raises.
        threads: How many threads share the work; worth it from about 200 000 points on.

    Returns:
        What ``points`` is: a new message or array, or ``out``, or ``points``. A message gets the frame ``target`` and
        the stamp ``at``; a field of times stays as it is.

    Raises:
        TransformException: As :meth:`coframe.Buffer.lookup`, and the text says for which point; with ``"nan"`` only if
            there is a transform for none of them.
        ValueError: As :func:`transform_cloud`; or there are not as many times as points, or no unit, or the sensor is
            its own target.
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
        raise TypeError("deskew() needs source=...: the frame that the points are in")
    fixed = target if fixed is None else fixed
    if source == target == fixed:
        raise ValueError(f"{target!r} moves with the points: give fixed=..., a frame that stands still meanwhile")
    stamps = point_times(points, times, unit, since)
    onward, stamp = _onward(core, points, target, fixed, at)
    result = layout.destination(points, out, in_place=in_place)
    if fixed == source:
        move(result, onward, vectors, threads=threads)
    else:
        fields = layout.coordinates(result, vectors)
        arguments = (stamps, onward, fields, on_error == "nan", thread_count(threads))
        _deskew_fields(core, fixed, source, arguments)
    if layout.is_message(result):
        result.header.frame_id = target
        if stamp is not None:
            set_stamp(result, stamp)
    return result  # type: ignore[no-any-return]


def point_times(points: Any, times: ArrayLike | str, unit: str | None, since: StampLike | None) -> NDArray[np.int64]:
    """When each point was measured, in nanoseconds, shape (points,)."""
    if unit is not None and unit not in _UNITS:
        raise ValueError(f"unit must be one of {', '.join(map(repr, _UNITS))}, not {unit!r}")
    if isinstance(times, str):
        if unit is None:
            raise ValueError(f"deskew() needs unit=...: what the field {times!r} is told in")
        values = layout.field_of(points, times)
        since = stamp_of(points) if since is None else since
    else:
        values = np.asarray(times)
    stamps = stamps_of(values) if unit is None else _nanoseconds(values, _UNITS[unit])
    if since is not None:
        stamps = np.where(stamps == _NO_TIME, _NO_TIME, stamps + stamp_ns(since))
    grid = layout.grid_of(points)
    if stamps.size == math.prod(grid):
        return np.ascontiguousarray(stamps.reshape(-1))
    if len(grid) == 2 and stamps.shape == (grid[1],):
        return np.broadcast_to(stamps, grid).reshape(-1)
    raise ValueError(f"there are {stamps.size} times for points of the shape {grid}")


def _nanoseconds(values: NDArray[Any], scale: int) -> NDArray[np.int64]:
    if values.dtype.kind not in "iuf":
        raise TypeError(f"times in a unit must be numbers, not {values.dtype}")
    if values.dtype.kind != "f":
        return values.astype(np.int64) * scale
    with np.errstate(over="ignore", invalid="ignore"):
        nanoseconds = values.astype(np.float64) * scale
        known = np.abs(nanoseconds) < np.iinfo(np.int64).max
    return np.where(known, np.rint(np.where(known, nanoseconds, 0.0)).astype(np.int64), _NO_TIME)


def _onward(
    buffer: _core.Buffer, points: Any, target: str, fixed: str, at: StampLike | None
) -> tuple[tuple[float, float, float, float, float, float, float], int | None]:
    """From the fixed frame to the target, and the stamp that the result has if that is another one."""
    if fixed == target:
        return IDENTITY, None if at is None else stamp_ns(at)
    if at is None:
        if not layout.is_message(points):
            raise TypeError(f"deskew() needs at=...: the time at which {target!r} is meant")
        at = stamp_of(points)
    transform = buffer.lookup(target, fixed, at)
    return transform.values, transform.stamp


def _deskew_fields(buffer: _core.Buffer, fixed: str, source: str, arguments: tuple[Any, ...]) -> None:
    stamps, *_, nan_for_none, _ = arguments
    for _attempt in range(_ATTEMPTS):
        missing, first = _core.deskew_fields(buffer, fixed, source, *arguments)
        if missing == 0 or (nan_for_none and missing < len(stamps)):
            return
        try:
            buffer.lookup(fixed, source, int(stamps[first]))  # says why; unless it has come in between
        except TransformException as error:
            raise _of_point(error, first, stamps) from error
    raise TransformException(f"the transforms from {source!r} to {fixed!r} change faster than points can be deskewed")


def _of_point(error: TransformException, point: int, stamps: NDArray[np.int64]) -> TransformException:
    return type(error).with_details(
        f"point {point} of {len(stamps)}, measured at {int(stamps[point])} ns: {error}",
        target=error.target,
        source=error.source,
        requested=error.requested,
        earliest=error.earliest,
        latest=error.latest,
        edge=error.edge,
        hint=error.hint,
    )
