# SPDX-License-Identifier: Apache-2.0
"""Run a program with limits: ``python -I -S limits.py OUTPUT CPU ADDRESS_SPACE HOME READABLE FILE ...``.

The operating system ends a program that uses too much processor time, and denies larger files. Where the kernel has
Landlock (Linux 5.13 or newer), the program and all processes that it starts can write only below HOME, and read only
the folders of READABLE. The grader limits memory, processes and the sum of all files. This file imports the standard
library only, because it runs before each program.
"""

from __future__ import annotations

import ctypes
import os
import struct
import sys
from contextlib import suppress
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Iterable

__all__ = ["landlock_version", "main"]

_MOST_FILES: Final = 256
# Kernel interface of Landlock, in linux/landlock.h; the numbers of the calls are the same on all processors.
_CREATE_RULESET, _ADD_RULE, _RESTRICT_SELF = 444, 445, 446
_VERSION_FLAG, _PATH_BENEATH, _NO_NEW_PRIVILEGES = 1, 1, 38
_RIGHTS: Final = {1: 0x1FFF, 2: 0x3FFF, 3: 0x7FFF, 5: 0xFFFF}  # all rights on files, by the first version with them
_READ, _READ_FILE = 0x1 | 0x4 | 0x8, 0x1 | 0x4  # execute, read a file, read a folder
_READ_WRITE_FILE: Final = 0x2 | 0x4
_SCOPES: Final = 0x1 | 0x2  # abstract sockets, and signals to processes outside, from version 6 on


def landlock_version() -> int:
    """Return the version of Landlock of the kernel; 0 if it has none."""
    if not sys.platform.startswith("linux"):
        return 0
    return max(0, _system_call(_CREATE_RULESET, None, 0, _VERSION_FLAG))


def main() -> None:
    """Set the limits, and replace this process by the program."""
    import resource  # noqa: PLC0415 - not on Windows, where landlock_version is used only

    output, cpu, address_space = (int(word) for word in sys.argv[1:4])
    home, readable, program = sys.argv[4], sys.argv[5].split(os.pathsep), sys.argv[6:]
    for limit, value in (
        (resource.RLIMIT_AS, address_space),
        (resource.RLIMIT_FSIZE, output),
        (resource.RLIMIT_CPU, cpu),
        (resource.RLIMIT_NOFILE, _MOST_FILES),
        (resource.RLIMIT_CORE, 0),
    ):
        with suppress(ValueError, OSError):  # macOS does not limit the address space.
            resource.setrlimit(limit, (value, value))
    if version := landlock_version():
        _restrict_files(version, home, readable)
    os.execv(sys.executable, [sys.executable, *program])  # noqa: S606 - the purpose of this file


def _restrict_files(version: int, home: str, readable: Iterable[str]) -> None:
    rights = _RIGHTS[max(first for first in _RIGHTS if first <= version)]
    content = struct.pack("QQQ", rights, 0, _SCOPES if version >= 6 else 0)
    ruleset = _system_call(_CREATE_RULESET, content, len(content), 0)
    if ruleset < 0:
        return
    _allow(ruleset, home, rights)
    _allow(ruleset, os.devnull, _READ_WRITE_FILE)
    for path in readable:
        _allow(ruleset, path, _READ if os.path.isdir(path) else _READ_FILE)  # noqa: PTH112 - without other imports
    ctypes.CDLL(None).prctl(_NO_NEW_PRIVILEGES, 1, 0, 0, 0)
    _system_call(_RESTRICT_SELF, ruleset, 0)
    os.close(ruleset)


def _allow(ruleset: int, path: str, rights: int) -> None:
    """Allow rights on a file, or on all that is below a folder; do nothing if it does not exist."""
    with suppress(OSError):
        file = os.open(path, os.O_PATH | os.O_CLOEXEC)
        _system_call(_ADD_RULE, ruleset, _PATH_BENEATH, struct.pack("=Qi", rights, file), 0)
        os.close(file)


def _system_call(number: int, *arguments: int | bytes | None) -> int:
    call = ctypes.CDLL(None).syscall
    call.restype = ctypes.c_long
    words = [ctypes.c_long(each) if isinstance(each, int) else each for each in arguments]
    return int(call(ctypes.c_long(number), *words))


if __name__ == "__main__":
    main()
