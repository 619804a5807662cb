# SPDX-License-Identifier: Apache-2.0
"""The conditions that depend on a truth value."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.condition import Condition
from launch.conditions.evaluate_condition_expression_impl import evaluate_condition_expression
from launch.utilities import normalize_to_list_of_substitutions

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType

__all__ = ["IfCondition", "UnlessCondition"]


class IfCondition(Condition):
    """Condition that holds if the substitutions evaluate to true."""

    def __init__(self, predicate_expression: SomeSubstitutionsType) -> None:
        self._expression = normalize_to_list_of_substitutions(predicate_expression)
        super().__init__(predicate=self._evaluate)

    def describe(self) -> str:
        """Return a one-line description."""
        return f"{type(self).__name__}({' + '.join(part.describe() for part in self._expression)})"

    def _evaluate(self, context: LaunchContext) -> bool:
        return evaluate_condition_expression(context, self._expression)


class UnlessCondition(IfCondition):
    """Condition that holds if the substitutions evaluate to false."""

    def _evaluate(self, context: LaunchContext) -> bool:
        return not super()._evaluate(context)
