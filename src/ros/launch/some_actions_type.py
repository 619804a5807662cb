# SPDX-License-Identifier: Apache-2.0
"""The former name of the types in `launch.some_entities_type`."""

from launch.some_entities_type import SomeEntitiesType, SomeEntitiesType_types_tuple

__all__ = ["SomeActionsType", "SomeActionsType_types_tuple"]

SomeActionsType = SomeEntitiesType
SomeActionsType_types_tuple = SomeEntitiesType_types_tuple
