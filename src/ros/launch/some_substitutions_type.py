# SPDX-License-Identifier: Apache-2.0
"""The types that a text argument of an action may have."""

from collections.abc import Iterable
from typing import TypeAlias, Union

from launch.substitution import Substitution

__all__ = ["SomeSubstitutionsType", "SomeSubstitutionsType_types_tuple"]

SomeSubstitutionsType: TypeAlias = Union[str, Substitution, Iterable[Union[str, Substitution]]]  # noqa: UP007 - upstream's form
SomeSubstitutionsType_types_tuple = (str, Substitution, Iterable)
