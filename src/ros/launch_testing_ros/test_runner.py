# SPDX-License-Identifier: Apache-2.0
"""Launches test descriptions of ROS systems and runs their tests."""

from __future__ import annotations

import launch_testing.test_runner

__all__ = ["LaunchTestRunner"]


class LaunchTestRunner(launch_testing.test_runner.LaunchTestRunner):
    """Runs the tests of a file; its processes are nodes."""
