# SPDX-License-Identifier: Apache-2.0
"""The state that actions and substitutions share while a system is launched."""

from __future__ import annotations

import asyncio
import collections
import os
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterable, MutableMapping

    from launch.event import Event
    from launch.event_handler import BaseEventHandler
    from launch.substitution import Substitution

__all__ = ["LaunchContext"]


class LaunchContext:
    """Launch configurations, local values, event handlers and the queue of events.

    Args:
        argv: Arguments of the program that launches the system.
        noninteractive: Whether actions must not assume that a user is present.
    """

    def __init__(self, *, argv: Iterable[str] | None = None, noninteractive: bool = False) -> None:
        self.__argv = list(argv or ())
        self.__noninteractive = noninteractive
        self.__globals: dict[str, Any] = {}
        self.__locals_stack: list[dict[str, Any]] = []
        self.__locals: dict[str, Any] = {}
        self.__configurations_stack: list[dict[str, Any]] = []
        self.__configurations: dict[str, Any] = {}
        self.__environment_stack: list[dict[str, str]] = []
        self.__initial_environment = dict(os.environ)
        self.__asyncio_loop: asyncio.AbstractEventLoop | None = None
        self.__is_shutdown = False
        self._event_queue: asyncio.Queue[Event] = asyncio.Queue()
        self._event_handlers: collections.deque[BaseEventHandler] = collections.deque()
        self._completion_futures: list[asyncio.Future[Any]] = []

    @property
    def argv(self) -> list[str]:
        """The arguments of the program that launches the system."""
        return self.__argv

    @property
    def noninteractive(self) -> bool:
        """Whether actions must not assume that a user is present."""
        return self.__noninteractive

    @property
    def is_shutdown(self) -> bool:
        """Whether the system is shutting down."""
        return self.__is_shutdown

    def _set_is_shutdown(self, state: bool) -> None:
        self.__is_shutdown = state

    @property
    def asyncio_loop(self) -> asyncio.AbstractEventLoop | None:
        """The event loop in which the system is launched."""
        return self.__asyncio_loop

    def _set_asyncio_loop(self, loop: asyncio.AbstractEventLoop | None) -> None:
        self.__asyncio_loop = loop

    def add_completion_future(self, completion_future: asyncio.Future[Any]) -> None:
        """Keep the launch service running until this future is done."""
        self._completion_futures.append(completion_future)

    @property
    def locals(self) -> _AttributeDict:
        """Local and global values, as attributes."""
        return _AttributeDict({**self.__globals, **self.__locals})

    def get_locals_as_dict(self) -> dict[str, Any]:
        """Return local and global values."""
        return {**self.__globals, **self.__locals}

    def extend_globals(self, extensions: dict[str, Any]) -> None:
        """Add values that are visible everywhere."""
        self.__globals.update(extensions)

    def extend_locals(self, extensions: dict[str, Any]) -> None:
        """Add values that are visible until the current event has been handled."""
        self.__locals.update(extensions)

    def _push_locals(self) -> None:
        self.__locals_stack.append(dict(self.__locals))

    def _pop_locals(self) -> None:
        self.__locals = self.__locals_stack.pop()

    @property
    def launch_configurations(self) -> dict[str, Any]:
        """The launch configurations of the current scope by name; arguments of launch files are among them."""
        return self.__configurations

    def _push_launch_configurations(self) -> None:
        self.__configurations_stack.append(dict(self.__configurations))

    def _pop_launch_configurations(self) -> None:
        if not self.__configurations_stack:
            raise RuntimeError("launch configurations stack unexpectedly empty")
        # The dictionary stays the same object: actions hold references to it.
        configurations = self.__configurations_stack.pop()
        self.__configurations.clear()
        self.__configurations.update(configurations)

    @property
    def environment(self) -> MutableMapping[str, str]:
        """The environment of this process, which started processes inherit."""
        return os.environ

    def _push_environment(self) -> None:
        self.__environment_stack.append(dict(os.environ))

    def _pop_environment(self) -> None:
        if not self.__environment_stack:
            raise RuntimeError("environment stack unexpectedly empty")
        self._replace_environment(self.__environment_stack.pop())

    def _reset_environment(self) -> None:
        self._replace_environment(self.__initial_environment)

    def _replace_environment(self, environment: dict[str, str]) -> None:
        os.environ.clear()
        os.environ.update(environment)

    def register_event_handler(self, event_handler: BaseEventHandler, append: bool = False) -> None:
        """Register a handler. It comes before all others, or after them with `append`."""
        if append:
            self._event_handlers.append(event_handler)
        else:
            self._event_handlers.appendleft(event_handler)

    def unregister_event_handler(self, event_handler: BaseEventHandler) -> None:
        """Unregister a handler.

        Raises:
            ValueError: The handler is not registered.
        """
        self._event_handlers.remove(event_handler)

    def would_handle_event(self, event: Event) -> bool:
        """Return whether any registered handler matches the event."""
        return any(handler.matches(event) for handler in self._event_handlers)

    def emit_event_sync(self, event: Event) -> None:
        """Put an event into the queue."""
        self._event_queue.put_nowait(event)

    async def emit_event(self, event: Event) -> None:
        """Put an event into the queue."""
        self.emit_event_sync(event)

    def perform_substitution(self, sub: Substitution) -> str:
        """Perform a substitution and return its string."""
        return sub.perform(self)


class _AttributeDict(dict[str, Any]):
    """A dictionary whose values are also attributes."""

    def __getattr__(self, name: str) -> Any:
        try:
            return self[name]
        except KeyError:
            raise AttributeError(f"context.locals has no attribute '{name}'") from None
