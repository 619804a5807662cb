# SPDX-License-Identifier: Apache-2.0
"""Remapping rules in their general form."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.utilities import normalize_to_list_of_substitutions

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from launch.some_substitutions_type import SomeSubstitutionsType
    from launch_ros.remap_rule_type import RemapRule, SomeRemapRule

__all__ = ["normalize_remap_rule", "normalize_remap_rules"]


def normalize_remap_rule(remap_rule: SomeRemapRule | Iterable[SomeSubstitutionsType]) -> RemapRule:
    """Return a rule as two tuples of substitutions.

    Raises:
        TypeError: It is not a pair.
    """
    if isinstance(remap_rule, str) or len(parts := list(remap_rule)) != 2:
        raise TypeError(f"remap rule must be a tuple of two elements, got {remap_rule!r}")
    source, target = (tuple(normalize_to_list_of_substitutions(part)) for part in parts)
    return source, target


def normalize_remap_rules(remap_rules: Iterable[SomeRemapRule]) -> Iterator[RemapRule]:
    """Return several rules."""
    return (normalize_remap_rule(rule) for rule in remap_rules)
