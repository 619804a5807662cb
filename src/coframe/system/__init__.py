# SPDX-License-Identifier: Apache-2.0
"""Checks of this machine for processes that join the ROS graph, for `coframe doctor --system`."""

from coframe.system._middleware_check import SystemFinding
from coframe.system.advice import advise
from coframe.system.report import SystemReport, collect

__all__ = ["SystemFinding", "SystemReport", "advise", "collect"]
