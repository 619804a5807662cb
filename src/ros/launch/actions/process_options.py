# SPDX-License-Identifier: Apache-2.0
"""The values of the options of processes, which may be substitutions."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.conditions import evaluate_condition_expression
from launch.substitutions import LaunchConfiguration
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType
    from launch.substitution import Substitution

__all__ = ["performed_bool", "performed_float", "performed_output", "timeout"]


def timeout(seconds: SomeSubstitutionsType | float | None, name: str) -> list[Substitution]:
    """Return a timeout in seconds as substitutions. Its default is a launch configuration, or 5 s."""
    if seconds is None:
        return [LaunchConfiguration(name, default="5")]
    return normalize_to_list_of_substitutions(str(seconds) if isinstance(seconds, int | float) else seconds)


def performed_text(context: LaunchContext, value: Any) -> str:
    """Return an option as a string."""
    return perform_substitutions(context, normalize_to_list_of_substitutions(value))


def performed_float(context: LaunchContext, value: Any) -> float:
    """Return the value of a numeric option."""
    return float(value) if isinstance(value, int | float) else float(performed_text(context, value))


def performed_bool(context: LaunchContext, value: Any) -> bool:
    """Return the truth value of an option."""
    if isinstance(value, bool):
        return value
    return evaluate_condition_expression(context, normalize_to_list_of_substitutions(value))


def performed_output(context: LaunchContext, output: Any) -> Any:
    """Return where the output goes: a keyword or a dictionary."""
    if isinstance(output, dict):
        return output
    return performed_text(context, output)
