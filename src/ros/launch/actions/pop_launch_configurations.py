# SPDX-License-Identifier: Apache-2.0
"""The action PopLaunchConfigurations."""

from launch.actions.launch_configurations import PopLaunchConfigurations

__all__ = ["PopLaunchConfigurations"]
