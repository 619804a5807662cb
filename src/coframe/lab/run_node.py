# SPDX-License-Identifier: Apache-2.0
"""Run the node in the module given by the first argument. It stops when its launcher stops.

The launcher holds the other end of standard input, which is closed when the launcher exits, even if it is killed.
"""

from __future__ import annotations

import os
import runpy
import signal
import sys
import threading


def _stop_with_launcher() -> None:
    """Wait until standard input is closed, then stop this process."""
    while os.read(0, 1024):
        pass
    # On Windows, os.kill would end the process at once: other participants would see its node until its lease ends.
    main_thread = threading.main_thread().ident
    if main_thread is not None and hasattr(signal, "pthread_kill"):
        signal.pthread_kill(main_thread, signal.SIGTERM)
    else:
        signal.raise_signal(signal.SIGTERM)


def main() -> None:
    """Run the module in the first argument with the other arguments."""
    threading.Thread(target=_stop_with_launcher, name="stop with launcher", daemon=True).start()
    del sys.argv[0]
    runpy.run_module(sys.argv[0], run_name="__main__", alter_sys=True)


if __name__ == "__main__":
    main()
