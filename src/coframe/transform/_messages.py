# SPDX-License-Identifier: Apache-2.0
"""Poses in ROS messages, found by the names of their fields, regardless of which program created the classes.

A pose has the fields position and orientation, or translation and rotation. The message is searched level by level; the
first level with a pose counts. The nearest header around it has the frame and the stamp, `child_frame_id` next to that
header the posed frame, and `covariance` next to the pose its covariance.
"""

from __future__ import annotations

import copy
import importlib
import sys
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import coframe.lazy_numpy as np
from coframe.errors import FrameMismatchException
from coframe.time import SECOND, stamp_ns

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.quaternion import Array
    from coframe.transform.transform import Transform

_LINEAR_AND_ANGULAR = (("position", "orientation"), ("translation", "rotation"))
# Levels of nested messages that are searched; Odometry's pose is at the second.
_MAX_LEVELS = 4
# Lists of poses, which are empty in a default message.
_POSE_LISTS = ("poses", "transforms")
_EACH_ELEMENT = "[]"


@dataclass
class MessagePose:
    """A pose in a message and what is known about it.

    Attributes:
        translation: Position, an object with x, y, z.
        rotation: Quaternion, an object with x, y, z, w.
        headers: The headers around it, the nearest first.
        child: The posed frame, or "" if the message does not name it.
        covariance: 36 numbers next to the pose, or None if there are none.
    """

    translation: Any
    rotation: Any
    headers: tuple[Any, ...] = ()
    child: str = ""
    covariance: Any = None

    @property
    def frame(self) -> str:
        """The frame that the pose is expressed in, or "" if the message does not name it."""
        return next((header.frame_id for header in self.headers if header.frame_id), "")

    @property
    def stamp(self) -> int | None:
        """The stamp of the nearest header in nanoseconds."""
        return stamp_ns(self.headers[0].stamp) if self.headers else None

    def values(self) -> list[float]:
        """Return x, y, z, qx, qy, qz, qw."""
        t, q = self.translation, self.rotation
        return [t.x, t.y, t.z, q.x, q.y, q.z, q.w]

    def write(self, values: Any) -> None:
        """Set x, y, z, qx, qy, qz, qw."""
        for place, axes, numbers in ((self.translation, "xyz", values[:3]), (self.rotation, "xyzw", values[3:])):
            for axis, number in zip(axes, numbers, strict=True):
                setattr(place, axis, float(number))


@dataclass(frozen=True)
class Contents:
    """The poses of a message: one, or a list of them."""

    poses: list[MessagePose]
    is_list: bool

    @property
    def frame(self) -> str | None:
        """The frame that all poses are expressed in, or None if the message does not name it.

        Raises:
            FrameMismatchException: There are several.
        """
        return self._common_frame({pose.frame for pose in self.poses})

    @property
    def child(self) -> str | None:
        """The posed frame, or None if the message does not name it.

        Raises:
            FrameMismatchException: There are several.
        """
        return self._common_frame({pose.child for pose in self.poses})

    @property
    def covariance(self) -> Array | None:
        """The covariances, shape (36,) or (N, 36), or None if all are zero, which means unknown."""
        found = [pose.covariance for pose in self.poses]
        if not found or any(each is None for each in found):
            return None
        array = np.array(found, dtype=np.float64)
        return (array if self.is_list else array[0]) if array.any() else None

    def _common_frame(self, names: set[str]) -> str | None:
        known = sorted(names - {""})
        if len(known) > 1:
            raise FrameMismatchException.with_details(
                f"the message contains poses of several frames: {', '.join(known)}",
                target=known[0],
                source=known[1],
                hint="Convert them one by one, such as [Transform(each) for each in message.transforms].",
            )
        return known[0] if known else None


def is_message(value: Any) -> bool:
    """Return whether a value is a message: of a ROS, or of a library that reads recordings."""
    return hasattr(value, "get_fields_and_field_types") or bool(_names(value)) or _pose_fields(value) is not None


def unwrap_message(value: Any) -> Any:
    """Return the message itself if this is a message of a recording, which also has a topic."""
    inner = getattr(value, "message", None)
    return inner if hasattr(inner, "get_fields_and_field_types") and not hasattr(value, "header") else value


def contents(message: Any) -> Contents:
    """Return the poses of a message.

    Raises:
        ValueError: It contains none, or several fields with a pose.
    """
    message = unwrap_message(message)
    paths = _paths(message)
    if len(paths) > 1:
        names = ", ".join(_text(path) for path in paths)
        example = _text(paths[0]).replace(_EACH_ELEMENT, "[0]")
        raise ValueError(f"{_name(message)} contains several poses: {names}. Pass one of them: message.{example}.")
    if not paths:
        empty = next((name for name in _POSE_LISTS if hasattr(message, name)), None)
        if empty is None:
            raise ValueError(
                f"{_name(message)} contains no pose. A pose has the fields position and orientation, or translation "
                "and rotation. transform.transform_point(point) transforms a point."
            )
        return Contents([], is_list=True)
    path = paths[0]
    return Contents(list(_poses_along(message, path, (), "", None)), is_list=_EACH_ELEMENT in path)


def fill_message(message_type: type, transform: Transform, frame: str | None, stamp: int | None) -> Any:
    """Return a new message with the poses of a transform.

    Raises:
        TypeError: The type is not a message class.
        ValueError: It has no place for a pose, or not for a batch.
    """
    if not isinstance(message_type, type):
        raise TypeError(
            f"to_msg() takes a message class, such as geometry_msgs.msg.PoseStamped, not {message_type!r}. "
            'coframe.messages.find("geometry_msgs/msg/PoseStamped") returns the class of a name.'
        )
    message = message_type()
    rows = np.asarray(transform)
    places = _fill_list(message, transform) if rows.ndim > 1 or not _paths(message) else contents(message)
    for header in _headers(message, places):
        header.frame_id = frame or ""
    covariance = None if transform.covariance is None else transform.covariance.reshape(-1, 36)
    stamps = np.broadcast_to(np.zeros(1) if stamp is None else stamp, len(places.poses))
    if stamp is None and transform.stamps is not None:
        stamps = transform.stamps
    set_stamp = stamp is not None or transform.stamps is not None
    for i, (place, row) in enumerate(zip(places.poses, rows.reshape(-1, 7), strict=True)):
        place.write(row)
        if covariance is not None and place.covariance is not None:
            _assign_numbers(place.covariance, covariance[i])
        if set_stamp and place.headers:
            # One header for all poses has the stamp of the first.
            if i == 0 or place.headers[0] is not places.poses[0].headers[0]:
                _set_stamp(place.headers[0].stamp, int(stamps[i]))
            if i == 0:
                _set_stamp(place.headers[-1].stamp, int(stamps[i]))
    for holder in _messages_with_child(message):
        holder.child_frame_id = transform.source or ""
    return message


def transform_message(transform: Transform, message: Any, pose_of: Any) -> Any:
    """Return a copy of a message whose poses are transformed.

    Raises:
        FrameMismatchException: The frame of the message is not the source of the transform.
        ValueError: It contains no pose, or the transform is a batch.
    """
    if transform.shape:
        raise ValueError(
            f"`batch @ {type(message).__name__}` is not defined. Use one transform of the batch, or "
            "batch @ Transform(message)."
        )
    message = unwrap_message(message)
    result = copy.deepcopy(message)
    found = contents(result)
    frame = found.frame
    if frame is not None and transform.source is not None and frame != transform.source:
        raise FrameMismatchException.with_details(
            f"cannot transform {_name(message)} in {frame!r} with {transform.target or '?'} <- {transform.source}",
            target=transform.target,
            source=frame,
            hint=f"The message must be expressed in {transform.source!r}. Does the transform need inverse()?",
        )
    product = transform @ pose_of(message)
    rows = np.asarray(product).reshape(-1, 7)
    covariance = None if product.covariance is None else product.covariance.reshape(-1, 36)
    for i, place in enumerate(found.poses):
        place.write(rows[i])
        if covariance is not None and place.covariance is not None:
            _assign_numbers(place.covariance, covariance[i])
    for header in _headers(result, found):
        header.frame_id = transform.target or header.frame_id
    return result


def _pose_fields(value: Any) -> tuple[Any, Any] | None:
    """Return the position and the orientation of a pose, or None for other values."""
    for linear, angular in _LINEAR_AND_ANGULAR:
        p, q = getattr(value, linear, None), getattr(value, angular, None)
        if hasattr(p, "x") and hasattr(p, "z") and hasattr(q, "x") and hasattr(q, "w"):
            return p, q
    return None


def _names(message: Any) -> list[str]:
    """Return the names of the fields of a message; none for other values."""
    if hasattr(message, "get_fields_and_field_types"):
        return list(message.get_fields_and_field_types())
    names: Any = getattr(message, "__dataclass_fields__", None) or getattr(type(message), "__slots__", ())
    return [name for name in names if isinstance(name, str) and not name.startswith("_")]


def _paths(message: Any) -> list[tuple[str, ...]]:
    """Return the ways from a message to its poses, at the first level that has any."""
    level: list[tuple[tuple[str, ...], Any]] = [((), message)]
    for _ in range(_MAX_LEVELS + 1):
        found = [path for path, value in level if _pose_fields(value) is not None]
        if found:
            return found
        below = []
        for path, value in level:
            for name in _names(value):
                field = getattr(value, name)
                if isinstance(field, list | tuple):
                    if field and is_message(field[0]):
                        below.append(((*path, name, _EACH_ELEMENT), field[0]))
                elif is_message(field):
                    below.append(((*path, name), field))
        level = below
    return []


def _poses_along(
    value: Any, path: tuple[str, ...], headers: tuple[Any, ...], child: str, covariance: Any
) -> Iterator[MessagePose]:
    """Yield the poses at the end of a path."""
    header = getattr(value, "header", None)
    if hasattr(header, "frame_id"):
        headers = (header, *headers)
    child = getattr(value, "child_frame_id", "") or child
    covariance = getattr(value, "covariance", covariance)
    if not path:
        position, orientation = _pose_fields(value) or (None, None)
        yield MessagePose(position, orientation, headers, child, covariance)
    elif path[0] == _EACH_ELEMENT:
        for each in value:
            yield from _poses_along(each, path[1:], headers, child, covariance)
    else:
        yield from _poses_along(getattr(value, path[0]), path[1:], headers, child, covariance)


def _fill_list(message: Any, transform: Transform) -> Contents:
    """Fill the list of a new message with default poses, and return their places.

    Raises:
        ValueError: The message has no list of poses.
    """
    name = next((name for name in _POSE_LISTS if isinstance(getattr(message, name, None), list | tuple)), None)
    if name is None:
        raise ValueError(
            f"{_name(message)} cannot contain a batch of shape {transform.shape}. Convert one by one, or to "
            "PoseArray or Path."
        )
    declared = message.get_fields_and_field_types()[name]  # sequence<geometry_msgs/Pose>
    package, _, item = declared.partition("<")[2].rstrip(">").replace("/msg/", "/").partition("/")
    module = sys.modules.get(f"{package}.msg") or importlib.import_module(f"{package}.msg")
    item_type = getattr(module, item)
    setattr(message, name, [item_type() for _ in range(int(np.prod(transform.shape)))])
    return contents(message)


def _headers(message: Any, contents: Contents) -> list[Any]:
    headers = [header for pose in contents.poses for header in pose.headers]
    if hasattr(getattr(message, "header", None), "frame_id"):
        headers.append(message.header)
    return list({id(header): header for header in headers}.values())


def _messages_with_child(message: Any) -> list[Any]:
    """Return the messages with a child frame: this one, or those in its list."""
    lists = [getattr(message, name, ()) for name in _POSE_LISTS]
    return [each for each in (message, *(part for parts in lists for part in parts)) if hasattr(each, "child_frame_id")]


def _set_stamp(stamp: Any, nanoseconds: int) -> None:
    stamp.sec, stamp.nanosec = divmod(nanoseconds, SECOND)


def _assign_numbers(place: Any, numbers: Array) -> None:
    place[:] = numbers


def _name(message: Any) -> str:
    module = type(message).__module__.split(".")[0]
    return f"{module}/{type(message).__name__}"


def _text(path: tuple[str, ...]) -> str:
    return ".".join(path).replace("." + _EACH_ELEMENT, _EACH_ELEMENT)
