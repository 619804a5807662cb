"""Runs a node that ends with whoever started it, however that one ended: ``python -m coframe.lab.run_node MODULE ...``.

The other end of its standard input is held by the launcher, and closes with it; also where it was killed.
"""

from __future__ import annotations

import os
import runpy
import signal
import sys
import threading


def _end_with_launcher() -> None:
    while os.read(0, 1024):
        pass
    os.kill(os.getpid(), signal.SIGTERM)


def main() -> None:
    """Runs the module named first with the arguments behind it."""
    threading.Thread(target=_end_with_launcher, name="end with launcher", daemon=True).start()
    del sys.argv[0]
    runpy.run_module(sys.argv[0], run_name="__main__", alter_sys=True)


if __name__ == "__main__":
    main()
