# SPDX-License-Identifier: Apache-2.0
"""Collects the parameters of a node from files of a package.

This package is used if no ROS installation is sourced. A ROS installation on the path takes precedence.
"""

from launch_param_builder.launch_param_builder import ParameterBuilder
from launch_param_builder.utils import ParameterBuilderFileNotFoundError, load_file, load_xacro, load_yaml

__all__ = ["ParameterBuilder", "ParameterBuilderFileNotFoundError", "load_file", "load_xacro", "load_yaml"]
