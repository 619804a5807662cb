# SPDX-License-Identifier: Apache-2.0
"""Actions of descriptions of tests of ROS systems."""

from launch_testing_ros.actions.enable_rmw_isolation import EnableRmwIsolation

__all__ = ["EnableRmwIsolation"]
