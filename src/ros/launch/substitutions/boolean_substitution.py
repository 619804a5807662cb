# SPDX-License-Identifier: Apache-2.0
"""The substitutions of truth values."""

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

__all__ = [
    "AllSubstitution",
    "AndSubstitution",
    "AnySubstitution",
    "BooleanSubstitution",
    "IfElseSubstitution",
    "NotSubstitution",
    "OrSubstitution",
]


def _text(value: bool) -> str:
    return "true" if value else "false"


def _truth(context: LaunchContext, parts: list[Substitution]) -> bool:
    text = perform_substitutions(context, parts)
    word = text.strip().lower()
    if word in {"true", "on", "yes", "1"}:
        return True
    if word in {"false", "off", "no", "0"}:
        return False
    raise SubstitutionFailure(f"'{text}' is not a truth value; write true or false")


class _Several(Substitution):
    """Base class: several truth values."""

    def __init__(self, *args: SomeSubstitutionsType) -> None:
        self._args = [normalize_to_list_of_substitutions(arg) for arg in args]

    @property
    def args(self) -> list[list[Substitution]]:
        """The values."""
        return self._args

    def describe(self) -> str:
        """Return a one-line description."""
        parts = (" + ".join(each.describe() for each in arg) for arg in self._args)
        return f"{type(self).__name__}({', '.join(parts)})"


@expose_substitution("not")
class NotSubstitution(_Several):
    """The opposite of a truth value."""

    def __init__(self, value: SomeSubstitutionsType) -> None:
        super().__init__(value)

    @classmethod
    def parse(cls, data: Sequence[SomeSubstitutionsType]) -> tuple[type[Substitution], dict[str, Any]]:
        """Read ``$(not VALUE)``."""
        check_arguments("not", data, 1, 1)
        return cls, {"value": data[0]}

    @property
    def value(self) -> list[Substitution]:
        """The value."""
        return self._args[0]

    def perform(self, context: LaunchContext) -> str:
        """Return ``true`` or ``false``."""
        return _text(not _truth(context, self.value))


class BooleanSubstitution(_Several):
    """A truth value in its usual form: ``true`` or ``false``."""

    def __init__(self, value: SomeSubstitutionsType) -> None:
        super().__init__(value)

    @property
    def value(self) -> list[Substitution]:
        """The value."""
        return self._args[0]

    def perform(self, context: LaunchContext) -> str:
        """Return ``true`` or ``false``."""
        return _text(_truth(context, self.value))


class _Pair(_Several):
    """Base class: two truth values."""

    def __init__(self, left: SomeSubstitutionsType, right: SomeSubstitutionsType) -> None:
        super().__init__(left, right)

    @classmethod
    def parse(cls, data: Sequence[SomeSubstitutionsType]) -> tuple[type[Substitution], dict[str, Any]]:
        """Read ``$(and LEFT RIGHT)`` or ``$(or LEFT RIGHT)``."""
        check_arguments(cls.__name__, data, 2, 2)
        return cls, {"left": data[0], "right": data[1]}

    @property
    def left(self) -> list[Substitution]:
        """The first value."""
        return self._args[0]

    @property
    def right(self) -> list[Substitution]:
        """The second value."""
        return self._args[1]


@expose_substitution("and")
class AndSubstitution(_Pair):
    """Whether two values are both true."""

    def perform(self, context: LaunchContext) -> str:
        """Return ``true`` or ``false``."""
        return _text(_truth(context, self.left) and _truth(context, self.right))


@expose_substitution("or")
class OrSubstitution(_Pair):
    """Whether at least one of two values is true."""

    def perform(self, context: LaunchContext) -> str:
        """Return ``true`` or ``false``."""
        return _text(_truth(context, self.left) or _truth(context, self.right))


@expose_substitution("any")
class AnySubstitution(_Several):
    """Whether at least one of several values is true."""

    @classmethod
    def parse(cls, data: Sequence[SomeSubstitutionsType]) -> tuple[type[Substitution], dict[str, Any]]:
        """Read ``$(any VALUE...)``."""
        return cls, {"args": data}

    def perform(self, context: LaunchContext) -> str:
        """Return ``true`` or ``false``."""
        return _text(any(_truth(context, arg) for arg in self._args))


@expose_substitution("all")
class AllSubstitution(_Several):
    """Whether several values are all true."""

    @classmethod
    def parse(cls, data: Sequence[SomeSubstitutionsType]) -> tuple[type[Substitution], dict[str, Any]]:
        """Read ``$(all VALUE...)``."""
        return cls, {"args": data}

    def perform(self, context: LaunchContext) -> str:
        """Return ``true`` or ``false``."""
        return _text(all(_truth(context, arg) for arg in self._args))


@expose_substitution("if")
class IfElseSubstitution(Substitution):
    """One of two strings, depending on a boolean."""

    def __init__(
        self,
        condition: SomeSubstitutionsType,
        if_value: SomeSubstitutionsType = "",
        else_value: SomeSubstitutionsType = "",
    ) -> None:
        self._condition = normalize_to_list_of_substitutions(condition)
        self._if_value = normalize_to_list_of_substitutions(if_value)
        self._else_value = normalize_to_list_of_substitutions(else_value)

    @classmethod
    def parse(cls, data: Sequence[SomeSubstitutionsType]) -> tuple[type[Substitution], dict[str, Any]]:
        """Read ``$(if CONDITION IF_VALUE [ELSE_VALUE])``."""
        check_arguments("if", data, 2, 3)
        return cls, dict(zip(("condition", "if_value", "else_value"), data, strict=False))

    @property
    def condition(self) -> list[Substitution]:
        """The truth value."""
        return self._condition

    @property
    def if_value(self) -> list[Substitution]:
        """The string if the condition is true."""
        return self._if_value

    @property
    def else_value(self) -> list[Substitution]:
        """The string if the condition is false."""
        return self._else_value

    def describe(self) -> str:
        """Return a one-line description."""
        parts = (self._condition, self._if_value, self._else_value)
        return f"IfElseSubstitution({', '.join(' + '.join(each.describe() for each in part) for part in parts)})"

    def perform(self, context: LaunchContext) -> str:
        """Return one of the strings."""
        chosen = self._if_value if _truth(context, self._condition) else self._else_value
        return perform_substitutions(context, chosen)
