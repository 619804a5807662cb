# SPDX-License-Identifier: Apache-2.0
"""Substitutions that rewrite parameter files and other files of a launch."""

from nav2_common.launch.has_node_params import HasNodeParams
from nav2_common.launch.launch_config_as_bool import LaunchConfigAsBool
from nav2_common.launch.replace_string import ReplaceString
from nav2_common.launch.rewritten_yaml import RewrittenYaml

__all__ = ["HasNodeParams", "LaunchConfigAsBool", "ReplaceString", "RewrittenYaml"]
