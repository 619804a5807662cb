# SPDX-License-Identifier: Apache-2.0
"""The event that the system shuts down."""

from launch.event import Event

__all__ = ["Shutdown"]


class Shutdown(Event):
    """The system shuts down."""

    name = "launch.events.Shutdown"

    def __init__(self, *, reason: str = "reason not given", due_to_sigint: bool = False) -> None:
        self.__reason = reason
        self.__due_to_sigint = due_to_sigint

    @property
    def reason(self) -> str:
        """Why the system shuts down."""
        return self.__reason

    @property
    def due_to_sigint(self) -> bool:
        """Whether Ctrl-C was pressed."""
        return self.__due_to_sigint
