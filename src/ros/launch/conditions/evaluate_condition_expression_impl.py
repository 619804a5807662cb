# SPDX-License-Identifier: Apache-2.0
"""The truth value of a condition given as a string."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.utilities import perform_substitutions

if TYPE_CHECKING:
    from collections.abc import Iterable

    from launch.launch_context import LaunchContext
    from launch.substitution import Substitution

__all__ = ["InvalidConditionExpressionError", "evaluate_condition_expression"]

VALID_TRUE_EXPRESSIONS = ["true", "1"]
VALID_FALSE_EXPRESSIONS = ["false", "0"]


class InvalidConditionExpressionError(RuntimeError):
    """A condition that is neither true nor false."""


def evaluate_condition_expression(context: LaunchContext, expression: Iterable[Substitution]) -> bool:
    """Return the truth value of a string: ``true`` or ``1``, ``false`` or ``0``, in upper or lower case.

    Raises:
        InvalidConditionExpressionError: It is something else.
    """
    text = perform_substitutions(context, expression)
    word = text.strip().lower()
    if word in VALID_TRUE_EXPRESSIONS:
        return True
    if word in VALID_FALSE_EXPRESSIONS:
        return False
    valid = VALID_TRUE_EXPRESSIONS + VALID_FALSE_EXPRESSIONS
    raise InvalidConditionExpressionError(f"invalid condition expression '{text}', expected one of: {valid}")
