# SPDX-License-Identifier: Apache-2.0
"""Tools for tests of commands of ROS."""

from launch_testing_ros.tools.output import (
    basic_output_filter,
    get_rmw_output_filter,
)

__all__ = ["basic_output_filter", "get_rmw_output_filter"]
