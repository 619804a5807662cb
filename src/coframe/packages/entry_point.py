# SPDX-License-Identifier: Apache-2.0
"""Run a console script that is not installed: ``python -m coframe.packages.entry_point MODULE:FUNCTION ...``."""

from __future__ import annotations

import functools
import importlib
import sys

__all__ = ["main"]


def main() -> object:
    """Call the function in the first argument; the script sees its own file and arguments in ``sys.argv``."""
    del sys.argv[0]
    del sys.path[0]  # The current folder, which an installed console script does not have on its path either.
    module_name, _, function = sys.argv[0].partition(":")
    module = importlib.import_module(module_name)
    sys.argv[0] = module.__file__ or module_name
    call = functools.reduce(getattr, function.split("."), module)
    return call()  # type: ignore[operator]


if __name__ == "__main__":
    sys.exit(main())  # type: ignore[arg-type]
