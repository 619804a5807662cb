# SPDX-License-Identifier: Apache-2.0
"""The action UnsetLaunchConfiguration."""

from launch.actions.launch_configurations import UnsetLaunchConfiguration

__all__ = ["UnsetLaunchConfiguration"]
