# SPDX-License-Identifier: Apache-2.0
"""A process that runs until the shutdown."""

from __future__ import annotations

from typing import Any

from coframe._process.python_children import keep_alive_command
from launch.actions import ExecuteProcess

__all__ = ["KeepAliveProc"]


class KeepAliveProc(ExecuteProcess):
    """A process that does nothing until the shutdown, so that a launch without other processes continues.

    Args:
        options: Keyword arguments of ExecuteProcess.
    """

    def __init__(self, **options: Any) -> None:
        super().__init__(**{"cmd": keep_alive_command(), "name": "keep_alive", **options})
