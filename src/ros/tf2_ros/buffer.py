"""The buffer of transforms that nodes look up in."""

# What is not used here is here because upstream leaks it.
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
from geometry_msgs.msg import TransformStamped
from rclpy.clock import Clock, JumpThreshold, TimeJump
from rclpy.duration import Duration
from rclpy.logging import get_logger
from rclpy.node import Node
from rclpy.task import Future
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
    """Stores the transforms of the last seconds and answers where frames were, now or then.

    Waiting for a transform (`timeout`) works anywhere, also in a callback: what a `TransformListener` hears arrives
    without the executor.
    """

    def __init__(self, cache_time: Duration | None = None, node: Node | None = None) -> None:
        """Create an empty buffer.

        Args:
            cache_time: How long a transform is kept after newer ones arrived; 10 s by default.
            node: If given, its service `tf2_frames` describes the tree, and jumps of its clock clear the buffer.
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
        """Forget the transforms of a time that is yet to come."""
        del time_jump
        get_logger("tf2_buffer").warning("Detected jump back in time. Clearing tf buffer.")
        self.clear()

    def __describe_frames(self, request: Any, response: Any) -> Any:
        del request
        response.frame_yaml = self.all_frames_as_yaml()
        return response

    def set_transform(self, transform: TransformStamped, authority: str) -> None:
        """Add a transform that changes over time.

        Args:
            transform: The transform.
            authority: Who says so.
        """
        with self._coframe_buffer._dispatcher.inserting():
            super().set_transform(transform, authority)

    def set_transform_static(self, transform: TransformStamped, authority: str) -> None:
        """Add a transform that holds at every time.

        Args:
            transform: The transform.
            authority: Who says so.
        """
        with self._coframe_buffer._dispatcher.inserting():
            super().set_transform_static(transform, authority)

    def lookup_transform(
        self, target_frame: str, source_frame: str, time: Time | TimeMessage, timeout: Duration = _NO_WAIT
    ) -> TransformStamped:
        """The transform that takes data from `source_frame` to `target_frame`.

        Args:
            target_frame: Frame to express data in.
            source_frame: Frame the data are in.
            time: When; time zero asks for the latest.
            timeout: How long to wait for it.

        Raises:
            TransformException: It is not known; one of its children says why.
        """
        target, source = _convert.text(target_frame, 1), _convert.text(source_frame, 2)
        return self._coframe_lookup(target, source, _convert.nanoseconds(time, "time"), _wait(timeout))

    def lookup_transform_full(
        self,
        target_frame: str,
        target_time: Time | TimeMessage,
        source_frame: str,
        source_time: Time | TimeMessage,
        fixed_frame: str,
        timeout: Duration = _NO_WAIT,
    ) -> TransformStamped:
        """The transform from `source_frame` at one time to `target_frame` at another.

        Args:
            target_frame: Frame to express data in.
            target_time: When that frame is looked at.
            source_frame: Frame the data are in.
            source_time: When the data were taken.
            fixed_frame: Frame that stands still between the two times.
            timeout: How long to wait for it.

        Raises:
            TransformException: It is not known; one of its children says why.
        """
        query = _convert.full_query(target_frame, target_time, source_frame, source_time, fixed_frame)
        return self._coframe_lookup_full(query, _wait(timeout))

    async def lookup_transform_async(
        self,
        target_frame: str,
        source_frame: str,
        time: Time | TimeMessage,
        *,
        timeout: Duration | None = None,
    ) -> TransformStamped:
        """`lookup_transform` as a coroutine; waits for ever unless given a timeout."""
        found = await self.wait_for_transform_async(target_frame, source_frame, time, timeout=timeout)
        # Nothing was found if someone cancelled the wait: then the look-up says what is missing.
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
        """`lookup_transform_full` as a coroutine; waits for ever unless given a timeout."""
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
        """Return whether `lookup_transform` would answer: 1 or 0, on request together with the reason why not."""
        stamp, wait = _convert.nanoseconds(time, "time"), _wait(timeout)
        if wait is not None:
            target, source = _convert.text(target_frame, 1), _convert.text(source_frame, 2)
            self._coframe_buffer.can_transform(target, source, stamp, timeout=wait)
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
        """Return whether `lookup_transform_full` would answer: 1 or 0, on request together with the reason why not."""
        query = (target_frame, target_time, source_frame, source_time, fixed_frame)
        wait = _wait(timeout)
        if wait is not None:
            self._coframe_buffer._can_transform_full(*_convert.full_query(*query), timeout=wait)
        answer = self.can_transform_full_core(*query)
        return answer if return_debug_tuple else answer[0]

    def wait_for_transform_async(
        self,
        target_frame: str,
        source_frame: str,
        time: Time | TimeMessage,
        *,
        timeout: Duration | None = None,
    ) -> Future[TransformStamped]:
        """A future of the transform; with a timeout it raises what the look-up raises when the time is over."""
        target, source = _convert.text(target_frame, 1), _convert.text(source_frame, 2)
        stamp = _convert.nanoseconds(time, "time")
        return _transform_futures.wait(
            self._coframe_buffer._dispatcher,
            lambda mailbox, token: _core.wait(self._coframe_buffer, mailbox, token, target, source, stamp),
            lambda found: transform_stamped(target, source, found.stamp or 0, found.values),
            lambda: self._coframe_lookup(target, source, stamp),
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
    ) -> Future[TransformStamped]:
        """The same between two times."""
        query = _convert.full_query(target_frame, target_time, source_frame, source_time, fixed_frame)
        return _transform_futures.wait(
            self._coframe_buffer._dispatcher,
            lambda mailbox, token: _core.wait_full(self._coframe_buffer, mailbox, token, *query),
            lambda found: transform_stamped(query[0], query[2], found.stamp or 0, found.values),
            lambda: self._coframe_lookup_full(query),
            _limit(timeout),
        )


def clear_on_time_jump(buffer: Buffer, clock: Clock) -> Any:
    """Clear a buffer when a clock jumps back or changes; returns the handle to keep as long as it shall hold."""
    threshold = JumpThreshold(min_forward=None, min_backward=Duration(seconds=-1), on_clock_change=True)
    return clock.create_jump_callback(threshold, post_callback=buffer.time_jump_callback)


def _wait(timeout: Duration) -> int | None:
    """Nanoseconds to wait; None for not at all."""
    return _nanoseconds(timeout) or None


def _limit(timeout: Duration | None) -> int | None:
    return None if timeout is None else _nanoseconds(timeout)


def _nanoseconds(timeout: Duration) -> int:
    if not isinstance(timeout, Duration):
        given = timeout if isinstance(timeout, (int, float)) else "..."
        raise TypeError(f"timeout must be an rclpy Duration, not {type(timeout).__name__}: Duration(seconds={given})")
    return timeout.nanoseconds
