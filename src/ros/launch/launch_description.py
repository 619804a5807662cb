# SPDX-License-Identifier: Apache-2.0
"""A launch description: a list of entities."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.launch_description_entity import LaunchDescriptionEntity

if TYPE_CHECKING:
    from collections.abc import Iterable

    from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription
    from launch.launch_context import LaunchContext

__all__ = ["LaunchDescription"]


class LaunchDescription(LaunchDescriptionEntity):
    """The entities of a system to launch, in the order in which they are visited.

    Args:
        initial_entities: The first entities.
        deprecated_reason: Why this description should no longer be used.
    """

    def __init__(
        self,
        initial_entities: Iterable[LaunchDescriptionEntity] | None = None,
        *,
        deprecated_reason: str | None = None,
    ) -> None:
        self.__entities = list(initial_entities or ())
        self.__deprecated_reason = deprecated_reason

    @property
    def entities(self) -> list[LaunchDescriptionEntity]:
        """The entities."""
        return self.__entities

    @property
    def deprecated(self) -> bool:
        """Whether the description is deprecated."""
        return self.__deprecated_reason is not None

    @property
    def deprecated_reason(self) -> str | None:
        """Why the description is deprecated, or None if it is not."""
        return self.__deprecated_reason

    def add_entity(self, entity: LaunchDescriptionEntity) -> None:
        """Add an entity at the end."""
        self.__entities.append(entity)

    def add_action(self, action: LaunchDescriptionEntity) -> None:
        """Add an action at the end."""
        self.add_entity(action)

    def describe_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """Return the entities."""
        return self.__entities

    def visit(self, context: LaunchContext) -> list[LaunchDescriptionEntity] | None:
        """Return the entities, which are visited next."""
        if self.deprecated:
            from launch.logging import get_logger  # noqa: PLC0415 - only few descriptions are deprecated

            location = getattr(context.locals, "current_launch_file_path", "<unknown>")
            get_logger("launch").warning(f"launch description [{location}] is deprecated: {self.deprecated_reason}")
        return self.__entities

    def get_launch_arguments(self, conditional_inclusion: bool = False) -> list[DeclareLaunchArgument]:
        """Return all declared arguments, including those of included launch files.

        Args:
            conditional_inclusion: Whether the description itself is included under a condition.
        """
        pairs = self.get_launch_arguments_with_include_launch_description_actions(conditional_inclusion)
        return [argument for argument, _ in pairs]

    def get_launch_arguments_with_include_launch_description_actions(
        self, conditional_inclusion: bool = False
    ) -> list[tuple[DeclareLaunchArgument, list[IncludeLaunchDescription] | None]]:
        """Return all declared arguments, each with the actions that include the file which declares it."""
        from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription  # noqa: PLC0415 - a cycle

        found: list[tuple[DeclareLaunchArgument, list[IncludeLaunchDescription] | None]] = []
        names: set[str] = set()

        def collect(
            entities: Iterable[LaunchDescriptionEntity], conditional: bool, includes: list[IncludeLaunchDescription]
        ) -> None:
            for entity in entities:
                if isinstance(entity, DeclareLaunchArgument):
                    if entity.name not in names:
                        names.add(entity.name)
                        entity._conditionally_included = conditional or entity.condition is not None  # noqa: SLF001
                        found.append((entity, includes or None))
                    continue
                deeper = [*includes, entity] if isinstance(entity, IncludeLaunchDescription) else includes
                collect(entity.describe_sub_entities(), conditional, deeper)
                for _, sub_entities in entity.describe_conditional_sub_entities():
                    collect(sub_entities, True, deeper)

        collect(self.__entities, conditional_inclusion, [])
        return found
