# SPDX-License-Identifier: Apache-2.0
"""Actions for test descriptions of ROS systems."""

from launch_testing_ros.actions.enable_rmw_isolation import EnableRmwIsolation

__all__ = ["EnableRmwIsolation"]
