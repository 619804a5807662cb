# SPDX-License-Identifier: Apache-2.0
"""Run a console script that is not installed: ``python -m coframe.packages.entry_point MODULE:FUNCTION ...``.

A process that a launch has started ends with its launcher, even if that is killed.
"""

from __future__ import annotations

import ctypes
import functools
import importlib
import os
import signal
import sys
import threading
import time

__all__ = ["LAUNCHER", "main"]

# Environment variable with the process id of the launcher.
LAUNCHER = "COFRAME_LAUNCHER"
_PARENT_DEATH_SIGNAL = 1  # PR_SET_PDEATHSIG of Linux
_CHECK = 1.0  # seconds


def main() -> object:
    """Call the function in the first argument; the script sees its own file and arguments in ``sys.argv``."""
    if os.environ.get(LAUNCHER) == str(os.getppid()):
        _end_with_launcher()
    del sys.argv[0]
    del sys.path[0]  # The current folder, which an installed console script does not have on its path either.
    module_name, _, function = sys.argv[0].partition(":")
    # Ctrl-C during the imports ends the process at once: there is nothing to clean up, and no traceback to read.
    handler = signal.getsignal(signal.SIGINT)
    if handler is not signal.SIG_IGN:
        signal.signal(signal.SIGINT, signal.SIG_DFL)
    module = importlib.import_module(module_name)
    signal.signal(signal.SIGINT, handler)
    sys.argv[0] = module.__file__ or module_name
    call = functools.reduce(getattr, function.split("."), module)
    return call()  # type: ignore[operator]


def _end_with_launcher() -> None:
    """Let this process end when the launcher ends; Windows does not have parents in this sense."""
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(_PARENT_DEATH_SIGNAL, signal.SIGTERM)
    elif os.name == "posix":
        threading.Thread(target=_wait_for_launcher, name="end with launcher", daemon=True).start()


def _wait_for_launcher() -> None:
    launcher = os.getppid()
    while os.getppid() == launcher:
        time.sleep(_CHECK)
    os.kill(os.getpid(), signal.SIGTERM)


if __name__ == "__main__":
    sys.exit(main())  # type: ignore[arg-type]
