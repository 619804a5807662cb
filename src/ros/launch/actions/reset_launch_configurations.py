# SPDX-License-Identifier: Apache-2.0
"""The action ResetLaunchConfigurations."""

from launch.actions.launch_configurations import ResetLaunchConfigurations

__all__ = ["ResetLaunchConfigurations"]
