# SPDX-License-Identifier: Apache-2.0
"""A program that does nothing until SIGINT, or Ctrl-Break on Windows. It ends with exit code 0."""

import os
import signal
import time

_MAX_LIFETIME = 1 << 20  # seconds, 12 days

if __name__ == "__main__":
    signal.signal(getattr(signal, "SIGBREAK", signal.SIGINT), lambda *_: os._exit(0))
    time.sleep(_MAX_LIFETIME)
