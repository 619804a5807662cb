# SPDX-License-Identifier: Apache-2.0
"""The action that runs a test program."""

from __future__ import annotations

import asyncio
import signal
from typing import TYPE_CHECKING, Any

from launch.actions import ExecuteProcess
from launch.events import matches_action
from launch.events.process import SignalProcess

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext

__all__ = ["Test"]


class Test(ExecuteProcess):
    """Run a test program, and stop it if it takes too long.

    Args:
        timeout: Seconds after which the program receives SIGTERM, or None for no limit.
        kill_timeout: Seconds after that until SIGKILL.
        options: Keyword arguments of ExecuteProcess.
    """

    __test__ = False  # pytest does not collect this class

    def __init__(self, *, timeout: float | None = None, kill_timeout: float = 2.0, **options: Any) -> None:
        super().__init__(**options)
        self.__timeout = timeout
        self.__kill_timeout = kill_timeout

    def execute(self, context: LaunchContext) -> list[Any] | None:
        """Start the program."""
        actions = super().execute(context)
        if self.__timeout is not None:
            task = asyncio.ensure_future(self.__stop(context, self.__timeout))
            future = self.get_asyncio_future()
            if future is not None:
                future.add_done_callback(lambda _: task.cancel())
        return actions

    async def __stop(self, context: LaunchContext, seconds: float) -> None:
        for delay, name in ((seconds, "SIGTERM"), (self.__kill_timeout, "SIGKILL")):
            await asyncio.sleep(delay)
            if hasattr(signal, name):
                context.emit_event_sync(SignalProcess(signal_number=name, process_matcher=matches_action(self)))
