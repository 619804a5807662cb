# SPDX-License-Identifier: Apache-2.0
"""The action that includes a launch file."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import launch.logging
from launch.action import Action
from launch.actions.launch_configurations import SetLaunchConfiguration
from launch.actions.opaque_function import OpaqueFunction
from launch.frontend.expose import expose_action
from launch.launch_description_source import LaunchDescriptionSource
from launch.substitutions import TextSubstitution
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from collections.abc import Iterable

    from launch.frontend import Entity, Parser
    from launch.launch_context import LaunchContext
    from launch.launch_description import LaunchDescription
    from launch.launch_description_entity import LaunchDescriptionEntity
    from launch.some_substitutions_type import SomeSubstitutionsType

__all__ = ["IncludeLaunchDescription"]


@expose_action("include")
class IncludeLaunchDescription(Action):
    """Visit the launch description of another file.

    The launch configurations that it sets stay set afterwards; put the action in a GroupAction to avoid that.

    Args:
        launch_description_source: The source, or the path of a Python, XML or YAML launch file.
        launch_arguments: Pairs of names and values of its arguments.
        condition: Include it only if this condition holds.
    """

    def __init__(
        self,
        launch_description_source: LaunchDescriptionSource | SomeSubstitutionsType,
        *,
        launch_arguments: Iterable[tuple[SomeSubstitutionsType, SomeSubstitutionsType]] | None = None,
        **options: Any,
    ) -> None:
        super().__init__(**options)
        if not isinstance(launch_description_source, LaunchDescriptionSource):
            from launch.launch_description_sources import AnyLaunchDescriptionSource  # noqa: PLC0415 - a cycle

            launch_description_source = AnyLaunchDescriptionSource(launch_description_source)
        self.__source = launch_description_source
        self.__launch_arguments = tuple(launch_arguments or ())

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[Action], dict[str, Any]]:
        """Read ``<include file=...>`` with its ``<arg name=... value=...>`` or ``<let>``."""
        _, options = super().parse(entity, parser)
        options["launch_description_source"] = parser.parse_substitution(entity.get_attr("file"))
        arguments = []
        for tag in ("arg", "let"):
            for child in entity.get_attr(tag, data_type=list, optional=True) or []:
                name = parser.parse_substitution(child.get_attr("name"))
                arguments.append((name, parser.parse_substitution(child.get_attr("value"))))
                child.assert_entity_completely_parsed()
        return cls, options | {"launch_arguments": arguments}

    @property
    def launch_description_source(self) -> LaunchDescriptionSource:
        """The source of the launch description."""
        return self.__source

    @property
    def launch_arguments(self) -> tuple[tuple[SomeSubstitutionsType, SomeSubstitutionsType], ...]:
        """The arguments."""
        return self.__launch_arguments

    def describe(self) -> str:
        """Return a one-line description."""
        return f"IncludeLaunchDescription({self.__source.location})"

    def get_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """Return the launch description, if its file is known without a context."""
        found = self.__source.try_get_launch_description_without_context()
        return [] if found is None else [found]

    def describe_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """Return the launch description if its file is known. Errors are reported when the action is executed."""
        try:
            return super().describe_sub_entities()
        except Exception as error:  # noqa: BLE001 - a file that cannot be described may still never be included
            launch.logging.get_logger("launch").debug(f"{self.describe()} cannot be described: {error}")
            return []

    def execute(self, context: LaunchContext) -> list[Any] | None:
        """Return the launch description, after the actions that set its arguments."""
        description = self.__source.get_launch_description(context)
        previous = {
            name: context.get_locals_as_dict().get(name)
            for name in ("current_launch_file_path", "current_launch_file_directory")
        }
        location = self.__source.location
        context.extend_locals(
            {
                "current_launch_file_path": location,
                "current_launch_file_directory": location if location.startswith("<") else str(Path(location).parent),
            }
        )
        self.__check_arguments(context, description)
        return [
            *(SetLaunchConfiguration(name, value) for name, value in self.__launch_arguments),
            description,
            OpaqueFunction(function=lambda context: context.extend_locals(previous)),
        ]

    def __check_arguments(self, context: LaunchContext, description: LaunchDescription) -> None:
        """Check that all required arguments are given, as far as this is known before the description is visited."""
        given = {
            perform_substitutions(context, normalize_to_list_of_substitutions(name))
            for name, _ in self.__launch_arguments
        }
        for argument, includes in description.get_launch_arguments_with_include_launch_description_actions():
            if argument._conditionally_included or argument.default_value is not None:  # noqa: SLF001
                continue
            known = given.union(context.launch_configurations, *(_argument_names(each) for each in includes or ()))
            if argument.name not in known:
                raise RuntimeError(
                    f"Included launch description missing required argument '{argument.name}' "
                    f"(description: '{argument.description}'), given: [{', '.join(sorted(given))}]"
                )


def _argument_names(include: IncludeLaunchDescription) -> set[str]:
    """Return the names of the arguments of an action, as far as they are known without a context."""
    names = set()
    for name, _ in include.launch_arguments:
        parts = normalize_to_list_of_substitutions(name)
        names.add("".join(part.text if isinstance(part, TextSubstitution) else "" for part in parts))
    return names
