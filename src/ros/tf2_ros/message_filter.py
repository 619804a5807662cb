"""Letting messages through once their frame can be transformed."""

import inspect
import threading
import time
import traceback
import weakref
from collections.abc import Callable, Iterable
from functools import partial
from typing import Any, NamedTuple

from builtin_interfaces.msg import Time as TimeMessage
from rclpy.callback_groups import CallbackGroup
from rclpy.duration import Duration
from rclpy.logging import get_logger
from rclpy.node import Node
from rclpy.qos import QoSProfile
from rclpy.subscription import Subscription
from rclpy.task import Future
from tf2_py import ExtrapolationException, InvalidArgumentException, TransformException, _convert
from tf2_ros._message_queue import FilterFailureReason, FilterStatistics, MessageQueue, Outcome, Waiting
from tf2_ros.buffer import Buffer

__all__ = ["FilterFailureReason", "FilterStatistics", "MessageFilter"]

# That messages are dropped is told at once, and then this often at most.
_WARNING_PERIOD = 10 * _convert.NANOSECONDS_PER_SECOND


class _Lack(NamedTuple):
    """A transform that a message needs and the buffer has not; with a reason if it will never have it."""

    target: str
    time: TimeMessage
    error: TransformException
    reason: FilterFailureReason | None


class MessageFilter:
    """Keeps messages until they can be transformed, and says why when it gives one up.

    A sensor's message nearly always arrives before the transforms of its moment do. A filter calls back with it as
    soon as its `header.frame_id` can be transformed to all target frames at `header.stamp`: a look-up in the callback
    then succeeds at once. A stamp of zero asks for the latest transform, as in look-ups. A slash before the name of a
    frame is taken off, as in C++.

    Each message goes as soon as its own transforms are there and waits for no other, as in C++. Messages of one frame
    that the same transform lets through go in the order in which they came, if their stamps are in that order.

    With a node, callbacks run where that node is spun, as those of its subscriptions do: they may be coroutine
    functions, and what they raise is raised by `spin`. Without a node they run in the thread that brought the message
    or the transform, never two at a time, and what they raise is printed. No lock is held meanwhile.

    A message whose transform cannot come any more is dropped at once: where the buffer has only newer ones
    (OutTheBack), or where the frame's name is none. Waiting costs no polling, and its time is that of a steady clock,
    also where a simulation drives the node's. (C++ takes the node's clock, and drops only what is older than the
    buffer's cache time at once.)

    Attributes:
        node: The node whose executor runs the callbacks, or None.
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
        """Create a filter; it takes messages in from now on.

        Args:
            subscriber: Where messages come from: (message class, topic, QoS profile or depth), for which the filter
                makes a subscription of `node`; or anything with a method `registerCallback(callback)`, such as a
                subscriber of message_filters or another filter; or None, if somebody calls `add()`.
            buffer: Where the transforms are.
            target_frames: The frame, or the frames, to which a message must be transformable.
            queue_size: How many messages may wait for transforms; 0: any number. One more, and the oldest is dropped.
            node: Its executor runs the callbacks.
            buffer_timeout: How long a message may wait; None: until newer ones push it out of the queue.
            callback_group: Of the callbacks and the subscription; None: the node's default group.

        Raises:
            TypeError: The subscriber is none of the above or its messages have no header, a topic or a callback group
                is given without a node, or another argument is of a wrong type.
            ValueError: There is no target frame, or the queue's size is negative.
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
        self._delivering = threading.Lock()
        self._quiet_until = 0
        self._guard = None
        if node is not None:
            self._guard = node.create_guard_condition(self._deliver_one, callback_group)
        elif callback_group is not None:
            raise TypeError("a callback group is of use to a node only: give node=..., too")
        self._subscription = self._connect(subscriber, callback_group)

    def registerCallback(self, callback: Callable[..., Any], *args: Any) -> None:
        """Call `callback(message, *args)` with each message that can be transformed.

        Several callbacks get a message one after the other; if one raises, those after it do not get it.

        Raises:
            TypeError: It is not callable, or is a coroutine function and there is no node to run it.
        """
        self._check(callback)
        self._callbacks.append(lambda message: callback(message, *args))

    def register_failure_callback(self, callback: Callable[..., Any]) -> None:
        """Call `callback(message, reason, explanation)` with each message that is dropped.

        `reason` is a FilterFailureReason, and `explanation` a sentence about what was missing; a callback with two
        parameters does without it.

        Raises:
            TypeError: As for `registerCallback`.
        """
        self._check(callback)
        wants_explanation = _takes_three(callback)
        self._failure_callbacks.append(
            callback if wants_explanation else lambda message, reason, _: callback(message, reason)
        )

    registerFailureCallback = register_failure_callback

    def add(self, message: Any) -> None:
        """Take a message in, as if it had come from the subscriber; in any thread.

        Raises:
            TypeError: It has no header with a frame_id and a stamp.
        """
        frame, stamp = _frame_and_stamp(message)
        deadline = None if self._timeout is None else time.monotonic_ns() + self._timeout
        waiting = self._queue.enter(message, frame, stamp, deadline)
        if waiting is None:
            return
        if not frame:
            explanation = "its header names no frame: whoever publishes it has to set header.frame_id"
            self._drop(waiting, FilterFailureReason.EmptyFrameID, explanation)
            return
        self._pursue(waiting)
        self._make_room()

    def clear(self) -> None:
        """Forget the messages that wait; no callback is told of them."""
        self._queue.clear()

    def destroy(self) -> None:
        """Forget the messages that wait, and take no more in; doing so twice does no harm."""
        self._queue.close()
        if self.node is not None and self._subscription is not None:
            self.node.destroy_subscription(self._subscription)
        if self.node is not None and self._guard is not None:
            self.node.destroy_guard_condition(self._guard)

    def set_target_frame(self, target_frame: str) -> None:
        """Ask for this one target frame from now on; see `set_target_frames`."""
        self.set_target_frames([target_frame])

    def set_target_frames(self, target_frames: str | Iterable[str]) -> None:
        """Ask for these target frames from now on, also for messages that wait already.

        Raises:
            TypeError: A name is no text.
            ValueError: There is none.
        """
        self._targets = _frames(target_frames)
        self._pursue_all()

    def get_target_frames_string(self) -> str:
        """The target frames, with spaces between them."""
        return " ".join(self._targets)

    def set_tolerance(self, tolerance: Duration) -> None:
        """Ask for the transforms at stamp + `tolerance`, too, from now on, also for messages that wait already.

        That is for what takes time, such as the sweep of a lidar: its frame moves while the message is recorded.
        Messages with a stamp of zero are not concerned.
        """
        self._tolerance = _nanoseconds(tolerance, "tolerance")
        self._pursue_all()

    @property
    def queue_size(self) -> int:
        """How many messages may wait for transforms; 0: any number."""
        return self._queue_size

    @queue_size.setter
    def queue_size(self, size: int) -> None:
        self._queue_size = _size(size)
        self._make_room()

    @property
    def statistics(self) -> FilterStatistics:
        """What became of the messages so far."""
        return self._queue.statistics()

    # Where messages come from

    def _connect(self, subscriber: Any, callback_group: CallbackGroup | None) -> Subscription | None:
        if subscriber is None:
            return None
        if hasattr(subscriber, "registerCallback"):
            subscriber.registerCallback(self.add)
            return None
        message_type, topic, qos = _topic(subscriber)
        if self.node is None:
            raise TypeError(f"the subscription to {topic!r} needs a node: give node=..., or call add() with messages")
        return self.node.create_subscription(message_type, topic, self.add, qos, callback_group=callback_group)

    # Waiting for transforms

    def _pursue(self, waiting: Waiting) -> None:
        """Let a message out or drop it, if either can be said already; else wait for what it lacks."""
        lack = self._lack(waiting)
        if lack is None:
            for elder in self._queue.elders(waiting):
                self._settle(elder)
            self._release(waiting)
        elif lack.reason is not None:
            self._drop(waiting, lack.reason, _explain(lack.error))
        else:
            self._wait_for(lack, waiting)

    def _pursue_all(self) -> None:
        for waiting in self._queue.all():
            self._pursue(waiting)

    def _settle(self, waiting: Waiting, otherwise: FilterFailureReason | None = None) -> None:
        """Let a message out or drop it, if either can be said already; else drop it for the reason given, if any."""
        lack = self._lack(waiting)
        if lack is None:
            self._release(waiting)
        elif (reason := lack.reason or otherwise) is not None:
            self._drop(waiting, reason, _explain(lack.error))

    def _make_room(self) -> None:
        while self._queue_size and (oldest := self._queue.oldest_beyond(self._queue_size)) is not None:
            self._settle(oldest, otherwise=FilterFailureReason.QueueFull)

    def _lack(self, waiting: Waiting) -> _Lack | None:
        """A transform that it lacks, preferably one that it will lack for ever; None if it lacks none."""
        times = [_time(waiting.stamp)]
        if self._tolerance and waiting.stamp:
            times.append(_time(waiting.stamp + self._tolerance))
        first = None
        for target in self._targets:
            for when in times:
                try:
                    self._buffer.lookup_transform_core(target, waiting.frame, when)
                except TransformException as error:
                    lack = _Lack(target, when, error, _hopeless(error))
                    if lack.reason is not None:
                        return lack
                    first = first or lack
        return first

    def _wait_for(self, lack: _Lack, waiting: Waiting) -> None:
        timeout = None
        if waiting.deadline is not None:
            timeout = Duration(nanoseconds=max(0, waiting.deadline - time.monotonic_ns()))
        future = self._buffer.wait_for_transform_async(lack.target, waiting.frame, lack.time, timeout=timeout)
        self._queue.wait_for(waiting, future)
        # The buffer keeps the future, which must keep neither the message nor a filter that nobody wants any more.
        future.add_done_callback(partial(_answer, weakref.ref(self), waiting.number))

    def _on_answer(self, number: int, future: Future[Any]) -> None:
        """Go on with a message whose transform has come, or whose time is over."""
        is_late = future.exception() is not None
        waiting = self._queue.waits_for(number, future)
        if waiting is None:
            return
        if future.cancelled():
            self._drop(waiting, FilterFailureReason.Unknown, "somebody cancelled the wait for its transform")
        elif is_late:
            self._settle(waiting, otherwise=FilterFailureReason.TimedOut)
        else:
            self._pursue(waiting)

    def _release(self, waiting: Waiting) -> None:
        if self._queue.leave(waiting):
            self._deliver()

    def _drop(self, waiting: Waiting, reason: FilterFailureReason, explanation: str) -> None:
        if self._queue.leave(waiting, reason, explanation):
            self._warn(waiting, reason, explanation)
            self._deliver()

    def _warn(self, waiting: Waiting, reason: FilterFailureReason, explanation: str) -> None:
        now = time.monotonic_ns()
        if now < self._quiet_until:
            return
        self._quiet_until = now + _WARNING_PERIOD
        received, _, dropped, _, still_waiting = self.statistics
        share = 100.0 * sum(dropped.values()) / max(1, received - still_waiting)
        counts = ", ".join(f"{reason.name}: {count}" for reason, count in dropped.items() if count)
        text = (
            f"MessageFilter [target={self.get_target_frames_string()}]: Dropped {share:.2f}% of messages so far "
            f"({counts}). The last one, of frame '{waiting.frame}' at {waiting.stamp / 1e9:.6f}: {reason.name}, "
            f"{explanation}"
        )
        logger = get_logger("tf2_ros_message_filter") if self.node is None else self.node.get_logger()
        logger.warning(text)

    # Calling back

    def _deliver(self) -> None:
        if self._guard is not None:
            self._guard.trigger()
        else:
            self._deliver_all()

    async def _deliver_one(self) -> None:
        """In the executor: one message a turn, so that other callbacks get theirs in between."""
        outcome = self._queue.take()
        if self._guard is not None and self._queue.has_outcomes():
            self._guard.trigger()
        if outcome is None:
            return
        for result in self._call_back(outcome):
            if inspect.isawaitable(result):
                await result

    def _deliver_all(self) -> None:
        """Without an executor: in this thread, unless another one is at it already."""
        # Nobody waits for this lock: who has it goes on until nothing is left, for all.
        while self._queue.has_outcomes() and self._delivering.acquire(blocking=False):
            try:
                while (outcome := self._queue.take()) is not None:
                    self._call_back_safely(outcome)
            finally:
                self._delivering.release()

    def _call_back(self, outcome: Outcome) -> Iterable[Any]:
        """Call the callbacks, one for each step of the iteration."""
        if outcome.reason is None:
            return (callback(outcome.message) for callback in self._callbacks)
        reason = outcome.reason
        return (callback(outcome.message, reason, outcome.explanation) for callback in self._failure_callbacks)

    def _call_back_safely(self, outcome: Outcome) -> None:
        try:
            for _ in self._call_back(outcome):
                pass
        except Exception:  # noqa: BLE001 - the thread may be anybody's, and more messages may wait
            traceback.print_exc()

    def _check(self, callback: object) -> None:
        if not callable(callback):
            raise TypeError(f"the callback must be a function, not {callback!r}: give it without () behind its name")
        if self.node is None and inspect.iscoroutinefunction(callback):
            raise TypeError("a coroutine function needs a node whose executor runs it: give the filter node=...")


def _answer(reference: weakref.ref[MessageFilter], number: int, future: Future[Any]) -> None:
    message_filter = reference()
    if message_filter is not None:
        message_filter._on_answer(number, future)  # noqa: SLF001 - a method that does not keep its object


def _hopeless(error: TransformException) -> FilterFailureReason | None:
    """Why a transform will never come; None if it may."""
    if isinstance(error, InvalidArgumentException):
        return FilterFailureReason.NoTransformFound
    if isinstance(error, ExtrapolationException) and error.requested is not None and error.earliest is not None:
        return FilterFailureReason.OutTheBack if error.requested < error.earliest else None
    return None


def _explain(error: TransformException) -> str:
    return f"{error} {error.hint}".strip()


_NO_HEADER = (
    "has no header with a frame_id and a stamp, so nobody knows where and when it was: a MessageFilter takes stamped "
    "messages, for example PointStamped instead of Point"
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
            "subscriber must be (message class, topic, QoS profile or depth), or have a method registerCallback, or be "
            f"None for a filter that is fed with add(): {subscriber!r} is none of these"
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
        raise ValueError("a MessageFilter needs at least one target frame")
    return tuple(_without_slash(_convert.frame_id(name, "a target frame")) for name in names)


def _without_slash(frame: str) -> str:
    return frame.removeprefix("/")


def _size(queue_size: int) -> int:
    if not isinstance(queue_size, int):
        raise TypeError(f"queue_size must be an int, not {type(queue_size).__name__}")
    if queue_size < 0:
        raise ValueError(f"queue_size must not be negative, but is {queue_size}: 0 lets any number of messages wait")
    return queue_size


def _nanoseconds(duration: Duration, what: str) -> int:
    if not isinstance(duration, Duration):
        raise TypeError(f"{what} must be an rclpy Duration, not {type(duration).__name__}: Duration(seconds=...)")
    return duration.nanoseconds


def _time(nanoseconds: int) -> TimeMessage:
    sec, nanosec = divmod(nanoseconds, _convert.NANOSECONDS_PER_SECOND)
    return TimeMessage(sec=sec, nanosec=nanosec)


def _takes_three(callback: Callable[..., Any]) -> bool:
    try:
        inspect.signature(callback).bind(None, None, None)
    except TypeError:
        return False
    except ValueError:  # some built-in functions have no signature
        return True
    return True
