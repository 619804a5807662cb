# SPDX-License-Identifier: Apache-2.0
"""Transform buffer of nodes."""

# The unused names are imported because programs import them from upstream's module.
import threading  # noqa: F401
from copy import deepcopy  # noqa: F401
from time import sleep  # noqa: F401
from typing import Any, Callable, List, Optional, Tuple, TypeVar, Union  # noqa: F401, UP035

import builtin_interfaces  # noqa: F401
import rclpy  # noqa: F401
import tf2_py as tf2
import tf2_ros  # noqa: F401
from builtin_interfaces.msg import Time as TimeMessage
from coframe import _core
from coframe.time import MIN_INT_NANOSECONDS
from geometry_msgs.msg import TransformStamped
from rclpy.clock import Clock, JumpThreshold, TimeJump
from rclpy.duration import Duration
from rclpy.logging import get_logger
from rclpy.node import Node
from rclpy.task import Future  # noqa: TC001 - programs import names of this module, too
from rclpy.time import Time
from tf2_msgs.srv import FrameGraph
from tf2_py import _convert
from tf2_py._message import transform_stamped
from tf2_ros import _transform_futures
from tf2_ros.buffer_interface import BufferInterface

FrameGraphSrvRequest = TypeVar("FrameGraphSrvRequest")
FrameGraphSrvResponse = TypeVar("FrameGraphSrvResponse")

_NO_WAIT = Duration()


class Buffer(tf2.BufferCore, BufferInterface):
    """Buffer that stores the transforms of the last seconds and answers lookups.

    Lookups with a `timeout` also work in callbacks, because a `TransformListener` inserts transforms without the
    executor.
    """

    def __init__(self, cache_time: Duration | None = None, node: Node | None = None) -> None:
        """Create an empty buffer.

        Args:
            cache_time: Duration for which transforms are kept, relative to the latest one. Default: 10 s.
            node: Node for the service `tf2_frames`, which returns the tree, and whose clock clears the buffer when it
                jumps back. None: no service, and the system clock.
        """
        if cache_time is None:
            tf2.BufferCore.__init__(self)
        else:
            tf2.BufferCore.__init__(self, cache_time)
        BufferInterface.__init__(self)
        if node is None:
            self.clock = Clock()
        else:
            self.srv = node.create_service(FrameGraph, "tf2_frames", self.__describe_frames)
            self.clock = node.get_clock()
        self.jump_handle = clear_on_time_jump(self, self.clock)

    def time_jump_callback(self, time_jump: TimeJump) -> None:
        """Clear the buffer after a backward jump of the clock."""
        del time_jump
        text = "Detected jump back in time. Clearing tf buffer."
        get_logger("tf2_buffer").warning(text, throttle_duration_sec=1.0)
        self.clear()

    def __describe_frames(self, request: Any, response: Any) -> Any:
        del request
        response.frame_yaml = self.all_frames_as_yaml()
        return response

    def set_transform(self, transform: TransformStamped, authority: str) -> None:
        """Insert a dynamic transform.

        Args:
            transform: The transform to insert.
            authority: Name of the publisher of the transform.
        """
        with self._Coframe__buffer._dispatcher.inserting():
            super().set_transform(transform, authority)

    def set_transform_static(self, transform: TransformStamped, authority: str) -> None:
        """Insert a static transform.

        Args:
            transform: The transform to insert.
            authority: Name of the publisher of the transform.
        """
        with self._Coframe__buffer._dispatcher.inserting():
            super().set_transform_static(transform, authority)

    def lookup_transform(
        self, target_frame: str, source_frame: str, time: Time | TimeMessage, timeout: Duration = _NO_WAIT
    ) -> TransformStamped:
        """Return the transform that transforms data from `source_frame` into `target_frame`.

        Args:
            target_frame: Frame to transform data into.
            source_frame: Frame in which the data are expressed.
            time: Time of the transform. Zero requests the latest transform.
            timeout: Maximum time to wait for the transform.

        Raises:
            TransformException: The transform is not available. The subclass and the message give the reason.
        """
        target, source = _convert.text(target_frame, 1), _convert.text(source_frame, 2)
        return self._Coframe__lookup(target, source, _convert.nanoseconds(time, "time"), _wait(timeout))

    def lookup_transform_full(
        self,
        target_frame: str,
        target_time: Time | TimeMessage,
        source_frame: str,
        source_time: Time | TimeMessage,
        fixed_frame: str,
        timeout: Duration = _NO_WAIT,
    ) -> TransformStamped:
        """Return the transform from `source_frame` at one time into `target_frame` at another time.

        Args:
            target_frame: Frame to transform data into.
            target_time: Time of the target frame.
            source_frame: Frame in which the data are expressed.
            source_time: Time of the data.
            fixed_frame: Frame that does not move between the two times.
            timeout: Maximum time to wait for the transform.

        Raises:
            TransformException: The transform is not available. The subclass and the message give the reason.
        """
        query = _convert.full_query(target_frame, target_time, source_frame, source_time, fixed_frame)
        return self._Coframe__lookup_full(query, _wait(timeout))

    async def lookup_transform_async(
        self,
        target_frame: str,
        source_frame: str,
        time: Time | TimeMessage,
        *,
        timeout: Duration | None = None,
    ) -> TransformStamped:
        """Look up a transform in a coroutine like `lookup_transform`, and wait for it without limit by default."""
        found = await self.wait_for_transform_async(target_frame, source_frame, time, timeout=timeout)
        # A cancelled wait returns None. The lookup then raises an exception that describes what is missing.
        return found or self.lookup_transform(target_frame, source_frame, time)

    async def lookup_transform_full_async(
        self,
        target_frame: str,
        target_time: Time | TimeMessage,
        source_frame: str,
        source_time: Time | TimeMessage,
        fixed_frame: str,
        *,
        timeout: Duration | None = None,
    ) -> TransformStamped:
        """Look up a transform in a coroutine like `lookup_transform_full`, and wait for it without limit by default."""
        query = (target_frame, target_time, source_frame, source_time, fixed_frame)
        found = await self.wait_for_transform_full_async(*query, timeout=timeout)
        return found or self.lookup_transform_full(*query)

    def can_transform(
        self,
        target_frame: str,
        source_frame: str,
        time: Time | TimeMessage,
        timeout: Duration = _NO_WAIT,
        return_debug_tuple: bool = False,
    ) -> int | tuple[int, str]:
        """Return 1 if `lookup_transform` would succeed, otherwise 0, optionally with the reason as a tuple."""
        stamp, wait = _convert.nanoseconds(time, "time"), _wait(timeout)
        if wait is not None:
            target, source = _convert.text(target_frame, 1), _convert.text(source_frame, 2)
            self._Coframe__buffer.can_transform(target, source, stamp, timeout=wait)
        answer = self.can_transform_core(target_frame, source_frame, time)
        return answer if return_debug_tuple else answer[0]

    def can_transform_full(
        self,
        target_frame: str,
        target_time: Time | TimeMessage,
        source_frame: str,
        source_time: Time | TimeMessage,
        fixed_frame: str,
        timeout: Duration = _NO_WAIT,
        return_debug_tuple: bool = False,
    ) -> int | tuple[int, str]:
        """Return 1 if `lookup_transform_full` would succeed, otherwise 0, optionally with the reason as a tuple."""
        query = (target_frame, target_time, source_frame, source_time, fixed_frame)
        wait = _wait(timeout)
        if wait is not None:
            self._Coframe__buffer._can_transform_full(*_convert.full_query(*query), timeout=wait)
        answer = self.can_transform_full_core(*query)
        return answer if return_debug_tuple else answer[0]

    def wait_for_transform_async(
        self,
        target_frame: str,
        source_frame: str,
        time: Time | TimeMessage,
        *,
        timeout: Duration | None = None,
    ) -> "Future[TransformStamped]":
        """Return a future of a transform. After a timeout, it raises the exception of the lookup."""
        target, source = _convert.text(target_frame, 1), _convert.text(source_frame, 2)
        stamp = _convert.nanoseconds(time, "time")
        return _transform_futures.wait(
            self._Coframe__buffer._dispatcher,
            lambda mailbox, token: _core.wait(self._Coframe__buffer, mailbox, token, target, source, stamp),
            lambda found: transform_stamped(target, source, found.stamp or 0, found.values),
            lambda: self._Coframe__lookup(target, source, stamp),
            _limit(timeout),
        )

    def wait_for_transform_full_async(
        self,
        target_frame: str,
        target_time: Time | TimeMessage,
        source_frame: str,
        source_time: Time | TimeMessage,
        fixed_frame: str,
        *,
        timeout: Duration | None = None,
    ) -> "Future[TransformStamped]":
        """Return a future of a transform between two times; otherwise like `wait_for_transform_async`."""
        query = _convert.full_query(target_frame, target_time, source_frame, source_time, fixed_frame)
        return _transform_futures.wait(
            self._Coframe__buffer._dispatcher,
            lambda mailbox, token: _core.wait_full(self._Coframe__buffer, mailbox, token, *query),
            lambda found: transform_stamped(query[0], query[2], found.stamp or 0, found.values),
            lambda: self._Coframe__lookup_full(query),
            _limit(timeout),
        )


def clear_on_time_jump(buffer: Buffer, clock: Clock) -> Any:
    """Clear a buffer when a clock jumps back or changes its source, as long as the returned handle is kept."""
    threshold = JumpThreshold(min_forward=None, min_backward=Duration(seconds=-1), on_clock_change=True)
    return clock.create_jump_callback(threshold, post_callback=buffer.time_jump_callback)


def _wait(timeout: Duration) -> int | None:
    """Return the nanoseconds to wait, or None for no wait; at least 100 us, because coframe rejects smaller ints."""
    nanoseconds = _nanoseconds(timeout)
    return max(nanoseconds, MIN_INT_NANOSECONDS) if nanoseconds > 0 else nanoseconds or None


def _limit(timeout: Duration | None) -> int | None:
    return None if timeout is None else _nanoseconds(timeout)


def _nanoseconds(timeout: Duration) -> int:
    if not isinstance(timeout, Duration):
        given = timeout if isinstance(timeout, (int, float)) else "..."
        raise TypeError(
            f"timeout must be an rclpy Duration, not {type(timeout).__name__}. Use Duration(seconds={given})."
        )
    return timeout.nanoseconds
