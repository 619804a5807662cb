# SPDX-License-Identifier: Apache-2.0
"""The conditions that compare a launch configuration."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.condition import Condition
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType

__all__ = ["LaunchConfigurationEquals", "LaunchConfigurationNotEquals"]


class LaunchConfigurationEquals(Condition):
    """Holds if a launch configuration has a value. With None, if it is not set."""

    def __init__(self, launch_configuration_name: str, expected_value: SomeSubstitutionsType | None) -> None:
        self._name = launch_configuration_name
        self._expected = None if expected_value is None else normalize_to_list_of_substitutions(expected_value)
        super().__init__(predicate=self._evaluate)

    def _evaluate(self, context: LaunchContext) -> bool:
        expected = None if self._expected is None else perform_substitutions(context, self._expected)
        return bool(context.launch_configurations.get(self._name) == expected)


class LaunchConfigurationNotEquals(LaunchConfigurationEquals):
    """Holds if a launch configuration does not have a value. With None, if it is set."""

    def _evaluate(self, context: LaunchContext) -> bool:
        return not super()._evaluate(context)
