# SPDX-License-Identifier: Apache-2.0
"""The action LogInfo under the module name of ROS."""

from launch.actions.log import LogInfo

__all__ = ["LogInfo"]
