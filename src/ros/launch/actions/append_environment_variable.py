# SPDX-License-Identifier: Apache-2.0
"""The action that appends to an environment variable."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

from launch.actions._named import NamedValueAction
from launch.conditions import evaluate_condition_expression
from launch.frontend.expose import expose_action
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.action import Action
    from launch.frontend import Entity, Parser
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType
    from launch.substitution import Substitution

__all__ = ["AppendEnvironmentVariable"]


@expose_action("append_env")
class AppendEnvironmentVariable(NamedValueAction):
    """Append to an environment variable. Set it if it does not exist.

    Args:
        name: Name of the variable.
        value: Text to append.
        prepend: Put the text in front.
        separator: Text between the old and the new value; by default the separator of PATH.
        condition: Do it only if this condition holds.
    """

    def __init__(
        self,
        name: SomeSubstitutionsType,
        value: SomeSubstitutionsType,
        prepend: bool | SomeSubstitutionsType = False,
        separator: SomeSubstitutionsType = os.pathsep,
        **options: Any,
    ) -> None:
        super().__init__(name, value, **options)
        self.__prepend = normalize_to_list_of_substitutions(str(prepend) if isinstance(prepend, bool) else prepend)
        self.__separator = normalize_to_list_of_substitutions(separator)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[Action], dict[str, Any]]:
        """Read ``<append_env name=... value=...>``."""
        _, options = super().parse(entity, parser)
        prepend = entity.get_attr("prepend", optional=True, data_type=bool, can_be_str=True)
        if prepend is not None:
            options["prepend"] = parser.parse_if_substitutions(prepend)
        separator = entity.get_attr("separator", optional=True)
        if separator is not None:
            options["separator"] = parser.parse_substitution(separator)
        return cls, options

    @property
    def prepend(self) -> list[Substitution]:
        """Whether the new value is prepended."""
        return self.__prepend

    @property
    def separator(self) -> list[Substitution]:
        """The separator between the old and the new value."""
        return self.__separator

    def execute(self, context: LaunchContext) -> list[Any] | None:
        """Change the variable."""
        name = perform_substitutions(context, self.name)
        parts = [perform_substitutions(context, self.value)]
        if name in context.environment:
            old = context.environment[name]
            parts = [*parts, old] if evaluate_condition_expression(context, self.__prepend) else [old, *parts]
        context.environment[name] = perform_substitutions(context, self.__separator).join(parts)
        return None
