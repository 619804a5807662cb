# SPDX-License-Identifier: Apache-2.0
"""Substitutions of launch files of MoveIt."""

from moveit_configs_utils.substitutions.xacro import Xacro

__all__ = ["Xacro"]
