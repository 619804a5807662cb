"""What Debian's tf2 logs: its C++ writes to the process's standard error, whatever Python thinks that is."""

import os
import sys

LEVELS = {"Error": "error", "Warning": "warning"}


class Log:
    """Takes the place of standard error; Python's own words still go where they belong."""

    def __init__(self):
        sys.stderr = os.fdopen(os.dup(2), "w")
        self.file = os.memfd_create("log")
        os.dup2(self.file, 2)

    def lines(self):
        """(level, text) of what was logged since the last call."""
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
