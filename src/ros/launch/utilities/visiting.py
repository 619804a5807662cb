# SPDX-License-Identifier: Apache-2.0
"""Visit launch entities depth first: an entity, then the entities that it returns."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import asyncio

    from launch.launch_context import LaunchContext
    from launch.launch_description_entity import LaunchDescriptionEntity

__all__ = ["visit_all_entities_and_collect_futures"]


def visit_all_entities_and_collect_futures(
    entity: LaunchDescriptionEntity, context: LaunchContext
) -> list[tuple[LaunchDescriptionEntity, asyncio.Future[Any]]]:
    """Visit an entity and everything below it, and return the entities that finish later with their futures."""
    sub_entities = entity.visit(context)
    future = entity.get_asyncio_future()
    found = [] if future is None else [(entity, future)]
    for sub_entity in sub_entities or ():
        found += visit_all_entities_and_collect_futures(sub_entity, context)
    return found
