# SPDX-License-Identifier: Apache-2.0
"""The action PopEnvironment."""

from launch.actions.environment import PopEnvironment

__all__ = ["PopEnvironment"]
