# SPDX-License-Identifier: Apache-2.0
"""The launch of a launch fixture."""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING, Any

import pytest

from launch import LaunchDescription, LaunchService
from launch.event_handlers import OnShutdown
from launch_pytest.fixture import LaunchFixture, launch_fixture_of
from launch_testing.actions import ReadyToTest
from launch_testing.loader import find_ready_action

if TYPE_CHECKING:
    from launch import LaunchContext
    from launch.events import Shutdown

__all__ = ["RunningLaunch", "launch_of", "options_of"]

_launches: dict[LaunchFixture, RunningLaunch] = {}


class RunningLaunch:
    """A launch service that runs in its own event loop.

    Args:
        options: The launch fixture.
    """

    def __init__(self, options: LaunchFixture) -> None:
        self.service = LaunchService()
        self.loop = asyncio.new_event_loop()
        self._options = options
        self._task: asyncio.Task[int] | None = None
        self._was_interrupted = False
        self.service.context.register_event_handler(OnShutdown(on_shutdown=self._on_shutdown))

    def start(self, value: Any) -> None:
        """Start the launch, and wait until it is ready for the tests.

        Args:
            value: The value of the launch fixture.

        Raises:
            RuntimeError: It has ended before.
            TypeError: The value is not a launch description.
        """
        description = _description(value, self._options)
        _launches[self._options] = self
        ready = asyncio.Event()
        action = find_ready_action(description)
        if action is None:
            action = ReadyToTest()
            description.add_action(action)
        action._add_callback(ready.set)  # noqa: SLF001 - the action of launch_testing
        self.service.include_launch_description(description)
        run = self.service.run_async(shutdown_when_idle=not self._options.auto_shutdown)
        self._task = self.loop.create_task(run)
        waiter = self.loop.create_task(ready.wait())
        self.run(asyncio.wait([self._task, waiter], return_when=asyncio.FIRST_COMPLETED))
        if not ready.is_set():
            waiter.cancel()
            raise RuntimeError(f"The launch of the fixture {self._options.name} has ended before ReadyToTest")

    def finish(self) -> None:
        """Shut the launch down, or wait for its end. Do nothing if it has ended.

        Raises:
            RuntimeError: The launch has failed.
            KeyboardInterrupt: Ctrl-C was pressed.
        """
        if self._task is None:
            return
        task, self._task = self._task, None
        if not task.done():
            if self._options.auto_shutdown:
                self.service.shutdown()
            self.run(asyncio.wait([task]))
        if self._was_interrupted:  # The launch service handles Ctrl-C, which also ends the tests.
            raise KeyboardInterrupt
        if (code := task.result()) != 0:
            raise RuntimeError(f"The launch of the fixture {self._options.name} has failed with exit code {code}")

    def _on_shutdown(self, event: Shutdown, _: LaunchContext) -> None:
        self._was_interrupted = event.due_to_sigint

    def close(self) -> None:
        """Shut the launch down, and close the event loop."""
        if _launches.get(self._options) is self:
            del _launches[self._options]
        try:
            self.finish()
        finally:
            self.loop.run_until_complete(self.loop.shutdown_asyncgens())
            self.loop.close()

    def run(self, awaitable: Any) -> Any:
        """Run the event loop until something is done."""
        asyncio.set_event_loop(self.loop)
        return self.loop.run_until_complete(awaitable)


def launch_of(test: Any, request: pytest.FixtureRequest | None = None) -> RunningLaunch:
    """Return the running launch of a test.

    Args:
        test: The item of the test, which has the mark.
        request: Starts the launch if it is not running yet.
    """
    options = options_of(test.get_closest_marker("launch"), test.nodeid)
    if request is not None:
        request.getfixturevalue(options.name)
    # A fixture with the same name nearer to the test replaces the one of the mark.
    definitions = test._fixtureinfo.name2fixturedefs.get(options.name, ())  # noqa: SLF001 - pytest has no public name
    used = launch_fixture_of(definitions[-1].func) if definitions else None
    return _launches[used or options]


def options_of(mark: pytest.Mark, test: str) -> LaunchFixture:
    """Return the launch fixture of a mark.

    Raises:
        pytest.Collector.CollectError: The mark does not name a launch fixture.
    """
    declared = mark.kwargs.get("fixture", mark.args[0] if mark.args else None)
    options = launch_fixture_of(declared)
    if options is None:
        raise pytest.Collector.CollectError(
            f"{test}: @pytest.mark.launch needs fixture=, a function that is declared with @launch_pytest.fixture, "
            f"not {declared!r}"
        )
    return options


def _description(value: Any, options: LaunchFixture) -> LaunchDescription:
    description = value[0] if isinstance(value, tuple | list) and value else value
    if not isinstance(description, LaunchDescription):
        raise TypeError(
            f"The launch fixture {options.name} must return a LaunchDescription, or a tuple or list that begins with "
            f"one, not {value!r}"
        )
    return description
