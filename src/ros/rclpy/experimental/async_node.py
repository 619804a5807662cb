# SPDX-License-Identifier: Apache-2.0
"""A node whose callbacks run in an asyncio event loop, without an executor."""

# The modules of rclpy share attributes named `_Coframe__x`, the form of mangled names.
# ruff: noqa: SLF001

from __future__ import annotations

import asyncio
import inspect
import threading
from typing import TYPE_CHECKING, Any, Final

from rclpy.action import ActionClient, ActionServer
from rclpy.callback_groups import CallbackGroup, MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.client import Client
from rclpy.clock import ROSClock
from rclpy.constants import S_TO_NS
from rclpy.exceptions import InvalidHandle, NotInitializedException
from rclpy.node import Node
from rclpy.qos import qos_profile_services_default

if TYPE_CHECKING:
    from collections.abc import Awaitable, Callable

    from typing_extensions import Self

    from rclpy.executors import Executor, ExecutorEntity
    from rclpy.publisher import Publisher
    from rclpy.qos import QoSProfile
    from rclpy.service import Service
    from rclpy.subscription import Subscription
    from rclpy.subscription_content_filter_options import ContentFilterOptions
    from rclpy.timer import Timer

__all__ = ["AsyncActionClient", "AsyncClient", "AsyncClock", "AsyncNode"]

_TaskGroup: Any = getattr(asyncio, "TaskGroup", None)  # since Python 3.11
# Items that one entity handles before the others get their turn.
_BATCH: Final = 20
_POLL_S: Final = 0.02  # of conditions that wake no node


class AsyncClient(Client):
    """A service client whose methods are awaited. Create it with `AsyncNode.create_client`."""

    async def call(self, request: Any) -> Any:  # type: ignore[override] # as upstream
        """Send a request and return its response. `asyncio.timeout` limits the time.

        Raises:
            TypeError: `request` is not a request of the service's type.
            WireError: The request was not sent, because the middleware of the servers sends requests in another form.
            DecodeError: The response is invalid.
        """
        return await self.call_async(request)

    async def wait_for_service(self, timeout_sec: float | None = None) -> bool:  # type: ignore[override] # as upstream
        """Wait until a server is available, and return whether there is one in time.

        Args:
            timeout_sec: Maximum time to wait in seconds. None: no limit.
        """
        return await _wait_until(self.service_is_ready, timeout_sec)


class AsyncActionClient(ActionClient):
    """An action client whose methods are awaited. Create it with `AsyncNode.create_action_client`."""

    async def send_goal(self, goal: Any, **kwargs: Any) -> Any:
        """Send a goal and return its result: a response with `status` and `result`, or None if it was rejected.

        Args:
            goal: Goal to send.
            **kwargs: Keyword arguments of `send_goal_async`.

        Raises:
            TypeError: `goal` is not a goal of the action's type.
        """
        handle = await self.send_goal_async(goal, **kwargs)
        return await handle.get_result_async() if handle is not None and handle.accepted else None

    async def wait_for_server(self, timeout_sec: float | None = None) -> bool:  # type: ignore[override]
        """Wait until a server is available, and return whether there is one in time.

        Args:
            timeout_sec: Maximum time to wait in seconds. None: no limit.
        """
        return await _wait_until(self.server_is_ready, timeout_sec)


class AsyncClock(ROSClock):
    """The clock of an `AsyncNode`."""

    def __init__(self) -> None:
        super().__init__()
        self._Coframe__next_turn: Callable[[], Awaitable[None]] | None = None

    async def sleep(self, seconds: float) -> None:
        """Sleep until the clock has advanced by a number of seconds: simulated ones if `use_sim_time` is true."""
        end = self._Coframe__now_ns() + int(seconds * S_TO_NS)
        while (remaining := end - self._Coframe__now_ns()) > 0:
            if self._Coframe__is_simulated and self._Coframe__next_turn is not None:
                await self._Coframe__next_turn()
            else:
                await asyncio.sleep(remaining / S_TO_NS)


class AsyncNode(Node):
    """A node for asyncio: its callbacks, which may be coroutine functions, run in the event loop.

    ::

        async with AsyncNode("talker") as node:
            publisher = node.create_publisher(String, "chatter", 10)
            while True:
                publisher.publish(String(data="hello"))
                await node.get_clock().sleep(1.0)

    The callbacks run inside the block, or while `run()` is awaited. At its end, callbacks that still run are cancelled
    and the node is destroyed. An exception of a callback ends the block with an `ExceptionGroup`.

    The arguments are those of `rclpy.node.Node`. Python 3.11 or later is required.

    Raises:
        RuntimeError: Python is older.
    """

    _Coframe__client_class = AsyncClient
    _Coframe__clock_class = AsyncClock

    def __init__(self, node_name: str, **options: Any) -> None:
        if _TaskGroup is None:
            raise RuntimeError("AsyncNode needs Python 3.11 or later. Use Node and an executor instead.")
        self.__tasks: Any = None
        self.__busy: set[ExecutorEntity] = set()  # whose callback runs, and which may not run another one
        self.__wake = asyncio.Event()
        self.__turns: list[asyncio.Future[None]] = []
        self.__running: set[asyncio.Task[Any]] = set()
        self.__stopped = False
        self.__dispatcher: asyncio.Task[None] | None = None
        self.__thread: threading.Thread | None = None
        super().__init__(node_name, **options)
        clock = self.get_clock()
        if isinstance(clock, AsyncClock):
            clock._Coframe__next_turn = self.__next_turn

    # Life

    async def __aenter__(self) -> Self:
        if self._Coframe__entities.is_destroyed:
            raise RuntimeError("Node has been destroyed and cannot be reentered")
        if self.__tasks is not None:
            raise RuntimeError("Node is already running")
        if not self.context.ok():
            raise NotInitializedException("cannot run node")
        self.__tasks = _TaskGroup()
        await self.__tasks.__aenter__()
        loop = asyncio.get_running_loop()
        self.__thread = threading.Thread(target=self.__watch, args=(loop,), name="rclpy-async", daemon=True)
        self.__thread.start()
        self.__dispatcher = self.__tasks.create_task(self.__dispatch())
        return self

    async def __aexit__(self, *error: object) -> None:
        tasks = self.__tasks
        assert tasks is not None, "the block was not entered"
        self.__stopped = True
        self.context._Coframe__wakeup.set()
        for task in {*self.__running, self.__dispatcher}:
            if task is not None:
                task.cancel()
        try:
            await tasks.__aexit__(*error)
        finally:
            if self.__thread is not None:
                self.__thread.join()
            self.destroy_node()

    async def run(self) -> None:
        """Run the callbacks until the task is cancelled or the context is shut down, and destroy the node.

        Raises:
            RuntimeError: The node runs already, or was destroyed.
        """
        async with self:
            while self.context.ok():
                await self.__next_turn()

    @property
    def executor(self) -> Executor | None:
        """None: the event loop runs the callbacks."""
        return None

    @executor.setter
    def executor(self, new_executor: Executor | None) -> None:
        if new_executor is not None:
            new_executor.remove_node(self)
            raise RuntimeError("An AsyncNode runs in an event loop, not in an executor. Use `await node.run()`.")

    def __watch(self, loop: asyncio.AbstractEventLoop) -> None:
        """Wake the event loop whenever an entity may be ready. This runs in a dedicated thread."""
        wakeup = self.context._Coframe__wakeup
        seen = wakeup.count
        while not self.__stopped:
            try:
                loop.call_soon_threadsafe(self.__wake.set)
            except RuntimeError:  # The loop was closed.
                return
            wakeup.wait(seen, None)
            seen = wakeup.count

    async def __dispatch(self) -> None:
        loop = asyncio.get_running_loop()
        while self.context.ok():
            self.__wake.clear()
            turns, self.__turns = self.__turns, []
            for turn in turns:
                if not turn.done():
                    turn.set_result(None)
            remaining = self.__run_ready()
            timer = None if remaining is None else loop.call_later(max(remaining, 0) / S_TO_NS, self.__wake.set)
            await self.__wake.wait()
            if timer is not None:
                timer.cancel()
        for turn in self.__turns:
            if not turn.done():
                turn.set_result(None)

    def __run_ready(self) -> int | None:
        """Start the callbacks of ready entities, and return the nanoseconds until the next timer."""
        next_ns: int | None = None
        for entity in self._Coframe__entities.waitables:
            for _ in range(_BATCH):
                if entity in self.__busy:
                    break
                remaining = entity._Coframe__remaining_ns()
                if remaining is None or remaining > 0:
                    break
                if (call := entity._Coframe__take()) is not None:
                    self.__start(entity, call)
            if entity not in self.__busy and (remaining := entity._Coframe__remaining_ns()) is not None:
                next_ns = remaining if next_ns is None else min(next_ns, remaining)
        return next_ns

    def __start(self, entity: ExecutorEntity, call: Callable[[], Any]) -> None:
        result = call()
        if not inspect.isawaitable(result):
            return
        assert self.__tasks is not None
        if not isinstance(entity.callback_group, ReentrantCallbackGroup):
            self.__busy.add(entity)
        task = self.__tasks.create_task(_await(result))
        self.__running.add(task)
        task.add_done_callback(lambda done: self.__on_end(entity, done))

    def __on_end(self, entity: ExecutorEntity, task: asyncio.Task[Any]) -> None:
        self.__running.discard(task)
        self.__busy.discard(entity)
        self.__wake.set()

    async def __next_turn(self) -> None:
        """Wait until the node has looked for ready entities again."""
        turn: asyncio.Future[None] = asyncio.get_running_loop().create_future()
        self.__turns.append(turn)
        await turn

    # Entities

    def create_publisher(
        self, msg_type: type[Any], topic: str, qos_profile: QoSProfile | int, **options: Any
    ) -> Publisher:
        """Create a publisher. See `Node.create_publisher`."""
        self.__check("publisher")
        return super().create_publisher(msg_type, topic, qos_profile, **options)

    def create_subscription(
        self,
        msg_type: type[Any],
        topic: str,
        callback: Callable[..., Any],
        qos_profile: QoSProfile | int,
        *,
        raw: bool = False,
        concurrent: bool = False,
        content_filter_options: ContentFilterOptions | None = None,
        **options: Any,
    ) -> Subscription:
        """Create a subscription. See `Node.create_subscription`.

        Args:
            msg_type: Class of the messages.
            topic: Name of the topic.
            callback: Function or coroutine function that is called with each message.
            qos_profile: QoS profile, or its depth.
            raw: Whether to pass serialized messages to the callback.
            concurrent: Whether a callback can begin while the one of an earlier message awaits something.
            content_filter_options: Condition that messages must meet. None: all messages.
            **options: Other keyword arguments of `Node.create_subscription`.
        """
        self.__check("subscription")
        options.setdefault("callback_group", _group(concurrent=concurrent))
        return super().create_subscription(
            msg_type, topic, callback, qos_profile, raw=raw, content_filter_options=content_filter_options, **options
        )

    def create_service(
        self,
        srv_type: Any,
        srv_name: str,
        callback: Callable[[Any, Any], Any],
        *,
        qos_profile: QoSProfile = qos_profile_services_default,
        concurrent: bool = False,
        callback_group: CallbackGroup | None = None,
    ) -> Service:
        """Create a service. See `Node.create_service`.

        Args:
            srv_type: Class of the service.
            srv_name: Name of the service.
            callback: Function or coroutine function that is called with the request and an empty response, and returns
                the response.
            qos_profile: QoS profile of requests and responses.
            concurrent: Whether a callback can begin while the one of an earlier request awaits something.
            callback_group: Group of the callback; a reentrant one is like `concurrent=True`.
        """
        self.__check("service")
        group = callback_group or _group(concurrent=concurrent)
        return super().create_service(srv_type, srv_name, callback, qos_profile=qos_profile, callback_group=group)

    def create_client(self, srv_type: Any, srv_name: str, **options: Any) -> AsyncClient:
        """Create a service client, whose `call` is awaited. See `Node.create_client`."""
        self.__check("client")
        client: AsyncClient = super().create_client(srv_type, srv_name, **options)  # type: ignore[assignment]
        return client

    def create_timer(self, timer_period_sec: float, callback: Callable[..., Any], *words: Any, **options: Any) -> Timer:
        """Create a timer. See `Node.create_timer`. A period is skipped while the callback of an earlier one runs."""
        self.__check("timer")
        if not words and options.get("callback_group") is None:
            options["callback_group"] = MutuallyExclusiveCallbackGroup()
        return super().create_timer(timer_period_sec, callback, *words, **options)

    def create_action_client(self, action_type: Any, action_name: str, **options: Any) -> AsyncActionClient:
        """Create an action client, whose `send_goal` and `wait_for_server` are awaited. See `ActionClient`."""
        self.__check("action client")
        return AsyncActionClient(self, action_type, action_name, **options)

    def create_action_server(
        self, action_type: Any, action_name: str, execute_callback: Callable[..., Any], **options: Any
    ) -> ActionServer:
        """Create an action server. See `ActionServer`. Goals are executed concurrently."""
        self.__check("action server")
        return ActionServer(self, action_type, action_name, execute_callback, **options)

    async def wait_for_node(  # type: ignore[override] # as upstream
        self, fully_qualified_node_name: str, check_interval: float = 0.1
    ) -> None:
        """Wait until a node is in the graph. `asyncio.timeout` limits the time.

        Args:
            fully_qualified_node_name: Name of the node with its namespace.
            check_interval: Period of the check in seconds.
        """
        name = f"/{fully_qualified_node_name.lstrip('/')}"
        while name not in self.get_fully_qualified_node_names():  # noqa: ASYNC110 - the graph wakes no event of asyncio
            await asyncio.sleep(check_interval)

    def __check(self, kind: str) -> None:
        if self._Coframe__entities.is_destroyed:
            raise InvalidHandle(f"Cannot create {kind} on a destroyed node")


def _group(*, concurrent: bool) -> CallbackGroup:
    return ReentrantCallbackGroup() if concurrent else MutuallyExclusiveCallbackGroup()


async def _await(awaitable: Awaitable[Any]) -> Any:
    return await awaitable


async def _wait_until(condition: Callable[[], bool], timeout_sec: float | None) -> bool:
    loop = asyncio.get_running_loop()
    deadline = None if timeout_sec is None else loop.time() + timeout_sec
    while not condition():
        if deadline is not None and loop.time() >= deadline:
            return False
        await asyncio.sleep(_POLL_S)  # the graph wakes no event of asyncio
    return True
