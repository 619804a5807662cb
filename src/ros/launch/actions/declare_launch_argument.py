# SPDX-License-Identifier: Apache-2.0
"""The action that declares an argument of a launch file."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.action import Action
from launch.frontend.expose import expose_action
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from collections.abc import Iterable

    from launch.frontend import Entity, Parser
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType
    from launch.substitution import Substitution

__all__ = ["DeclareBooleanLaunchArgument", "DeclareLaunchArgument"]

_BOOLEANS = ("true", "false", "True", "False", "TRUE", "FALSE")


@expose_action("arg")
class DeclareLaunchArgument(Action):
    """Declare an argument, whose value is the launch configuration of the same name.

    Args:
        name: Name of the argument.
        default_value: Its value if it is not given; without one, the argument is required.
        description: Text for ``--show-args``.
        choices: The allowed values, or None for any value.
        condition: Declare it only if this condition holds.

    Raises:
        ValueError: `choices` is empty, or does not contain the default value.
    """

    def __init__(
        self,
        name: str,
        *,
        default_value: SomeSubstitutionsType | None = None,
        description: str | None = None,
        choices: Iterable[str] | None = None,
        **options: Any,
    ) -> None:
        super().__init__(**options)
        self.__name = name
        self.__default_value = None if default_value is None else normalize_to_list_of_substitutions(default_value)
        self.__choices = None if choices is None else list(choices)
        if self.__choices == []:
            raise ValueError(
                "Provided choices arg is empty. Use None instead of an empty list if there are no choices."
            )
        if isinstance(default_value, str) and self.__choices is not None and default_value not in self.__choices:
            raise ValueError(f'Provided default_value "{default_value}" is not in provided choices {self.__choices}.')
        self.__description = description or ("no description given" if self.__choices is None else "")
        if self.__choices is not None:
            listed = "', '".join(self.__choices)
            self.__description = f"{self.__description} Valid choices are: ['{listed}']".strip()
        # Arguments that are declared under a condition may be missing.
        self._conditionally_included = False

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[Action], dict[str, Any]]:
        """Read ``<arg name=... default=... description=...>``."""
        _, options = super().parse(entity, parser)
        options["name"] = parser.escape_characters(entity.get_attr("name"))
        default_value = entity.get_attr("default", optional=True)
        if default_value is not None:
            options["default_value"] = parser.parse_substitution(default_value)
        description = entity.get_attr("description", optional=True)
        if description is not None:
            options["description"] = parser.escape_characters(description)
        choices = entity.get_attr("choice", data_type=list, optional=True)
        if choices is not None:
            options["choices"] = [parser.escape_characters(choice.get_attr("value")) for choice in choices]
        return cls, options

    @property
    def name(self) -> str:
        """The name of the argument."""
        return self.__name

    @property
    def default_value(self) -> list[Substitution] | None:
        """The default value, or None for a required argument."""
        return self.__default_value

    @property
    def description(self) -> str:
        """The description."""
        return self.__description

    @property
    def choices(self) -> list[str] | None:
        """The allowed values, or None for any value."""
        return self.__choices

    def execute(self, context: LaunchContext) -> list[Any] | None:
        """Set the launch configuration to the default value, unless the argument was given."""
        if self.name not in context.launch_configurations:
            if self.default_value is None:
                raise RuntimeError(
                    f"Required launch argument '{self.name}' (description: '{self.description}') was not provided"
                )
            context.launch_configurations[self.name] = perform_substitutions(context, self.default_value)
        if self.__choices is not None:
            value = context.launch_configurations[self.name]
            if value not in self.__choices:
                listed = "', '".join(self.__choices)
                raise RuntimeError(
                    f'Argument "{self.name}" provided value "{value}" is not valid. Valid options are: [\'{listed}\']'
                )
        return None


@expose_action("bool_arg")
class DeclareBooleanLaunchArgument(DeclareLaunchArgument):
    """Declare an argument that is true or false.

    Args:
        name: Name of the argument.
        default_value: Its value if it is not given; without one, the argument is required.
        description: Text for ``--show-args``.
        condition: Declare it only if this condition holds.

    Raises:
        ValueError: The default value is not true or false, or `choices` is given.
    """

    def __init__(self, name: str, **options: Any) -> None:
        if options.pop("choices", None) is not None:
            raise ValueError("Cannot specify choices for bool_arg")
        default_value = options.get("default_value")
        if isinstance(default_value, bool):
            options["default_value"] = str(default_value).lower()
        super().__init__(name, choices=_BOOLEANS, **options)
