# SPDX-License-Identifier: Apache-2.0
"""The types of arguments that take one or more entities."""

from collections.abc import Iterable
from typing import TypeAlias, Union

from launch.launch_description_entity import LaunchDescriptionEntity

__all__ = ["SomeEntitiesType", "SomeEntitiesType_types_tuple"]

SomeEntitiesType: TypeAlias = Union[LaunchDescriptionEntity, Iterable[LaunchDescriptionEntity]]  # noqa: UP007 - upstream's form
SomeEntitiesType_types_tuple = (LaunchDescriptionEntity, Iterable)
