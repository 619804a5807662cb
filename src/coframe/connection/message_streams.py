# SPDX-License-Identifier: Apache-2.0
"""Publishers and subscriptions of messages of one class, for threads and for asyncio."""

from __future__ import annotations

import contextlib
import logging
import threading
import time
from typing import TYPE_CHECKING, Generic, TypeVar

from coframe.errors import DecodeError
from coframe.time import SECOND, duration_ns
from coframe.wire.counted_warning import CountedWarning
from coframe.wire.names import any_ros_name

if TYPE_CHECKING:
    import asyncio
    from collections.abc import AsyncIterator, Callable, Iterator

    from coframe import _core
    from coframe.messages.message import Message
    from coframe.time import DurationLike
    from coframe.wire.endpoints import Publisher, Subscription

__all__ = ["MessagePublisher", "MessageSubscription"]

_logger = logging.getLogger("coframe.wire")

M = TypeVar("M", bound="Message")


class MessagePublisher(Generic[M]):
    """A publisher of messages of one class. Created by `Connection.publisher`."""

    def __init__(self, publisher: Publisher, message_type: type[M]) -> None:
        self._publisher = publisher
        self._message_type = message_type

    @property
    def matched(self) -> int:
        """The number of matched subscriptions."""
        return self._publisher.matched

    def publish(self, message: M) -> None:
        """Publish a message.

        Raises:
            TypeError: The message is not of the publisher's class.
            WireError: The connection is closed, or a reliable subscription has not kept up for one second.
        """
        if not isinstance(message, self._message_type):
            expected = self._message_type.__name__
            topic = any_ros_name(self._publisher.topic)
            raise TypeError(f"cannot publish {type(message).__name__} on {topic}: expected {expected}")
        from coframe.messages.codec import serialize  # noqa: PLC0415 - `import coframe` must be cheap

        self._publisher.write(serialize(message))

    def close(self) -> None:
        """Close the publisher."""
        self._publisher.close()


class MessageSubscription(Generic[M]):
    """A subscription to messages of one class. Created by `Connection.subscribe`.

    If there is a callback, it is called with each message on a thread of this subscription. Otherwise, call `receive`
    or iterate over the subscription; in asyncio, await `receive_async` or use ``async for``. The ways cannot be mixed.
    """

    def __init__(
        self,
        subscription: Subscription,
        message_type: type[M],
        event: _core.Event,
        callback: Callable[[M], None] | None,
    ) -> None:
        self._subscription = subscription
        self._message_type = message_type
        self._event = event
        self._callback = callback
        self._warn_of_damage = CountedWarning(_logger.warning)
        self._waiters = _LoopWaiters()
        self._lock = threading.Lock()
        self._thread: threading.Thread | None = None
        if callback:
            self._start(self._call)

    @property
    def matched(self) -> int:
        """The number of matched publishers."""
        return self._subscription.matched

    def receive(self, timeout: DurationLike | None = None) -> M | None:
        """Wait for the next message and return it, or None after the timeout or if the subscription is closed.

        Args:
            timeout: How long to wait, such as "100ms". If None, wait without a limit.

        Raises:
            DecodeError: The received bytes are not a message of the announced type.
        """
        deadline = None if timeout is None else time.monotonic_ns() + duration_ns(timeout)
        while True:
            if (message := self._take()) is not None:
                return message
            left = None if deadline is None else deadline - time.monotonic_ns()
            if self._subscription.closed or (left is not None and left <= 0):
                return None
            self._event.wait(left)

    async def receive_async(self, timeout: DurationLike | None = None) -> M | None:
        """Wait for the next message in asyncio, where other tasks run in the meantime.

        Args:
            timeout: How long to wait, such as "100ms". If None, wait without a limit.

        Returns:
            The message, or None after the timeout or if the subscription is closed.

        Raises:
            DecodeError: The received bytes are not a message of the announced type.
        """
        self._start(self._wake_waiters)
        deadline = None if timeout is None else time.monotonic_ns() + duration_ns(timeout)
        while True:
            # Registered before the message is taken, so that none arrives unnoticed between the two.
            with self._waiters.register_waiter() as waiter:
                if (message := self._take()) is not None:
                    return message
                left = None if deadline is None else deadline - time.monotonic_ns()
                if self._subscription.closed or (left is not None and left <= 0):
                    return None
                await _wait_for_result(waiter, left)

    def __iter__(self) -> Iterator[M]:
        while (message := self.receive()) is not None:
            yield message

    async def __aiter__(self) -> AsyncIterator[M]:
        while (message := await self.receive_async()) is not None:
            yield message

    def close(self) -> None:
        """Close the subscription and stop its thread."""
        self._subscription.close()
        self._event.set()
        if self._thread and self._thread is not threading.current_thread():
            self._thread.join()
        self._waiters.wake_waiters()

    def _take(self) -> M | None:
        """Return the next message that has arrived, or None if there is none."""
        from coframe.messages.codec import deserialize  # noqa: PLC0415 - `import coframe` must be cheap

        # Messages are taken one by one, so that a message that cannot be decoded does not discard others.
        for sample in self._subscription.take(1):
            return deserialize(sample.data, self._message_type)
        return None

    def _start(self, target: Callable[[], None]) -> None:
        """Start the thread of this subscription, unless it runs."""
        with self._lock:
            if self._thread is None:
                name = f"coframe{any_ros_name(self._subscription.topic)}"
                self._thread = threading.Thread(target=target, name=name, daemon=True)
                self._thread.start()

    def _wake_waiters(self) -> None:
        while not self._subscription.closed:
            self._event.wait(None)
            self._waiters.wake_waiters()

    def _call(self) -> None:
        while not self._subscription.closed:
            self._call_once()

    def _call_once(self) -> None:
        topic = any_ros_name(self._subscription.topic)
        try:
            message = self.receive()
        except DecodeError as error:
            self._warn_of_damage(f"A message on {topic} is ignored: {error}.")
            return
        if message is not None and self._callback:
            try:
                self._callback(message)
            except Exception:
                _logger.exception("The callback for messages on %s failed.", topic)


class _LoopWaiters:
    """Futures of event loops that any thread can complete together."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._futures: list[asyncio.Future[None]] = []

    @contextlib.contextmanager
    def register_waiter(self) -> Iterator[asyncio.Future[None]]:
        """Create a future of the running event loop that the next `wake_waiters` completes."""
        import asyncio  # noqa: PLC0415 - asyncio takes as long to import as all of coframe, and few programs need it

        future: asyncio.Future[None] = asyncio.get_running_loop().create_future()
        with self._lock:
            self._futures.append(future)
        try:
            yield future
        finally:
            with self._lock, contextlib.suppress(ValueError):
                self._futures.remove(future)

    def wake_waiters(self) -> None:
        with self._lock:
            futures, self._futures = self._futures, []
        for future in futures:
            with contextlib.suppress(RuntimeError):  # the event loop is closed
                future.get_loop().call_soon_threadsafe(_complete, future)


def _complete(future: asyncio.Future[None]) -> None:
    if not future.done():
        future.set_result(None)


async def _wait_for_result(future: asyncio.Future[None], timeout_ns: int | None) -> None:
    """Wait until a future is completed, or for a time."""
    import asyncio  # noqa: PLC0415

    await asyncio.wait([future], timeout=None if timeout_ns is None else timeout_ns / SECOND)
