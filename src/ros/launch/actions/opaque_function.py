# SPDX-License-Identifier: Apache-2.0
"""The action that calls a Python function."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.action import Action
from launch.utilities import normalize_to_list_of_entities

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from launch.launch_context import LaunchContext

__all__ = ["OpaqueFunction"]


class OpaqueFunction(Action):
    """Call a function with the launch context. It may return entities to visit.

    Args:
        function: The function, whose first argument is the context.
        args: Additional positional arguments.
        kwargs: Keyword arguments.
        condition: Call it only if this condition holds.
    """

    def __init__(
        self,
        *,
        function: Callable[..., Any],
        args: Iterable[Any] | None = None,
        kwargs: dict[str, Any] | None = None,
        **options: Any,
    ) -> None:
        super().__init__(**options)
        self.__function = function
        self.__args = list(args or ())
        self.__kwargs = dict(kwargs or {})

    def execute(self, context: LaunchContext) -> list[Any] | None:
        """Call the function."""
        result = self.__function(context, *self.__args, **self.__kwargs)
        return None if result is None else normalize_to_list_of_entities(result)
