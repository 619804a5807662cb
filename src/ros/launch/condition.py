# SPDX-License-Identifier: Apache-2.0
"""Base class of conditions."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

    from launch.launch_context import LaunchContext

__all__ = ["Condition"]


class Condition:
    """A predicate about the launch context, which decides whether an action is executed."""

    def __init__(self, *, predicate: Callable[[LaunchContext], bool] | None = None) -> None:
        self._predicate = predicate

    def describe(self) -> str:
        """Return a one-line description."""
        return self.__repr__()

    def evaluate(self, context: LaunchContext) -> bool:
        """Return whether the condition holds."""
        return True if self._predicate is None else self._predicate(context)
