# SPDX-License-Identifier: Apache-2.0
"""Return freed memory to the system, for commands that run for hours."""

from __future__ import annotations

import ctypes
import sys

__all__ = ["return_freed_arrays"]

_M_MMAP_THRESHOLD = -3
_SMALLEST = 1 << 20  # bytes


def return_freed_arrays() -> None:
    """Let this process return freed blocks of 1 MB or more to the system immediately.

    By default, glibc keeps blocks of up to 32 MB once one of that size was freed. Between them are small blocks in use,
    so a process that computes with arrays of varying sizes grows for hours. Without glibc, nothing is changed.
    """
    if sys.platform != "linux":
        return
    mallopt = getattr(ctypes.CDLL(None), "mallopt", None)
    if mallopt is not None:
        mallopt(_M_MMAP_THRESHOLD, _SMALLEST)
