# SPDX-License-Identifier: Apache-2.0
"""The action UnsetEnvironmentVariable."""

from launch.actions.environment import UnsetEnvironmentVariable

__all__ = ["UnsetEnvironmentVariable"]
