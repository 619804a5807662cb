# SPDX-License-Identifier: Apache-2.0
"""The action SetEnvironmentVariable."""

from launch.actions.environment import SetEnvironmentVariable

__all__ = ["SetEnvironmentVariable"]
