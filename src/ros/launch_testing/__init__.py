# SPDX-License-Identifier: Apache-2.0
"""Tests of launched systems: unittest classes that run while the processes are running, and after they have ended.

This package is used if no ROS installation is sourced. A ROS installation on the path takes precedence.
"""

from launch_testing import _pytest_session, actions, asserts, event_handlers, markers, tools, util
from launch_testing.decorator import post_shutdown_test
from launch_testing.io_handler import ActiveIoHandler, IoHandler
from launch_testing.parametrize import parametrize
from launch_testing.proc_info_handler import ActiveProcInfoHandler, ProcInfoHandler
from launch_testing.ready_aggregator import ReadyAggregator

__all__ = [
    "ActiveIoHandler",
    "ActiveProcInfoHandler",
    "IoHandler",
    "ProcInfoHandler",
    "ReadyAggregator",
    "actions",
    "asserts",
    "event_handlers",
    "markers",
    "parametrize",
    "post_shutdown_test",
    "tools",
    "util",
]

_pytest_session.add_plugin("launch_testing.pytest.hooks")
