# SPDX-License-Identifier: Apache-2.0
"""The action that remaps a name of all nodes after it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.action import Action
from launch.frontend.expose import expose_action
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.frontend import Entity, Parser
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType
    from launch.substitution import Substitution

__all__ = ["SetRemap"]


@expose_action("set_remap")
class SetRemap(Action):
    """Remap a name of all nodes after it in the same group."""

    def __init__(self, src: SomeSubstitutionsType, dst: SomeSubstitutionsType, **options: Any) -> None:
        super().__init__(**options)
        self.__src = normalize_to_list_of_substitutions(src)
        self.__dst = normalize_to_list_of_substitutions(dst)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[Action], dict[str, Any]]:
        """Read ``<set_remap from=... to=...>``."""
        _, options = super().parse(entity, parser)
        options["src"] = parser.parse_substitution(entity.get_attr("from"))
        options["dst"] = parser.parse_substitution(entity.get_attr("to"))
        return cls, options

    @property
    def src(self) -> list[Substitution]:
        """The name before the remapping."""
        return self.__src

    @property
    def dst(self) -> list[Substitution]:
        """The name after the remapping."""
        return self.__dst

    def execute(self, context: LaunchContext) -> list[Any] | None:
        """Set the remapping."""
        rule = (perform_substitutions(context, self.__src), perform_substitutions(context, self.__dst))
        present = context.launch_configurations.get("ros_remaps", [])
        context.launch_configurations["ros_remaps"] = [*present, rule]
        return None
