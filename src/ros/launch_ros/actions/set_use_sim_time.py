# SPDX-License-Identifier: Apache-2.0
"""The action that sets the parameter use_sim_time of all nodes after it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.action import Action
from launch.frontend.expose import expose_action
from launch.utilities.type_utils import normalize_typed_substitution, perform_typed_substitution

if TYPE_CHECKING:
    from launch.frontend import Entity, Parser
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType

__all__ = ["SetUseSimTime"]


@expose_action("set_use_sim_time")
class SetUseSimTime(Action):
    """Set the parameter use_sim_time of all nodes after it in the same group."""

    def __init__(self, value: bool | SomeSubstitutionsType, **options: Any) -> None:
        super().__init__(**options)
        self.__value = normalize_typed_substitution(value, bool)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[Action], dict[str, Any]]:
        """Read ``<set_use_sim_time value=...>``."""
        _, options = super().parse(entity, parser)
        value = entity.get_attr("value", data_type=bool, can_be_str=True)
        return cls, options | {"value": parser.parse_if_substitutions(value)}

    @property
    def value(self) -> Any:
        """The value."""
        return self.__value

    def execute(self, context: LaunchContext) -> list[Any] | None:
        """Set the parameter."""
        value = perform_typed_substitution(context, self.__value, bool)
        present = context.launch_configurations.get("global_params", [])
        context.launch_configurations["global_params"] = [*present, ("use_sim_time", value)]
        return None
