# SPDX-License-Identifier: Apache-2.0
"""The action that sets the parameters of a file for all nodes after it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.action import Action
from launch.frontend.expose import expose_action
from launch_ros.parameter_descriptions import ParameterFile

if TYPE_CHECKING:
    from launch.frontend import Entity, Parser
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType

__all__ = ["SetParametersFromFile"]


@expose_action("set_parameters_from_file")
class SetParametersFromFile(Action):
    """Set the parameters of a file for all nodes after it in the same group.

    Args:
        filename: The file, or a ParameterFile.
        condition: Do it only if this condition holds.
    """

    def __init__(self, filename: SomeSubstitutionsType | ParameterFile, **options: Any) -> None:
        super().__init__(**options)
        self._input_file = filename if isinstance(filename, ParameterFile) else ParameterFile(filename)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[Action], dict[str, Any]]:
        """Read ``<set_parameters_from_file filename=...>``."""
        _, options = super().parse(entity, parser)
        return cls, options | {"filename": parser.parse_substitution(entity.get_attr("filename"))}

    def execute(self, context: LaunchContext) -> list[Any] | None:
        """Set the parameters."""
        present = context.launch_configurations.get("global_params", [])
        context.launch_configurations["global_params"] = [*present, str(self._input_file.evaluate(context))]
        return None
