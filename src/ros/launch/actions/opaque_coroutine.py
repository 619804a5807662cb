# SPDX-License-Identifier: Apache-2.0
"""The action that runs a coroutine."""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING, Any

from launch.action import Action
from launch.event_handlers import OnShutdown

if TYPE_CHECKING:
    from collections.abc import Callable, Coroutine, Iterable

    from launch.launch_context import LaunchContext

__all__ = ["OpaqueCoroutine"]


class OpaqueCoroutine(Action):
    """Run a coroutine in the event loop. It is cancelled when the system shuts down.

    Args:
        coroutine: The coroutine function, whose first argument is the context.
        args: Additional positional arguments.
        kwargs: Keyword arguments.
        ignore_context: Do not pass the context.
        condition: Run it only if this condition holds.
    """

    def __init__(
        self,
        *,
        coroutine: Callable[..., Coroutine[Any, Any, Any]],
        args: Iterable[Any] | None = None,
        kwargs: dict[str, Any] | None = None,
        ignore_context: bool = False,
        **options: Any,
    ) -> None:
        super().__init__(**options)
        if not asyncio.iscoroutinefunction(coroutine):
            raise TypeError(f"OpaqueCoroutine expected a coroutine function for 'coroutine', got '{type(coroutine)}'")
        self.__coroutine = coroutine
        self.__args = list(args or ())
        self.__kwargs = dict(kwargs or {})
        self.__ignore_context = ignore_context
        self.__future: asyncio.Future[Any] | None = None

    def execute(self, context: LaunchContext) -> list[Any] | None:
        """Start the coroutine."""
        arguments = self.__args if self.__ignore_context else [context, *self.__args]
        task = asyncio.ensure_future(self.__coroutine(*arguments, **self.__kwargs))

        def cancel(_event: Any, _context: LaunchContext) -> None:
            task.cancel()

        context.register_event_handler(OnShutdown(on_shutdown=cancel))
        self.__future = task
        return None

    def get_asyncio_future(self) -> asyncio.Future[Any] | None:
        """Return the task of the coroutine."""
        return self.__future
