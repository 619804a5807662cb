# SPDX-License-Identifier: Apache-2.0
"""A launch description as a tree of text."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.actions import ExecuteLocal, RegisterEventHandler
from launch.launch_description import LaunchDescription

if TYPE_CHECKING:
    from launch.launch_description_entity import LaunchDescriptionEntity

__all__ = ["LaunchIntrospector"]


class LaunchIntrospector:
    """Describes launch descriptions without launching them."""

    def format_launch_description(self, launch_description: LaunchDescription) -> str:
        """Return the entities of a launch description as a tree."""
        return "\n".join([launch_description.describe(), *_lines(launch_description)])


def _lines(entity: LaunchDescriptionEntity) -> list[str]:
    texts = [[_description(each), *_lines(each)] for each in entity.describe_sub_entities()]
    for condition, entities in entity.describe_conditional_sub_entities():
        inner = [[_description(each), *_lines(each)] for each in entities]
        texts.append([condition, *_tree(inner)])
    return _tree(texts)


def _tree(texts: list[list[str]]) -> list[str]:
    """Return indented lines for several blocks of lines, whose first lines are the branches."""
    lines = []
    for number, (first, *rest) in enumerate(texts):
        is_last = number == len(texts) - 1
        lines.append(("└── " if is_last else "├── ") + first)
        lines += [("    " if is_last else "│   ") + line for line in rest]
    return lines


def _description(entity: LaunchDescriptionEntity) -> str:
    if isinstance(entity, LaunchDescription):
        return entity.describe()
    if isinstance(entity, RegisterEventHandler):
        return f"RegisterEventHandler('{entity.event_handler.describe()[0]}')"
    if isinstance(entity, ExecuteLocal):
        words = [" + ".join(part.describe() for part in word) for word in entity.process_description.cmd]
        return f"{type(entity).__name__}(cmd=[{', '.join(words)}], cwd={entity.cwd}, shell={entity.shell})"
    text = entity.describe()
    return f"{type(entity).__name__}()" if text.startswith("<") else text
