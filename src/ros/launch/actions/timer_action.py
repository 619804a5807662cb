# SPDX-License-Identifier: Apache-2.0
"""The action that visits entities after a time."""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING, Any

import launch.logging
from launch.action import Action
from launch.event_handler import EventHandler
from launch.event_handlers import OnShutdown
from launch.events import TimerEvent
from launch.frontend.expose import expose_action
from launch.utilities import create_future, is_a
from launch.utilities.type_utils import normalize_typed_substitution, perform_typed_substitution

if TYPE_CHECKING:
    from collections.abc import Iterable

    from launch.event import Event
    from launch.frontend import Entity, Parser
    from launch.launch_context import LaunchContext
    from launch.launch_description_entity import LaunchDescriptionEntity
    from launch.some_substitutions_type import SomeSubstitutionsType

__all__ = ["TimerAction"]


@expose_action("timer")
class TimerAction(Action):
    """Visit entities after a time, unless the system shuts down before.

    Args:
        period: Time in seconds.
        actions: The entities.
        cancel_on_shutdown: Cancel the timer when the system shuts down.
        condition: Start the timer only if this condition holds.
    """

    def __init__(
        self,
        *,
        period: float | SomeSubstitutionsType,
        actions: Iterable[LaunchDescriptionEntity],
        cancel_on_shutdown: bool | SomeSubstitutionsType = True,
        **options: Any,
    ) -> None:
        super().__init__(**options)
        self.__period = normalize_typed_substitution(period, float)
        self.__actions = list(actions)
        self.__cancel_on_shutdown = normalize_typed_substitution(cancel_on_shutdown, bool)
        self.__completed_future: asyncio.Future[None] | None = None
        self.__waiting: asyncio.Future[None] | None = None
        self.__cancelled = False
        self.__logger = launch.logging.get_logger("launch")

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[Action], dict[str, Any]]:
        """Read ``<timer period=...>`` with its actions."""
        _, options = super().parse(entity, parser)
        options["period"] = parser.parse_if_substitutions(entity.get_attr("period", data_type=float, can_be_str=True))
        options["actions"] = [parser.parse_action(child) for child in entity.children]
        return cls, options

    @property
    def period(self) -> Any:
        """The time in seconds."""
        return self.__period

    @property
    def actions(self) -> list[LaunchDescriptionEntity]:
        """The entities that are visited after the time."""
        return self.__actions

    def describe_conditional_sub_entities(self) -> list[tuple[str, list[LaunchDescriptionEntity]]]:
        """Return the entities that are visited after the time."""
        return [(f"after {self.__period} seconds", self.__actions)]

    def get_asyncio_future(self) -> asyncio.Future[Any] | None:
        """Return the future that is done when the entities were visited or the timer was cancelled."""
        return self.__completed_future

    def cancel(self) -> None:
        """Cancel the timer. Its entities are not visited."""
        self.__cancelled = True
        if self.__waiting is not None:
            self.__waiting.cancel()

    def _wait(self, context: LaunchContext, seconds: float) -> Any:
        """Return the coroutine that waits for the end of the period. Subclasses measure time differently."""
        del context
        return asyncio.sleep(seconds)

    def execute(self, context: LaunchContext) -> list[Any] | None:
        """Start the timer."""
        if self.__cancelled:
            return None
        seconds = perform_typed_substitution(context, self.__period, float)
        local_values = context.get_locals_as_dict()
        self.__completed_future = create_future(context.asyncio_loop)
        timer = EventHandler(
            matcher=lambda event: is_a(event, TimerEvent) and event.timer_action is self,
            entities=self.__actions,
            handle_once=True,
        )

        def on_shutdown(_event: Event, context: LaunchContext) -> None:
            if perform_typed_substitution(context, self.__cancel_on_shutdown, bool):
                self.cancel()

        shutdown = OnShutdown(on_shutdown=on_shutdown)
        for handler in (timer, shutdown):
            context.register_event_handler(handler)

        async def run() -> None:
            assert self.__completed_future is not None
            assert self.__waiting is not None
            try:
                await asyncio.wait([self.__waiting])
                if not self.__waiting.cancelled():
                    self.__waiting.result()
                    context.extend_locals(local_values)
                    context.emit_event_sync(TimerEvent(timer_action=self))
                self.__completed_future.set_result(None)
            except Exception as error:  # noqa: BLE001 - the error becomes that of the action
                self.__completed_future.set_exception(error)
            if shutdown in context._event_handlers:  # noqa: SLF001
                context.unregister_event_handler(shutdown)

        self.__waiting = asyncio.ensure_future(self._wait(context, seconds))
        self.__task = asyncio.ensure_future(run())
        return None
