# SPDX-License-Identifier: Apache-2.0
"""The substitutions of the values of ForEach and ForLoop."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.frontend.arguments import check_arguments
from launch.frontend.expose import expose_substitution
from launch.substitution import Substitution
from launch.substitutions.substitution_failure import SubstitutionFailure
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from collections.abc import Sequence

    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType

__all__ = ["ForEachVar", "ForLoopIndex"]


class _LoopValue(Substitution):
    """Base class: a value of the loop that is being visited."""

    def __init__(self, name: SomeSubstitutionsType) -> None:
        self._name = normalize_to_list_of_substitutions(name)

    @classmethod
    def parse(cls, data: Sequence[SomeSubstitutionsType]) -> tuple[type[Substitution], dict[str, Any]]:
        """Read the name, and with ``$(for-var NAME DEFAULT)`` the default."""
        check_arguments(cls.__name__, data, 1, 2)
        return cls, {"name": data[0]} | ({"default_value": data[1]} if len(data) == 2 else {})

    @property
    def name(self) -> list[Substitution]:
        """The name of the value."""
        return self._name

    def describe(self) -> str:
        """Return a one-line description."""
        return f"{type(self).__name__}({' + '.join(part.describe() for part in self._name)})"

    def _value(self, context: LaunchContext) -> str | None:
        values = context.get_locals_as_dict().get("for_values") or {}
        value = values.get(perform_substitutions(context, self._name))
        return None if value is None else str(value)

    def perform(self, context: LaunchContext) -> str:
        """Return the value."""
        value = self._value(context)
        if value is None:
            raise SubstitutionFailure(f"No value available for {self.describe()}")
        return value


@expose_substitution("for-var")
class ForEachVar(_LoopValue):
    """A value of the current set of values in a ForEach."""

    def __init__(self, name: SomeSubstitutionsType, *, default_value: SomeSubstitutionsType | None = None) -> None:
        super().__init__(name)
        self._default_value = None if default_value is None else normalize_to_list_of_substitutions(default_value)

    @property
    def default_value(self) -> list[Substitution] | None:
        """The value for sets that do not have it."""
        return self._default_value

    def perform(self, context: LaunchContext) -> str:
        """Return the value."""
        if self._default_value is not None and self._value(context) is None:
            return perform_substitutions(context, self._default_value)
        return super().perform(context)


@expose_substitution("index")
class ForLoopIndex(_LoopValue):
    """The current number in a ForLoop."""
