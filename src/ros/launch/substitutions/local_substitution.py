# SPDX-License-Identifier: Apache-2.0
"""The substitution of a local value of the context."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

from launch.substitution import Substitution
from launch.substitutions.substitution_failure import SubstitutionFailure

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext

__all__ = ["LocalSubstitution"]

_STEP = re.compile(r"""\.?(?P<name>[A-Za-z_]\w*)|\[(?P<index>\d+)\]|\[(?P<quote>['"])(?P<key>.*?)(?P=quote)\]""")


class LocalSubstitution(Substitution):
    """A value of ``context.locals``, such as ``event.pid`` or ``values['name'][0]``."""

    def __init__(self, expression: str, *, description: str | None = None) -> None:
        self.__expression = expression
        self.__description = description

    @property
    def expression(self) -> str:
        """The expression."""
        return self.__expression

    def describe(self) -> str:
        """Return a one-line description."""
        return f"LocalVar('{self.__description or self.__expression}')"

    def perform(self, context: LaunchContext) -> str:
        """Return the value as a string."""
        value: Any = context.get_locals_as_dict()
        position = 0
        while position < len(self.__expression):
            step = _STEP.match(self.__expression, position)
            if step is None:
                raise SubstitutionFailure(f"{self.__expression!r} is not the name of a local value")
            try:
                if step["index"] is not None:
                    value = value[int(step["index"])]
                elif step["key"] is not None:
                    value = value[step["key"]]
                else:
                    value = value[step["name"]] if position == 0 else getattr(value, step["name"])
            except (KeyError, IndexError, AttributeError, TypeError) as error:
                raise SubstitutionFailure(f"context.locals has no value '{self.__expression}': {error}") from error
            position = step.end()
        return str(value)
