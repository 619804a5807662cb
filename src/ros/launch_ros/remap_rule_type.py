# SPDX-License-Identifier: Apache-2.0
"""The types of remapping rules in launch files."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeAlias

from launch.some_substitutions_type import SomeSubstitutionsType
from launch.substitution import Substitution

__all__ = ["RemapRule", "RemapRules", "SomeRemapRule", "SomeRemapRules"]

SomeRemapRule: TypeAlias = tuple[SomeSubstitutionsType, SomeSubstitutionsType]
SomeRemapRules: TypeAlias = Sequence[SomeRemapRule]
RemapRule: TypeAlias = tuple[tuple[Substitution, ...], tuple[Substitution, ...]]
RemapRules: TypeAlias = Sequence[RemapRule]
