# SPDX-License-Identifier: Apache-2.0
"""The action that sets a parameter of all nodes after it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.action import Action
from launch.frontend.expose import expose_action
from launch.substitutions import TextSubstitution
from launch.utilities import normalize_to_list_of_substitutions
from launch_ros.utilities import evaluate_parameter_dict, normalize_parameter_dict

if TYPE_CHECKING:
    from launch.frontend import Entity, Parser
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType
    from launch.substitution import Substitution

__all__ = ["SetParameter"]


@expose_action("set_parameter")
class SetParameter(Action):
    """Set a parameter of all nodes after it in the same group. The parameters of a node override it."""

    def __init__(self, name: SomeSubstitutionsType, value: Any, **options: Any) -> None:
        super().__init__(**options)
        self.__name = normalize_to_list_of_substitutions(name)
        self.__parameters = normalize_parameter_dict({tuple(self.__name): value})

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[Action], dict[str, Any]]:
        """Read ``<set_parameter name=... value=...>``."""
        _, options = super().parse(entity, parser)
        options["name"] = parser.parse_substitution(entity.get_attr("name"))
        value = parser.parse_if_substitutions(entity.get_attr("value", data_type=None))
        if isinstance(value, list) and len(value) == 1 and isinstance(value[0], TextSubstitution):
            value = value[0].text
        return cls, options | {"value": value}

    @property
    def name(self) -> list[Substitution]:
        """The name of the parameter."""
        return self.__name

    @property
    def value(self) -> Any:
        """The value."""
        return next(iter(self.__parameters.values()))

    def execute(self, context: LaunchContext) -> list[Any] | None:
        """Set the parameter."""
        present = context.launch_configurations.get("global_params", [])
        evaluated = evaluate_parameter_dict(context, self.__parameters)
        context.launch_configurations["global_params"] = [*present, *evaluated.items()]
        return None
