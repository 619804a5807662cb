# SPDX-License-Identifier: Apache-2.0
"""The condition LaunchConfigurationNotEquals."""

from launch.conditions.launch_configuration_equals import LaunchConfigurationNotEquals

__all__ = ["LaunchConfigurationNotEquals"]
