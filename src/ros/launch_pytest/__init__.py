# SPDX-License-Identifier: Apache-2.0
"""Tests of launched systems as functions of pytest.

This package is used if no ROS installation is sourced. A ROS installation on the path takes precedence.
"""

from launch_testing._pytest_session import add_plugin, require_pytest

require_pytest("launch_pytest")

from launch_pytest import actions, tools
from launch_pytest.fixture import fixture

__all__ = ["actions", "fixture", "tools"]

add_plugin("launch_pytest.plugin")
