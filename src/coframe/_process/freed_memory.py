# SPDX-License-Identifier: Apache-2.0
"""Return freed memory to the system in long-running commands, and pause garbage collection."""

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
_MIN_BYTES = 128 << 10  # bytes; glibc starts with the same value and adapts it later


@contextmanager
def collection_paused() -> Iterator[None]:
    """Pause the cyclic garbage collector while a block creates many long-lived objects, such as thousands of topics.

    It would scan all of them repeatedly without freeing anything.
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
    so a process that computes with arrays of varying sizes grows for hours. Does nothing without glibc.
    """
    if (mallopt := _glibc_function("mallopt")) is not None:
        mallopt(_M_MMAP_THRESHOLD, _MIN_BYTES)


def return_freed_blocks() -> None:
    """Return all other freed memory to the system now, which takes a few milliseconds. Call it after a large task.

    By default, glibc returns only memory that is freed at the end of a heap. Does nothing without glibc.
    """
    if (malloc_trim := _glibc_function("malloc_trim")) is not None:
        malloc_trim(0)


@cache  # Each CDLL creates classes that stay in memory until the cyclic garbage collector runs.
def _glibc_function(name: str) -> Any:
    """Return a function of glibc, or None without glibc."""
    return getattr(ctypes.CDLL(None), name, None) if sys.platform == "linux" else None
