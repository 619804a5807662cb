# SPDX-License-Identifier: Apache-2.0
"""The common base of actions on environment variables and launch configurations: a name and a value."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.action import Action
from launch.utilities import normalize_to_list_of_substitutions

if TYPE_CHECKING:
    from launch.frontend import Entity, Parser
    from launch.some_substitutions_type import SomeSubstitutionsType
    from launch.substitution import Substitution

__all__ = ["NamedAction", "NamedValueAction"]


class NamedAction(Action):
    """An action on something with a name."""

    def __init__(self, name: SomeSubstitutionsType, **options: Any) -> None:
        super().__init__(**options)
        self.__name = normalize_to_list_of_substitutions(name)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[Action], dict[str, Any]]:
        """Read the attribute ``name=...``."""
        _, options = super().parse(entity, parser)
        return cls, options | {"name": parser.parse_substitution(entity.get_attr("name"))}

    @property
    def name(self) -> list[Substitution]:
        """The name of the variable or launch configuration."""
        return self.__name


class NamedValueAction(NamedAction):
    """An action on something with a name that needs a value."""

    def __init__(self, name: SomeSubstitutionsType, value: SomeSubstitutionsType, **options: Any) -> None:
        super().__init__(name, **options)
        self.__value = normalize_to_list_of_substitutions(value)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[Action], dict[str, Any]]:
        """Read the attributes ``name=... value=...``."""
        _, options = super().parse(entity, parser)
        return cls, options | {"value": parser.parse_substitution(entity.get_attr("value"))}

    @property
    def value(self) -> list[Substitution]:
        """The value."""
        return self.__value
