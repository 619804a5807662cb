# SPDX-License-Identifier: Apache-2.0
"""Runs a command in a terminal, or with its output in a pipe, until it ends or has shown enough."""

import contextlib
import fcntl
import os
import pty
import select
import signal
import struct
import subprocess
import sys
import termios
import time

SCREEN = struct.pack("HHHH", 60, 300, 0, 0)  # rows and columns
TIMEOUT = 60.0  # seconds
ENOUGH = 1.0  # seconds of output after the first hostile text
TO_PIPE = 12.0  # seconds; what is updated in a terminal is printed into a pipe only at the end


def run(words, environment, *, until="", in_terminal=True):
    """Return the output on both streams and the exit code; with `until`, Ctrl-C follows a second after this text."""
    reader, writer = pty.openpty() if in_terminal else os.pipe()
    if in_terminal:
        fcntl.ioctl(writer, termios.TIOCSWINSZ, SCREEN)
    environment = {**environment, "TERM": "xterm-256color", "PYTHONUNBUFFERED": "1"}
    command = [sys.executable, "-m", "coframe.cli", *words]
    begun = time.monotonic()
    received, deadline = b"", begun + TIMEOUT
    interrupt_at = begun + TO_PIPE if until and not in_terminal else None
    source = writer if in_terminal else subprocess.DEVNULL
    with subprocess.Popen(command, env=environment, stdin=source, stdout=writer, stderr=writer) as process:
        os.close(writer)
        try:
            while part := _read(reader, 0.1):
                received += part
                now = time.monotonic()
                if until and until.encode() in received:
                    interrupt_at = min(interrupt_at or deadline, now + ENOUGH)
                if interrupt_at is not None and now > interrupt_at:
                    process.send_signal(signal.SIGINT)
                    until, interrupt_at = "", None
                assert now < deadline, f"{words} did not end; it printed {received[-2000:]!r}"
        finally:
            if process.poll() is None and time.monotonic() > deadline:
                process.kill()
            os.close(reader)
    return received.replace(b" \b", b"").decode(errors="replace"), process.returncode


def _read(reader, timeout):
    """Return what was written, a byte that is removed later if nothing was, or nothing at the end."""
    if not select.select([reader], [], [], timeout)[0]:
        return b" \b"
    with contextlib.suppress(OSError):  # a terminal whose process has ended
        return os.read(reader, 1 << 16)
    return b""
