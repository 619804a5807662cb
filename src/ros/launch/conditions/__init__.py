# SPDX-License-Identifier: Apache-2.0
"""Conditions of actions."""

from launch.conditions.evaluate_condition_expression_impl import (
    InvalidConditionExpressionError,
    evaluate_condition_expression,
)
from launch.conditions.if_condition import IfCondition, UnlessCondition
from launch.conditions.launch_configuration_equals import (
    LaunchConfigurationEquals,
    LaunchConfigurationNotEquals,
)

__all__ = [
    "IfCondition",
    "InvalidConditionExpressionError",
    "LaunchConfigurationEquals",
    "LaunchConfigurationNotEquals",
    "UnlessCondition",
    "evaluate_condition_expression",
]
