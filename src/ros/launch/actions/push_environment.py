# SPDX-License-Identifier: Apache-2.0
"""The action PushEnvironment."""

from launch.actions.environment import PushEnvironment

__all__ = ["PushEnvironment"]
