# SPDX-License-Identifier: Apache-2.0
"""Return freed memory to the system, for commands that run for hours; pause the collector, for many new objects."""

from __future__ import annotations

import ctypes
import gc
import sys
from contextlib import contextmanager
from functools import cache
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["collection_paused", "return_freed_arrays", "return_freed_blocks"]

_M_MMAP_THRESHOLD = -3
_SMALLEST = 128 << 10  # bytes; also glibc's own value at first, before it adapts


@contextmanager
def collection_paused() -> Iterator[None]:
    """Pause the cyclic garbage collector while a block creates many objects that stay, such as thousands of topics.

    It would visit all of them again and again, and find nothing.
    """
    was_enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was_enabled:
            gc.enable()


def return_freed_arrays() -> None:
    """Let this process return freed blocks of 128 kB or more to the system immediately.

    By default, glibc keeps blocks of up to 32 MB once one of that size was freed. Between them are small blocks in use,
    so a process that computes with arrays of varying sizes grows for hours. Without glibc, nothing is changed.
    """
    if (mallopt := _function("mallopt")) is not None:
        mallopt(_M_MMAP_THRESHOLD, _SMALLEST)


def return_freed_blocks() -> None:
    """Return all other freed memory to the system now, which takes some milliseconds. Call it after a large task.

    By default, glibc returns only what is freed at the end of a heap. Without glibc, nothing is changed.
    """
    if (malloc_trim := _function("malloc_trim")) is not None:
        malloc_trim(0)


@cache  # Each CDLL makes classes that refer to each other, which stay until Python's cyclic garbage collector runs.
def _function(name: str) -> Any:
    """Return a function of glibc; None without glibc."""
    return getattr(ctypes.CDLL(None), name, None) if sys.platform == "linux" else None
