# SPDX-License-Identifier: Apache-2.0
"""The action PushLaunchConfigurations."""

from launch.actions.launch_configurations import PushLaunchConfigurations

__all__ = ["PushLaunchConfigurations"]
