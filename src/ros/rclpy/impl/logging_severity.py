# SPDX-License-Identifier: Apache-2.0
"""Severity levels of log messages."""

from __future__ import annotations

from enum import IntEnum
from functools import partial

from rclpy import _absent


class LoggingSeverity(IntEnum):
    """Severity of a log message."""

    UNSET = 0
    DEBUG = 10
    INFO = 20
    WARN = 30
    ERROR = 40
    FATAL = 50


__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports
