"""Futures that complete when a buffer learns the transform they wait for, whoever tells it."""

# rclpy and tf2_ros use each other's private members.
# ruff: noqa: SLF001

from collections.abc import Callable
from typing import TYPE_CHECKING

from geometry_msgs.msg import TransformStamped
from rclpy.task import Future
from tf2_py import TransformException

if TYPE_CHECKING:
    from coframe import Transform
    from coframe.dispatcher import Dispatcher, StartWait

LookUp = Callable[[], TransformStamped]
Convert = Callable[["Transform"], TransformStamped]


class _WaitFuture(Future[TransformStamped]):
    """A future that takes its wait out of the buffer when it is given up."""

    def __init__(self) -> None:
        super().__init__()
        self._end_wait: Callable[[], object] = lambda: None

    def cancel(self) -> None:
        super().cancel()
        self._end_wait()


def wait(
    dispatcher: "Dispatcher", start: "StartWait", convert: Convert, look_up: LookUp, timeout: int | None = None
) -> Future[TransformStamped]:
    """A future of the message that `convert` makes of the answer, once the buffer has it.

    Transforms that Python inserts complete it in the inserting thread, before the insertion returns; those that
    arrive from the wire, and the end of the time, in a thread of the buffer's.

    Args:
        dispatcher: The buffer's.
        start: Begins the native wait.
        convert: From a transform to its message.
        look_up: Tells by its exception what is missing when the time is over.
        timeout: Nanoseconds; None waits for ever.
    """
    future = _WaitFuture()

    def end(found: "Transform | None") -> None:
        if future.done() or future.cancelled():
            return
        try:
            result = look_up() if found is None else convert(found)
        except TransformException as error:
            future.set_exception(error)
        else:
            future.set_result(result)

    future._end_wait = dispatcher.wait(start, end, timeout)
    return future
