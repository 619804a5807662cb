# SPDX-License-Identifier: Apache-2.0
"""Run the program named by the first argument: an uninstalled console script (``MODULE:FUNCTION``) or a Python file.

A process that a launch has started ends with its launcher, even if that is killed.
"""

from __future__ import annotations

import ctypes
import functools
import importlib
import os
import runpy
import signal
import sys
import threading
import time
from pathlib import Path

from coframe._process.signal_handlers import clear_handled_interrupt
from coframe.workspace import _finders

__all__ = ["LAUNCHER", "main"]

# Environment variable with the process id of the launcher.
LAUNCHER = "COFRAME_LAUNCHER"
_PARENT_DEATH_SIGNAL = 1  # PR_SET_PDEATHSIG of Linux
_CHECK = 1.0  # seconds


def main() -> object:
    """Run the program named by the first argument. It sees its own file and arguments in ``sys.argv``."""
    if os.environ.get(LAUNCHER) == str(os.getppid()):
        _end_with_launcher()
    del sys.argv[0]
    _finders.install()  # A package can have both Python code and messages.
    if Path(sys.argv[0]).is_absolute():
        _run_file(sys.argv[0])
        return None
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


def _run_file(file: str) -> None:
    """Run a Python file as ``python FILE`` does, with its folder first on `sys.path`."""
    sys.path.insert(0, str(Path(file).parent))
    runpy.run_path(file, run_name="__main__")


def _end_with_launcher() -> None:
    """End this process when its launcher ends; not supported on Windows."""
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
    try:
        sys.exit(main())  # type: ignore[arg-type]
    finally:
        clear_handled_interrupt()
