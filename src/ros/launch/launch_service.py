# SPDX-License-Identifier: Apache-2.0
"""The event loop of a launched system."""

from __future__ import annotations

import asyncio
import contextlib
import os
import signal
import threading
import traceback
from typing import TYPE_CHECKING, Any

import launch.logging
from coframe._process.signal_handlers import SignalHandlers
from launch.event_handlers import OnIncludeLaunchDescription, OnShutdown
from launch.events import IncludeLaunchDescription, Shutdown
from launch.launch_context import LaunchContext
from launch.utilities import normalize_to_list_of_entities, visit_all_entities_and_collect_futures

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from launch.event import Event
    from launch.launch_description import LaunchDescription
    from launch.launch_description_entity import LaunchDescriptionEntity

__all__ = ["LaunchService"]


class LaunchService:
    """Visits launch descriptions, handles events, and runs until the system is idle or shut down.

    Args:
        argv: Arguments of the program, for the context.
        noninteractive: Whether actions must not assume that a user is present.
        debug: Log at the level DEBUG, and tracebacks with errors.
    """

    def __init__(self, *, argv: Iterable[str] | None = None, noninteractive: bool = False, debug: bool = False) -> None:
        self.__debug = debug
        if debug:
            launch.logging.launch_config.level = "DEBUG"
        self.__logger = launch.logging.get_logger("launch")
        self.__context = LaunchContext(argv=argv, noninteractive=noninteractive)
        self.__context.register_event_handler(OnIncludeLaunchDescription())
        self.__context.register_event_handler(OnShutdown(on_shutdown=self.__on_shutdown))
        self.__futures: dict[asyncio.Future[Any], LaunchDescriptionEntity | None] = {}
        self.__loop: asyncio.AbstractEventLoop | None = None
        self.__task: asyncio.Task[int] | None = None
        self.__shutting_down = False
        self.__shutdown_was_requested = False
        self.__return_code = 0

    @property
    def context(self) -> LaunchContext:
        """The context of this service."""
        return self.__context

    @property
    def event_loop(self) -> asyncio.AbstractEventLoop | None:
        """The event loop while the service runs, None otherwise."""
        return self.__loop

    @property
    def task(self) -> asyncio.Task[int] | None:
        """The task while the service runs, None otherwise."""
        return self.__task

    def emit_event(self, event: Event) -> None:
        """Emit an event. This may be called from any thread."""
        if self.__loop is None:
            self.__context.emit_event_sync(event)
        else:
            self.__loop.call_soon_threadsafe(self.__context.emit_event_sync, event)

    def include_launch_description(self, launch_description: LaunchDescription) -> None:
        """Visit a launch description. This may be called from any thread, even while the service runs."""
        self.emit_event(IncludeLaunchDescription(launch_description))

    def shutdown(self, *, force_sync: bool = False) -> asyncio.Future[Any] | None:
        """Shut the system down. This may be called from any thread.

        Args:
            force_sync: Accepted for compatibility: events are always emitted synchronously.
        """
        del force_sync
        self.__request_shutdown("LaunchService.shutdown() called")
        return None

    def run(self, *, shutdown_when_idle: bool = True) -> int:
        """Launch and wait until the system has shut down; Ctrl-C shuts it down.

        Args:
            shutdown_when_idle: Shut down when no process, timer or event is left.

        Returns:
            The exit code: 0, or 1 if the launch description failed.
        """
        return asyncio.run(self.run_async(shutdown_when_idle=shutdown_when_idle))

    async def run_async(self, *, shutdown_when_idle: bool = True) -> int:
        """Run like :meth:`run`, in the running event loop."""
        if self.__task is not None:
            self.__logger.error("LaunchService is already running.")
            return 1
        self.__loop = asyncio.get_running_loop()
        self.__task = asyncio.current_task()
        self.__context._set_asyncio_loop(self.__loop)  # noqa: SLF001
        self.__context._set_is_shutdown(False)  # noqa: SLF001
        self.__shutting_down = self.__shutdown_was_requested = False
        self.__return_code = 0
        try:
            with self.__signal_handlers():
                await self.__process_until_shut_down(shutdown_when_idle)
        finally:
            self.__context._set_is_shutdown(True)  # noqa: SLF001
            self.__context._set_asyncio_loop(None)  # noqa: SLF001
            self.__loop = self.__task = None
        return self.__return_code

    async def __process_until_shut_down(self, shutdown_when_idle: bool) -> None:
        next_event = asyncio.ensure_future(self.__context._event_queue.get())  # noqa: SLF001
        try:
            while True:
                await asyncio.sleep(0)  # Let callbacks of finished futures emit their events.
                self.__forget_finished()
                if not next_event.done() and not self.__futures and self.__context._event_queue.empty():  # noqa: SLF001
                    if self.__shutting_down:
                        return
                    if shutdown_when_idle and not self.__shutdown_was_requested:
                        self.__request_shutdown("idle")
                await asyncio.wait([next_event, *self.__futures], return_when=asyncio.FIRST_COMPLETED)
                if next_event.done():
                    event = next_event.result()
                    next_event = asyncio.ensure_future(self.__context._event_queue.get())  # noqa: SLF001
                    self.__process_event(event)
        except asyncio.CancelledError:
            self.__logger.info("the launch was cancelled")
            raise
        finally:
            next_event.cancel()

    def __forget_finished(self) -> None:
        for future in self.__context._completion_futures:  # noqa: SLF001
            self.__futures.setdefault(future, None)
        self.__context._completion_futures.clear()  # noqa: SLF001
        for future in [each for each in self.__futures if each.done()]:
            entity = self.__futures.pop(future)
            if not future.cancelled() and (error := future.exception()) is not None:
                self.__fail(error, f" in {entity.describe()}" if entity is not None else "")

    def __process_event(self, event: Event) -> None:
        self.__logger.debug(f"processing event: '{event}'")
        context = self.__context
        for handler in tuple(context._event_handlers):  # noqa: SLF001
            # A handler may have been unregistered by one before it.
            if handler not in context._event_handlers or not handler.matches(event):  # noqa: SLF001
                continue
            context._push_locals()  # noqa: SLF001
            try:
                for entity in normalize_to_list_of_entities(handler.handle(event, context)):
                    pairs = visit_all_entities_and_collect_futures(entity, context)
                    self.__futures.update((future, each) for each, future in pairs if not future.done())
            except Exception as error:  # noqa: BLE001 - any error of a launch file ends the launch
                self.__fail(error)
            finally:
                context._pop_locals()  # noqa: SLF001

    def __fail(self, error: BaseException, where: str = "") -> None:
        if self.__debug:
            self.__logger.error("".join(traceback.format_exception(type(error), error, error.__traceback__)))
        hint = getattr(error, "hint", "")
        self.__logger.error(
            f"Caught exception in launch (see debug for traceback){where}: {error}" + (f"\n  {hint}" if hint else "")
        )
        self.__return_code = 1
        self.__request_shutdown(f"Caught exception in launch: {error}")

    def __request_shutdown(self, reason: str, *, due_to_sigint: bool = False) -> None:
        self.__shutdown_was_requested = True
        self.emit_event(Shutdown(reason=reason, due_to_sigint=due_to_sigint))

    def __on_shutdown(self, event: Shutdown, context: LaunchContext) -> None:
        del event
        self.__shutting_down = True
        context._set_is_shutdown(True)  # noqa: SLF001

    def __on_signal(self, number: int) -> None:
        if number == signal.SIGINT:
            if self.__shutdown_was_requested:
                self.__logger.warning("user interrupted with ctrl-c (SIGINT) again, ignoring...")
                return
            self.__logger.warning("user interrupted with ctrl-c (SIGINT)")
            self.__request_shutdown("ctrl-c (SIGINT)", due_to_sigint=True)
        elif not self.__shutdown_was_requested:
            name = signal.Signals(number).name
            self.__logger.warning(f"received {name}, shutting down")
            self.__request_shutdown(name)

    @contextlib.contextmanager
    def __signal_handlers(self) -> Iterator[None]:
        """Shut down on signals. Only the main thread may handle them."""
        if threading.current_thread() is not threading.main_thread():
            yield
            return
        assert self.__loop is not None
        loop = self.__loop
        names = ("SIGINT", "SIGTERM", "SIGQUIT", "SIGHUP", "SIGBREAK")
        numbers = [getattr(signal, name) for name in names if hasattr(signal, name)]
        # nohup ignores SIGHUP, which must stay ignored.
        numbers = [number for number in numbers if signal.getsignal(number) is not signal.SIG_IGN]
        handlers = SignalHandlers()
        for number in numbers:
            handlers.install(number, lambda n, _: loop.call_soon_threadsafe(self.__on_signal, n))
        wake = asyncio.ensure_future(_wake_regularly()) if os.name == "nt" else None
        try:
            yield
        finally:
            if wake is not None:
                wake.cancel()
            handlers.restore()


async def _wake_regularly() -> None:
    """Let Python handle signals on Windows, where they do not interrupt the wait of the event loop."""
    while True:  # noqa: ASYNC110 - it waits for nothing but the time
        await asyncio.sleep(0.5)
