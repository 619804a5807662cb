# SPDX-License-Identifier: Apache-2.0
"""Message filter, which passes messages on once their frame can be transformed."""

import inspect
import threading
import time
import traceback
import weakref
from collections.abc import Callable, Iterable
from functools import partial
from typing import Any, NamedTuple

from builtin_interfaces.msg import Time as TimeMessage
from coframe._output.formatting import error_text
from coframe.time import SECOND
from rclpy.callback_groups import CallbackGroup
from rclpy.duration import Duration
from rclpy.logging import get_logger
from rclpy.node import Node
from rclpy.qos import QoSProfile
from rclpy.subscription import Subscription
from rclpy.task import Future  # noqa: TC001 - programs import names of this module, too
from tf2_py import ExtrapolationException, InvalidArgumentException, TransformException, _convert
from tf2_ros._message_queue import FilterFailureReason, FilterStatistics, MessageQueue, Outcome, PendingMessage
from tf2_ros.buffer import Buffer

__all__ = ["FilterFailureReason", "FilterStatistics", "MessageFilter"]

# The first dropped message is reported immediately, later ones at most once per period.
_WARNING_PERIOD = 10 * SECOND


class _MissingTransform(NamedTuple):
    """A transform that a message needs and that is not available, with a reason if it never will be."""

    target: str
    time: TimeMessage
    error: TransformException
    reason: FilterFailureReason | None


class MessageFilter:
    """Filter that holds messages until they can be transformed, and reports why messages are dropped.

    A sensor message nearly always arrives before the transforms for its stamp. The filter calls the callbacks as soon
    as `header.frame_id` can be transformed to all target frames at `header.stamp`, so that a lookup in the callback
    succeeds immediately. A stamp of zero requests the latest transform, as in lookups. A leading slash of a frame name
    is removed, as in C++.

    A message is passed on as soon as its own transforms are available and does not wait for other messages, as in C++.
    Messages of one frame that become transformable at the same time are passed on in the order of their arrival if
    their stamps are in that order.

    With a node, callbacks run in the executor of the node, like those of its subscriptions: they may be coroutine
    functions, and `spin` raises their exceptions. Without a node, they run in the thread that added the message or
    the transform, one at a time, and their exceptions are printed. No lock is held during callbacks.

    A message whose transform can never become available is dropped immediately, because the buffer has only newer
    transforms (OutTheBack) or the frame name is not valid. The filter does not poll. Timeouts are measured in steady
    time, even if a simulator sets the clock of the node. (C++ uses the node's clock, and immediately drops only
    messages that are older than the buffer's cache time.)

    Attributes:
        node: Node whose executor runs the callbacks, or None.
    """

    def __init__(
        self,
        subscriber: Any,
        buffer: Buffer,
        target_frames: str | Iterable[str],
        queue_size: int,
        node: Node | None = None,
        buffer_timeout: Duration | None = None,
        *,
        callback_group: CallbackGroup | None = None,
    ) -> None:
        """Create a filter and start receiving messages.

        Args:
            subscriber: Source of the messages. Either a tuple (message class, topic, QoS profile or depth), for which
                the filter creates a subscription of `node`, or an object with a method `registerCallback(callback)`,
                such as a subscriber of message_filters or another filter, or None if the program calls `add()`.
            buffer: Buffer with the transforms.
            target_frames: Frame or frames to which a message must be transformable.
            queue_size: Maximum number of messages that wait for transforms. If the queue is full, the oldest message is
                dropped. 0: no limit.
            node: Node whose executor runs the callbacks.
            buffer_timeout: Maximum time that a message waits. None: until newer messages displace it from the queue.
            callback_group: Group of the callbacks and the subscription. None: the default group of the node.

        Raises:
            TypeError: The subscriber is not one of the above, its messages have no header, a topic or a callback group
                is given without a node, or another argument has the wrong type.
            ValueError: There is no target frame, or the queue size is negative.
        """
        self.node = node
        self._buffer = buffer
        self._targets = _frames(target_frames)
        self._queue_size = _size(queue_size)
        self._timeout = None if buffer_timeout is None else _nanoseconds(buffer_timeout, "buffer_timeout")
        self._tolerance = 0
        self._queue = MessageQueue()
        self._callbacks: list[Callable[[Any], Any]] = []
        self._failure_callbacks: list[Callable[[Any, FilterFailureReason, str], Any]] = []
        self._delivery_lock = threading.Lock()
        self._next_warning_ns = 0
        self._guard = None
        if node is not None:
            self._guard = node.create_guard_condition(self._deliver_one, callback_group)
        elif callback_group is not None:
            raise TypeError("A callback group requires a node. Pass node=... as well.")
        self._subscription = self._connect(subscriber, callback_group)

    def registerCallback(self, callback: Callable[..., Any], *args: Any) -> None:
        """Register `callback(message, *args)` for the messages that can be transformed.

        Several callbacks are called one after another. If one raises an exception, the callbacks after it are skipped.

        Raises:
            TypeError: The callback is not callable, or it is a coroutine function and the filter has no node.
        """
        self._check(callback)
        self._callbacks.append(lambda message: callback(message, *args))

    def register_failure_callback(self, callback: Callable[..., Any]) -> None:
        """Register `callback(message, reason, explanation)` for dropped messages.

        `reason` is a FilterFailureReason, and `explanation` is a string that describes the missing transform. It is
        omitted for a callback with two parameters.

        Raises:
            TypeError: The callback is not callable, or it is a coroutine function and the filter has no node.
        """
        self._check(callback)
        accepts_explanation = _takes_three(callback)
        self._failure_callbacks.append(
            callback if accepts_explanation else lambda message, reason, _: callback(message, reason)
        )

    registerFailureCallback = register_failure_callback

    def add(self, message: Any) -> None:
        """Add a message as if the subscriber had received it. This may be called from any thread.

        Raises:
            TypeError: The message has no header with a frame_id and a stamp.
        """
        frame, stamp = _frame_and_stamp(message)
        deadline = None if self._timeout is None else time.monotonic_ns() + self._timeout
        pending = self._queue.add(message, frame, stamp, deadline)
        if pending is None:
            return
        if not frame:
            explanation = "the frame_id of its header is empty. Set header.frame_id in the publisher."
            self._drop(pending, FilterFailureReason.EmptyFrameID, explanation)
            return
        self._process(pending)
        self._limit_queue()

    def clear(self) -> None:
        """Remove the waiting messages without calling a callback."""
        self._queue.clear()

    def destroy(self) -> None:
        """Remove the waiting messages and accept no new ones. Repeated calls have no effect."""
        self._queue.close()
        if self.node is not None and self._subscription is not None:
            self.node.destroy_subscription(self._subscription)
        if self.node is not None and self._guard is not None:
            self.node.destroy_guard_condition(self._guard)

    def set_target_frame(self, target_frame: str) -> None:
        """Replace the target frames by a single frame. See `set_target_frames`."""
        self.set_target_frames([target_frame])

    def set_target_frames(self, target_frames: str | Iterable[str]) -> None:
        """Replace the target frames, including those of messages that are already waiting.

        Raises:
            TypeError: A frame name is not a string.
            ValueError: There is no target frame.
        """
        self._targets = _frames(target_frames)
        self._process_all()

    def get_target_frames_string(self) -> str:
        """Return the target frames, separated by spaces."""
        return " ".join(self._targets)

    def set_tolerance(self, tolerance: Duration) -> None:
        """Require the transforms at stamp + `tolerance` as well, including for messages that are waiting already.

        Use this for data with a duration, such as a lidar sweep, during which the frame moves. The tolerance does not
        apply to messages with a stamp of zero.
        """
        self._tolerance = _nanoseconds(tolerance, "tolerance")
        self._process_all()

    @property
    def queue_size(self) -> int:
        """Maximum number of messages that wait for transforms. 0: no limit."""
        return self._queue_size

    @queue_size.setter
    def queue_size(self, size: int) -> None:
        self._queue_size = _size(size)
        self._limit_queue()

    @property
    def statistics(self) -> FilterStatistics:
        """Message counts since the creation of the filter."""
        return self._queue.statistics()

    # Sources of messages

    def _connect(self, subscriber: Any, callback_group: CallbackGroup | None) -> Subscription | None:
        if subscriber is None:
            return None
        if hasattr(subscriber, "registerCallback"):
            subscriber.registerCallback(self.add)
            return None
        message_type, topic, qos = _topic(subscriber)
        if self.node is None:
            raise TypeError(
                f"The subscription to {topic!r} requires a node. Pass node=..., or pass None as the subscriber and "
                "call add() with the messages."
            )
        return self.node.create_subscription(message_type, topic, self.add, qos, callback_group=callback_group)

    # PendingMessage for transforms

    def _process(self, pending: PendingMessage) -> None:
        """Pass or drop a message if this can be decided now; otherwise wait for its missing transform."""
        missing = self._find_missing(pending)
        if missing is None:
            for earlier in self._queue.earlier_of_same_frame(pending):
                self._resolve(earlier)
            self._pass(pending)
        elif missing.reason is not None:
            self._drop(pending, missing.reason, error_text(missing.error))
        else:
            self._wait_for(missing, pending)

    def _process_all(self) -> None:
        for pending in self._queue.all():
            self._process(pending)

    def _resolve(self, pending: PendingMessage, otherwise: FilterFailureReason | None = None) -> None:
        """Pass or drop a message if this can be decided now; otherwise drop it with the given reason, if any."""
        missing = self._find_missing(pending)
        if missing is None:
            self._pass(pending)
        elif (reason := missing.reason or otherwise) is not None:
            self._drop(pending, reason, error_text(missing.error))

    def _limit_queue(self) -> None:
        while self._queue_size and (oldest := self._queue.oldest_if_longer_than(self._queue_size)) is not None:
            self._resolve(oldest, otherwise=FilterFailureReason.QueueFull)

    def _find_missing(self, pending: PendingMessage) -> _MissingTransform | None:
        """Return a missing transform of a message, preferably one that can never become available, or None."""
        times = [_time(pending.stamp)]
        if self._tolerance and pending.stamp:
            times.append(_time(pending.stamp + self._tolerance))
        first = None
        for target in self._targets:
            for when in times:
                try:
                    self._buffer.lookup_transform_core(target, pending.frame, when)
                except TransformException as error:
                    missing = _MissingTransform(target, when, error, _permanent_failure(error))
                    if missing.reason is not None:
                        return missing
                    first = first or missing
        return first

    def _wait_for(self, missing: _MissingTransform, pending: PendingMessage) -> None:
        timeout = None
        if pending.deadline is not None:
            timeout = Duration(nanoseconds=max(0, pending.deadline - time.monotonic_ns()))
        future = self._buffer.wait_for_transform_async(missing.target, pending.frame, missing.time, timeout=timeout)
        self._queue.set_future(pending, future)
        # The buffer refers to the future, which must not keep the message or an unused filter alive.
        future.add_done_callback(partial(_forward_wait_result, weakref.ref(self), pending.number))

    def _on_wait_result(self, number: int, future: "Future[Any]") -> None:
        """Process a message whose transform is available or whose wait has timed out."""
        is_late = future.exception() is not None
        pending = self._queue.pending_for(number, future)
        if pending is None:
            return
        if future.cancelled():
            self._drop(pending, FilterFailureReason.Unknown, "the wait for its transform was cancelled.")
        elif is_late:
            self._resolve(pending, otherwise=FilterFailureReason.TimedOut)
        else:
            self._process(pending)

    def _pass(self, pending: PendingMessage) -> None:
        if self._queue.finish(pending):
            self._deliver()

    def _drop(self, pending: PendingMessage, reason: FilterFailureReason, explanation: str) -> None:
        if self._queue.finish(pending, reason, explanation):
            self._warn(pending, reason, explanation)
            self._deliver()

    def _warn(self, pending: PendingMessage, reason: FilterFailureReason, explanation: str) -> None:
        now = time.monotonic_ns()
        if now < self._next_warning_ns:
            return
        self._next_warning_ns = now + _WARNING_PERIOD
        received, _, dropped, _, still_pending = self.statistics
        share = 100.0 * sum(dropped.values()) / max(1, received - still_pending)
        counts = ", ".join(f"{reason.name}: {count}" for reason, count in dropped.items() if count)
        text = (
            f"MessageFilter [target={self.get_target_frames_string()}]: Dropped {share:.2f}% of messages so far "
            f"({counts}). The last one, of frame '{pending.frame}' at {pending.stamp / SECOND:.6f}: {reason.name}, "
            f"{explanation}"
        )
        logger = get_logger("tf2_ros_message_filter") if self.node is None else self.node.get_logger()
        logger.warning(text)

    # Callbacks

    def _deliver(self) -> None:
        if self._guard is not None:
            self._guard.trigger()
        else:
            self._deliver_all()

    async def _deliver_one(self) -> None:
        """Deliver one message in the executor. Other callbacks run before the next message."""
        outcome = self._queue.take_outcome()
        if self._guard is not None and self._queue.has_outcomes():
            self._guard.trigger()
        if outcome is None:
            return
        for result in self._call_back(outcome):
            if inspect.isawaitable(result):
                await result

    def _deliver_all(self) -> None:
        """Deliver all messages in this thread, unless another thread is delivering them already."""
        # No thread blocks on this lock. The thread that holds it delivers the messages of all threads.
        while self._queue.has_outcomes() and self._delivery_lock.acquire(blocking=False):
            try:
                while (outcome := self._queue.take_outcome()) is not None:
                    self._call_back_safely(outcome)
            finally:
                self._delivery_lock.release()

    def _call_back(self, outcome: Outcome) -> Iterable[Any]:
        """Return an iterator that calls one callback per step."""
        if outcome.reason is None:
            return (callback(outcome.message) for callback in self._callbacks)
        reason = outcome.reason
        return (callback(outcome.message, reason, outcome.explanation) for callback in self._failure_callbacks)

    def _call_back_safely(self, outcome: Outcome) -> None:
        try:
            for _ in self._call_back(outcome):
                pass
        except Exception:  # noqa: BLE001 - The thread may belong to the caller, and more messages may be queued.
            traceback.print_exc()

    def _check(self, callback: object) -> None:
        if not callable(callback):
            raise TypeError(f"The callback must be a function, not {callback!r}. Pass the function without calling it.")
        if self.node is None and inspect.iscoroutinefunction(callback):
            raise TypeError("A coroutine function requires a node whose executor runs it. Pass node=... to the filter.")


def _forward_wait_result(reference: weakref.ref[MessageFilter], number: int, future: "Future[Any]") -> None:
    message_filter = reference()
    if message_filter is not None:
        message_filter._on_wait_result(number, future)  # noqa: SLF001 - A bound method would keep the filter alive.


def _permanent_failure(error: TransformException) -> FilterFailureReason | None:
    """Return why a transform can never become available, or None if it can."""
    if isinstance(error, InvalidArgumentException):
        return FilterFailureReason.NoTransformFound
    if isinstance(error, ExtrapolationException) and error.requested is not None and error.earliest is not None:
        return FilterFailureReason.OutTheBack if error.requested < error.earliest else None
    return None


_NO_HEADER = (
    "has no header with a frame_id and a stamp. A MessageFilter requires stamped messages, for example PointStamped "
    "instead of Point."
)


def _frame_and_stamp(message: Any) -> tuple[str, int]:
    try:
        frame, stamp = message.header.frame_id, message.header.stamp
    except AttributeError:
        raise TypeError(f"{type(message).__name__} {_NO_HEADER}") from None
    return _without_slash(_convert.frame_id(frame, "header.frame_id")), _convert.nanoseconds(stamp, "time")


def _topic(subscriber: Any) -> tuple[type[Any], str, QoSProfile | int]:
    if not isinstance(subscriber, tuple) or len(subscriber) != 3:
        raise TypeError(
            f"Invalid subscriber {subscriber!r}. It must be a tuple (message class, topic, QoS profile or depth), an "
            "object with a method registerCallback, or None for a filter whose messages are added with add()."
        )
    message_type, topic, qos = subscriber
    if hasattr(message_type, "get_fields_and_field_types"):
        fields = message_type.get_fields_and_field_types()
        if fields.get("header") != "std_msgs/Header":
            raise TypeError(f"{message_type.__name__} {_NO_HEADER}")
    return message_type, topic, qos


def _frames(names: str | Iterable[str]) -> tuple[str, ...]:
    names = [names] if isinstance(names, str) else list(names)
    if not names:
        raise ValueError("A MessageFilter requires at least one target frame.")
    return tuple(_without_slash(_convert.frame_id(name, "a target frame")) for name in names)


def _without_slash(frame: str) -> str:
    return frame.removeprefix("/")


def _size(queue_size: int) -> int:
    if not isinstance(queue_size, int):
        raise TypeError(f"queue_size must be an int, not {type(queue_size).__name__}.")
    if queue_size < 0:
        raise ValueError(f"queue_size must not be negative, but is {queue_size}. 0 means no limit.")
    return queue_size


def _nanoseconds(duration: Duration, what: str) -> int:
    if not isinstance(duration, Duration):
        raise TypeError(f"{what} must be an rclpy Duration, not {type(duration).__name__}. Use Duration(seconds=...).")
    return duration.nanoseconds


def _time(nanoseconds: int) -> TimeMessage:
    sec, nanosec = divmod(nanoseconds, SECOND)
    return TimeMessage(sec=sec, nanosec=nanosec)


def _takes_three(callback: Callable[..., Any]) -> bool:
    try:
        inspect.signature(callback).bind(None, None, None)
    except TypeError:
        return False
    except ValueError:  # Some built-in functions have no signature.
        return True
    return True
