# SPDX-License-Identifier: Apache-2.0
"""A process that runs until the shutdown."""

from __future__ import annotations

import sys
from typing import Any

from launch.actions import ExecuteProcess

__all__ = ["KeepAliveProc"]

# It ends with exit code 0 on SIGINT, or on Ctrl-Break on Windows; otherwise after 12 days.
_PROGRAM = (
    "import os, signal, time; "
    "signal.signal(getattr(signal, 'SIGBREAK', signal.SIGINT), lambda *_: os._exit(0)); "
    "time.sleep(2**20)"
)


class KeepAliveProc(ExecuteProcess):
    """A process that does nothing until the shutdown, so that a launch without other processes continues.

    Args:
        options: Keyword arguments of ExecuteProcess.
    """

    def __init__(self, **options: Any) -> None:
        super().__init__(**{"cmd": [sys.executable, "-S", "-c", _PROGRAM], "name": "keep_alive", **options})
