# SPDX-License-Identifier: Apache-2.0
"""The action ResetEnvironment."""

from launch.actions.environment import ResetEnvironment

__all__ = ["ResetEnvironment"]
