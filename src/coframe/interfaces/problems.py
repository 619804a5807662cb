# SPDX-License-Identifier: Apache-2.0
"""Report problems with files found in a search for interface packages, one line each, on standard error.

The search is part of imports, so it raises neither exceptions nor warnings, which a program can turn into errors.
"""

from __future__ import annotations

import sys
from contextlib import suppress

from coframe._output.escaping import one_line
from coframe._output.warn_once import WarnOnce

__all__ = ["report"]

MAX_PROBLEMS = 20  # per process; a folder can have any number of them


def _print(problem: str) -> None:
    with suppress(OSError, ValueError, AttributeError):  # The standard error is closed, or there is none.
        sys.stderr.write(f"coframe: {one_line(problem)}\n")


_print_once = WarnOnce(_print, MAX_PROBLEMS, "")


def report(problem: str) -> None:
    """Print a problem once."""
    _print_once(problem)
