# SPDX-License-Identifier: Apache-2.0
"""The action that starts the tests."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.action import Action

if TYPE_CHECKING:
    from collections.abc import Callable

    from launch.launch_context import LaunchContext

__all__ = ["ReadyToTest"]


class ReadyToTest(Action):
    """Start the tests. Each test description contains this action exactly once, at any depth."""

    def __init__(self, **options: Any) -> None:
        super().__init__(**options)
        self.__callbacks: list[Callable[[], object]] = []

    def _add_callback(self, callback: Callable[[], object]) -> None:
        self.__callbacks.append(callback)

    def execute(self, context: LaunchContext) -> list[Any] | None:
        """Tell the runner of the tests to start."""
        del context
        for callback in self.__callbacks:
            callback()
        return None
