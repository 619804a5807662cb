# SPDX-License-Identifier: Apache-2.0
"""What this machine offers a process that joins the ROS graph, for `coframe doctor --system`."""

from coframe.system.advice import advise
from coframe.system.examination import Advice
from coframe.system.report import SystemReport, collect

__all__ = ["Advice", "SystemReport", "advise", "collect"]
