# SPDX-License-Identifier: Apache-2.0
"""Arguments in their general form: lists of substitutions and lists of entities."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import PurePath
from typing import TYPE_CHECKING

from launch.substitution import Substitution

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.launch_description_entity import LaunchDescriptionEntity
    from launch.some_entities_type import SomeEntitiesType
    from launch.some_substitutions_type import SomeSubstitutionsType

__all__ = ["normalize_to_list_of_entities", "normalize_to_list_of_substitutions", "perform_substitutions"]


def normalize_to_list_of_substitutions(subs: SomeSubstitutionsType) -> list[Substitution]:
    """Return a string, a substitution or a sequence of them as a list of substitutions.

    Raises:
        TypeError: Something else is among them.
    """
    from launch.substitutions.text_substitution import TextSubstitution  # noqa: PLC0415 - a cycle

    def normalize(part: object) -> Substitution:
        if isinstance(part, str):
            return TextSubstitution(text=part)
        if isinstance(part, Substitution):
            return part
        if isinstance(part, PurePath):
            return TextSubstitution(text=str(part))
        raise TypeError(f"Failed to normalize given item of type '{type(part)}', when only strings were expected.")

    if isinstance(subs, Iterable) and not isinstance(subs, str | Substitution):
        return [normalize(part) for part in subs]
    return [normalize(subs)]


def perform_substitutions(context: LaunchContext, subs: Iterable[Substitution]) -> str:
    """Return the joined results of substitutions."""
    return "".join(context.perform_substitution(sub) for sub in subs)


def normalize_to_list_of_entities(entities: SomeEntitiesType | None) -> list[LaunchDescriptionEntity]:
    """Return an entity, or several in nested lists, as a list; None is an empty list."""
    if entities is None:
        return []
    if not isinstance(entities, Iterable):
        return [entities]
    return [entity for each in entities for entity in normalize_to_list_of_entities(each)]
