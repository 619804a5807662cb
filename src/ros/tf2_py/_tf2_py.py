# SPDX-License-Identifier: Apache-2.0
"""tf2's `BufferCore` on coframe's native buffer."""

import sys
from typing import Any

from coframe import _core
from coframe.buffer.buffer import Buffer
from coframe.errors import (
    ConnectivityException,
    ExtrapolationException,
    InvalidArgumentException,
    LookupException,
    TimeoutException,
    TransformException,
)
from geometry_msgs.msg import TransformStamped
from rclpy.duration import Duration
from rclpy.time import Time
from tf2_py import _convert
from tf2_py._message import any_time, transform_stamped
from tf2_py._velocity import TrackedPoint, Vector, lookup_velocity

__all__ = [
    "BufferCore",
    "ConnectivityException",
    "ExtrapolationException",
    "InvalidArgumentException",
    "LookupException",
    "TimeoutException",
    "TransformException",
]

# This is the name of tf2's native module, so that tracebacks contain `tf2.LookupException: ...` as upstream.
for _exception in (
    TransformException,
    LookupException,
    ConnectivityException,
    ExtrapolationException,
    InvalidArgumentException,
    TimeoutException,
):
    _exception.__module__ = "tf2"

# Result of an insertion without problems.
_STORED = 0
# Prefixes of console_bridge, which Humble writes to stderr.
_LOG_PREFIX = {"error": "Error:   ", "warning": "Warning: "}
_TEN_SECONDS = Duration(seconds=10)
_NO_TIME = Time()


class BufferCore:
    """Buffer that stores the transforms of the last seconds and answers lookups.

    It has the names, arguments and messages of ROS 2's `tf2_py.BufferCore`. Times and durations are objects of rclpy or
    messages. Time zero requests the latest transform. Lookups raise subclasses of `TransformException`.
    """

    __module__ = "_tf2"  # The module name of upstream's class.

    def __init__(self, cache_time: Any = _TEN_SECONDS, /, **_ignored: Any) -> None:
        """Create an empty buffer.

        Args:
            cache_time: Duration for which transforms are kept, relative to the latest one.
            **_ignored: Ignored, because tf2's native type silently ignores keyword arguments.
        """
        # Programs subclass BufferCore, so the prefix avoids collisions with their attributes.
        # A Duration, because coframe refuses an int of a few nanoseconds.
        self._Coframe__buffer = Buffer(Duration(nanoseconds=_convert.nanoseconds(cache_time, "duration")))

    def set_transform(self, transform: Any, authority: str, /) -> None:
        """Insert a dynamic transform. Rejected data are reported on stderr, as in tf2.

        Args:
            transform: A `geometry_msgs/TransformStamped`, or an object with the same attributes.
            authority: Name of the publisher of the transform.
        """
        self.__insert(transform, authority, static=False)

    def set_transform_static(self, transform: Any, authority: str, /) -> None:
        """Insert a static transform. Rejected data are reported on stderr, as in tf2."""
        self.__insert(transform, authority, static=True)

    def __insert(self, transform: Any, authority: str, *, static: bool) -> None:
        refused = self._Coframe__buffer._set_message(transform, static, authority)
        if refused == _STORED:
            return
        authority = _convert.text(authority, 2)
        parent = _convert.frame_id(transform.header.frame_id, "header.frame_id")
        child = _convert.frame_id(transform.child_frame_id, "child_frame_id")
        stamp = _convert.nanoseconds(transform.header.stamp, "time")
        pose = _convert.values(transform.transform, static=static)
        try:
            if refused is None:
                refused = self._Coframe__buffer._set_values(parent, child, stamp, *pose, static, authority)
        except TypeError:
            raise TypeError(f"translation and rotation must be numbers, but are {pose!r}.") from None
        if refused:
            for level, text in _core.insert_texts(refused, parent, child, stamp, *pose, authority):
                sys.stderr.write(f"{_LOG_PREFIX[level]}{text}\n")

    def can_transform_core(self, target_frame: str, source_frame: str, time: Any) -> tuple[int, str]:
        """Return 1 and an empty string if the lookup would succeed, otherwise 0 and the reason."""
        query = _convert.text(target_frame, 1), _convert.text(source_frame, 2), _convert.nanoseconds(time, "time")
        if self._Coframe__buffer.can_transform(*query):
            return 1, ""
        reason = self._Coframe__buffer._why_not(*query)
        return int(not reason), reason

    def can_transform_full_core(
        self, target_frame: str, target_time: Any, source_frame: str, source_time: Any, fixed_frame: str
    ) -> tuple[int, str]:
        """Return 1 and an empty string if `lookup_transform_full_core` would succeed, otherwise 0 and the reason."""
        reason = self._Coframe__buffer._why_not_full(
            *_convert.full_query(target_frame, target_time, source_frame, source_time, fixed_frame)
        )
        return int(not reason), reason

    def lookup_transform_core(self, target_frame: str, source_frame: str, time: Any) -> TransformStamped:
        """Return the transform that transforms data from `source_frame` into `target_frame` at a time.

        Raises:
            TransformException: The transform is not available. The subclass and the message are the same as in tf2.
        """
        found: TransformStamped | None = self._Coframe__buffer._lookup_message(target_frame, source_frame, time)
        if found is not None:
            return found
        return self._Coframe__lookup(
            _convert.text(target_frame, 1), _convert.text(source_frame, 2), _convert.nanoseconds(time, "time")
        )

    def _Coframe__lookup(self, target: str, source: str, stamp: int, wait: int | None = None) -> TransformStamped:
        found = self._Coframe__buffer.lookup(target, source, stamp, timeout=wait)
        return transform_stamped(target, source, found.stamp or 0, found.values)

    def lookup_transform_full_core(
        self, target_frame: str, target_time: Any, source_frame: str, source_time: Any, fixed_frame: str
    ) -> TransformStamped:
        """Return the transform from `source_frame` at one time into `target_frame` at another time.

        The data do not move relative to `fixed_frame` between the two times.

        Raises:
            TransformException: The transform is not available. The subclass and the message are the same as in tf2.
        """
        return self._Coframe__lookup_full(
            _convert.full_query(target_frame, target_time, source_frame, source_time, fixed_frame)
        )

    def _Coframe__lookup_full(self, query: tuple[str, int, str, int, str], wait: int | None = None) -> TransformStamped:
        found = self._Coframe__buffer._lookup_full(*query, timeout=wait)
        return transform_stamped(query[0], query[2], found.stamp or 0, found.values)

    def get_latest_common_time(self, target_frame: str, source_frame: str, /) -> Time:
        """Return the latest time at which all dynamic transforms between the frames are available, 0 if all are static.

        Raises:
            TransformException: The frames are not connected, or a frame does not exist (`LookupException`).
        """
        return any_time(
            self._Coframe__buffer.latest_common_time(_convert.text(target_frame, 1), _convert.text(source_frame, 2))
        )

    def lookupVelocityCore(
        self, tracking_frame: str, observation_frame: str, time: Any, averaging_interval: Any
    ) -> tuple[Vector, Vector]:
        """Return the linear (m/s) and angular (rad/s) velocity of the tracking frame in the observation frame."""
        tracking, observation = _convert.text(tracking_frame, 1), _convert.text(observation_frame, 2)
        return lookup_velocity(
            self._Coframe__buffer,
            TrackedPoint(tracking, (0.0, 0.0, 0.0), tracking),
            observation,
            observation,
            stamp=_convert.nanoseconds(time, "time"),
            interval=_convert.nanoseconds(averaging_interval, "duration"),
        )

    def lookupVelocityFullCore(
        self,
        tracking_frame: str,
        observation_frame: str,
        reference_frame: str,
        reference_point: tuple[float, float, float],
        reference_point_frame: str,
        time: Any,
        averaging_interval: Any,
        /,
    ) -> tuple[Vector, Vector]:
        """Return the velocity of a point that is fixed to the tracking frame, expressed in the reference frame."""
        x, y, z = reference_point
        point = (float(x), float(y), float(z))
        return lookup_velocity(
            self._Coframe__buffer,
            TrackedPoint(_convert.text(tracking_frame, 1), point, _convert.text(reference_point_frame, 5)),
            _convert.text(observation_frame, 2),
            _convert.text(reference_frame, 3),
            stamp=_convert.nanoseconds(time, "time"),
            interval=_convert.nanoseconds(averaging_interval, "duration"),
        )

    def all_frames_as_yaml(self, *_ignored: Any) -> str:
        """Return a YAML block per frame with a parent: its broadcaster, rate and time range."""
        return self._Coframe__buffer.all_frames_as_yaml()

    def all_frames_as_string(self, *_ignored: Any) -> str:
        """Return a line of text per frame with a parent."""
        return self._Coframe__buffer.all_frames_as_string()

    def _allFramesAsDot(self, time: Any = _NO_TIME) -> str:
        return self._Coframe__buffer.all_frames_as_dot(_convert.nanoseconds(time, "time"))

    def _chain(
        self, target_frame: str, target_time: Any, source_frame: str, source_time: Any, fixed_frame: str
    ) -> list[str]:
        return self._Coframe__buffer.chain(
            *_convert.full_query(target_frame, target_time, source_frame, source_time, fixed_frame)
        )

    def _frameExists(self, frame: str, /) -> bool:
        # tf2's table of frame names contains the parent of all roots.
        return _convert.text(frame, 1) == "NO_PARENT" or self._Coframe__buffer.frame_exists(frame)

    def _getFrameStrings(self) -> list[str]:
        return self._Coframe__buffer.frame_names()

    def clear(self) -> None:
        """Remove all dynamic transforms. Frame names and static transforms are kept."""
        self._Coframe__buffer.clear()
