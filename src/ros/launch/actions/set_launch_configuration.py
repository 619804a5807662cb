# SPDX-License-Identifier: Apache-2.0
"""The action SetLaunchConfiguration."""

from launch.actions.launch_configurations import SetLaunchConfiguration

__all__ = ["SetLaunchConfiguration"]
