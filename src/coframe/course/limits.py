# SPDX-License-Identifier: Apache-2.0
"""Run a program with limits: ``python -m coframe.course.limits MEMORY OUTPUT CPU FILE ...``.

Limits of the operating system end a program that uses too much processor time or writes too much. The grader watches
memory and processes, because DDS reserves more address space than it uses.
"""

from __future__ import annotations

import runpy
import sys

__all__ = ["main"]

_MOST_FILES = 256
# The address space may be larger than the memory: threads and libraries reserve it.
_ADDRESS_SPACE = 8


def main() -> None:
    """Set the limits and run the program with its own arguments."""
    memory, output, cpu = (int(word) for word in sys.argv[1:4])
    try:
        import resource  # noqa: PLC0415 - not on Windows
    except ImportError:
        pass
    else:
        for limit, value in (
            (resource.RLIMIT_AS, memory * _ADDRESS_SPACE),
            (resource.RLIMIT_FSIZE, output),
            (resource.RLIMIT_CPU, cpu),
            (resource.RLIMIT_NOFILE, _MOST_FILES),
            (resource.RLIMIT_CORE, 0),
        ):
            resource.setrlimit(limit, (value, value))
    sys.argv = sys.argv[4:]
    sys.path[0] = str(sys.argv[0].rpartition("/")[0] or ".")
    runpy.run_path(sys.argv[0], run_name="__main__")


if __name__ == "__main__":
    main()
