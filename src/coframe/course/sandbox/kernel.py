# SPDX-License-Identifier: Apache-2.0
"""Functions of the C library and Linux system calls that Python does not provide."""

from __future__ import annotations

import ctypes
import errno
import functools
import os

__all__ = ["c_function", "control_process", "system_call"]


@functools.cache
def _library() -> ctypes.CDLL:
    return ctypes.CDLL(None, use_errno=True)


def c_function(name: str, *arguments: int | bytes | None) -> int:
    """Call a function of the C library with integers of type long, and return its result.

    Raises:
        OSError: It returns a negative number, or is not available on this system.
    """
    try:
        function = _library()[name]
    except AttributeError:
        raise OSError(errno.ENOSYS, os.strerror(errno.ENOSYS), name) from None
    function.restype = ctypes.c_long
    words = [ctypes.c_long(each) if isinstance(each, int) else each for each in arguments]
    result = int(function(*words))
    # Functions that return an int leave the upper half of the register undefined.
    if name != "syscall":
        result = ctypes.c_int(result).value
    if result < 0:
        error = ctypes.get_errno()
        raise OSError(error, os.strerror(error), name)
    return result


def system_call(number: int, *arguments: int | bytes | None) -> int:
    """Make a system call and return its result.

    Raises:
        OSError: It fails.
    """
    return c_function("syscall", number, *arguments)


def control_process(option: int, value: int = 0, third: int | bytes = 0) -> int:
    """Call ``prctl``.

    Raises:
        OSError: It fails.
    """
    return c_function("prctl", option, value, third, 0, 0)
