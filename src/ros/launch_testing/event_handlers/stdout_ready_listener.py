# SPDX-License-Identifier: Apache-2.0
"""The event handler that waits for an output line."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.event_handlers import OnProcessIO
from launch.utilities import normalize_to_list_of_entities

if TYPE_CHECKING:
    from launch.actions.execute_local import ExecuteLocal
    from launch.events.process import ProcessIO
    from launch.launch_description_entity import LaunchDescriptionEntity
    from launch.some_entities_type import SomeEntitiesType

__all__ = ["StdoutReadyListener"]


class StdoutReadyListener(OnProcessIO):
    """Executes actions when a process has written a given string to standard output.

    Args:
        target_action: The action of the process, or None for all processes.
        ready_txt: The text.
        actions: The actions, which are executed once.
    """

    def __init__(self, *, target_action: ExecuteLocal | None = None, ready_txt: str, actions: SomeEntitiesType) -> None:
        super().__init__(target_action=target_action, on_stdout=self.__on_stdout)
        self.__ready_txt = ready_txt
        self.__actions: SomeEntitiesType | None = actions
        self.__text = ""

    def describe(self) -> tuple[str, list[LaunchDescriptionEntity]]:
        """Return a description and the actions, among which may be ReadyToTest."""
        return super().describe()[0], normalize_to_list_of_entities(self.__actions)

    def __on_stdout(self, event: ProcessIO) -> Any:
        if self.__actions is None:
            return None
        self.__text += event.text.decode(errors="replace")
        if self.__ready_txt not in self.__text:
            self.__text = self.__text[-len(self.__ready_txt) :]  # The rest of it may still arrive.
            return None
        actions, self.__actions = self.__actions, None
        return actions
