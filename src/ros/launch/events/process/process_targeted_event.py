# SPDX-License-Identifier: Apache-2.0
"""Requests to processes."""

from __future__ import annotations

import signal as signals
from typing import TYPE_CHECKING

from launch.event import Event

if TYPE_CHECKING:
    from collections.abc import Callable

    from launch.actions.execute_local import ExecuteLocal

__all__ = ["ProcessTargetedEvent", "ShutdownProcess", "SignalProcess"]


class ProcessTargetedEvent(Event):
    """Base class: a request to the processes that a predicate accepts."""

    name = "launch.events.process.ProcessTargetedEvent"

    def __init__(self, *, process_matcher: Callable[[ExecuteLocal], bool]) -> None:
        self.__process_matcher = process_matcher

    @property
    def process_matcher(self) -> Callable[[ExecuteLocal], bool]:
        """The predicate for the actions that started the processes."""
        return self.__process_matcher


class ShutdownProcess(ProcessTargetedEvent):
    """A request to shut down."""

    name = "launch.events.process.ShutdownProcess"


class SignalProcess(ProcessTargetedEvent):
    """A request to send a signal, by its number or name."""

    name = "launch.events.process.SignalProcess"

    def __init__(
        self, *, signal_number: str | int | signals.Signals, process_matcher: Callable[[ExecuteLocal], bool]
    ) -> None:
        super().__init__(process_matcher=process_matcher)
        if isinstance(signal_number, str):
            name = signal_number if signal_number.startswith("SIG") else f"SIG{signal_number}"
            self.__signal = signals.Signals[name]
        else:
            self.__signal = signals.Signals(signal_number)

    @property
    def signal(self) -> signals.Signals:
        """The signal."""
        return self.__signal

    @property
    def signal_name(self) -> str:
        """The name of the signal, such as ``SIGINT``."""
        return self.__signal.name
