# SPDX-License-Identifier: Apache-2.0
"""Base class of everything that a launch description contains."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import asyncio

    from launch.launch_context import LaunchContext

__all__ = ["LaunchDescriptionEntity"]


class LaunchDescriptionEntity:
    """An action or a launch description, which is visited when the system is launched."""

    def describe(self) -> str:
        """Return a one-line description."""
        return self.__repr__()

    def describe_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """Return the entities that are always visited after this one."""
        return []

    def describe_conditional_sub_entities(self) -> list[tuple[str, Any]]:
        """Return pairs of a condition's description and the entities that are visited only if it holds."""
        return []

    def visit(self, context: LaunchContext) -> list[LaunchDescriptionEntity] | None:
        """Do the work of this entity and return the entities to visit next."""
        del context
        return None

    def get_asyncio_future(self) -> asyncio.Future[Any] | None:
        """Return the future that is done when the entity has finished, or None if it finishes in `visit`."""
        return None
