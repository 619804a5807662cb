# SPDX-License-Identifier: Apache-2.0
"""Futures that complete when a transform becomes available in a buffer."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from geometry_msgs.msg import TransformStamped
from rclpy.task import Future
from tf2_py import TransformException
from tf2_ros._rclpy_side import wake_executors

if TYPE_CHECKING:
    from coframe.buffer.dispatcher import Dispatcher, StartWait
    from coframe.transform.transform import Transform

    _Future = Future[TransformStamped]
else:
    _Future = Future  # Humble's is not generic.

LookUp = Callable[[], TransformStamped]
Convert = Callable[["Transform"], TransformStamped]


class _TransformFuture(_Future):
    """Future that removes its wait from the buffer when it is cancelled."""

    def __init__(self) -> None:
        super().__init__()
        self._end_wait: Callable[[], object] = lambda: None

    def cancel(self) -> None:
        super().cancel()
        self._end_wait()


def wait(
    dispatcher: Dispatcher, start: StartWait, convert: Convert, look_up: LookUp, timeout: int | None = None
) -> Future[TransformStamped]:
    """Return a future of a transform that becomes available in a buffer.

    Transforms inserted from Python complete the future in the inserting thread, before the insertion returns.
    Transforms received from the wire and timeouts complete it in a thread of the buffer.

    Args:
        dispatcher: Dispatcher of the buffer.
        start: Function that starts the native wait.
        convert: Function that converts the transform to the message that is the result.
        look_up: Function that is called after a timeout and whose exception describes what is missing.
        timeout: Timeout in nanoseconds. None: no timeout.
    """
    future = _TransformFuture()

    def complete(found: Transform | None) -> None:
        if future.done() or future.cancelled():
            return
        try:
            result = look_up() if found is None else convert(found)
        except TransformException as error:
            future.set_exception(error)
        else:
            future.set_result(result)
        wake_executors()

    future._end_wait = dispatcher.wait(start, complete, timeout)  # noqa: SLF001 - this module's class
    return future
