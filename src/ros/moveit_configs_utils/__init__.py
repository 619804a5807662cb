# SPDX-License-Identifier: Apache-2.0
"""The parameters and launch descriptions of MoveIt, from the configuration package of a robot.

This package is used if no ROS installation is sourced. A ROS installation on the path takes precedence.
"""

from moveit_configs_utils.moveit_configs_builder import MoveItConfigs, MoveItConfigsBuilder

__all__ = ["MoveItConfigs", "MoveItConfigsBuilder"]
