# SPDX-License-Identifier: Apache-2.0
"""Capture of the log of Debian's tf2, whose C++ code writes to the process's standard error."""

import os
import sys

LEVELS = {"Error": "error", "Warning": "warning"}


class Log:
    """Replaces the process's standard error; output from Python still goes to the original one."""

    def __init__(self):
        sys.stderr = os.fdopen(os.dup(2), "w")
        self.file = os.memfd_create("log")
        os.dup2(self.file, 2)

    def lines(self):
        """Return (level, text) of the lines logged since the last call."""
        size = os.lseek(self.file, 0, os.SEEK_CUR)
        if size == 0:
            return []
        text = os.pread(self.file, size, 0).decode()
        os.ftruncate(self.file, 0)
        os.lseek(self.file, 0, os.SEEK_SET)
        found = []
        for line in text.splitlines():
            level, colon, rest = line.partition(":")
            if colon and level in LEVELS:
                found.append((LEVELS[level], rest.lstrip()))
            elif not line.startswith("         at line "):
                found[-1] = (found[-1][0], found[-1][1] + "\n" + line)
        return found
