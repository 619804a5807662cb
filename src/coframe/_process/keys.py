# SPDX-License-Identifier: Apache-2.0
"""Single key presses in a terminal."""

from __future__ import annotations

import contextlib
import os
import select
import sys
import time
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["Keys", "keys"]

_KEY_NAMES = {
    "\x1b[A": "up",
    "\x1b[B": "down",
    "\x1b[C": "right",
    "\x1b[D": "left",
    "\x1bOA": "up",
    "\x1bOB": "down",
    "\x1bOC": "right",
    "\x1bOD": "left",
    "\x1b[5~": "page up",
    "\x1b[6~": "page down",
    # The key codes on Windows.
    "\xe0H": "up",
    "\xe0P": "down",
    "\xe0M": "right",
    "\xe0K": "left",
    "\xe0I": "page up",
    "\xe0Q": "page down",
}


class Keys:
    """Reads key presses. Created by :func:`keys`."""

    def read(self, timeout: float) -> str | None:
        """Return the next key as a character or a name such as `up` or `page down`, or None after the timeout."""
        raise NotImplementedError


class _NoKeys(Keys):
    """Replacement when standard input is not a terminal: no key is ever pressed."""

    def read(self, timeout: float) -> None:
        time.sleep(timeout)


class _PosixKeys(Keys):
    def __init__(self, descriptor: int) -> None:
        self._file_descriptor = descriptor
        self._pending_input = ""

    def read(self, timeout: float) -> str | None:
        if not self._pending_input:
            if not select.select([self._file_descriptor], [], [], timeout)[0]:
                return None
            self._pending_input = os.read(self._file_descriptor, 1024).decode(errors="replace")
            if not self._pending_input:  # The terminal was closed.
                raise KeyboardInterrupt
        for sequence, name in _KEY_NAMES.items():
            if self._pending_input.startswith(sequence):
                self._pending_input = self._pending_input[len(sequence) :]
                return name
        key, self._pending_input = self._pending_input[0], self._pending_input[1:]
        return key


class _WindowsKeys(Keys):
    def read(self, timeout: float) -> str | None:
        import msvcrt  # noqa: PLC0415 - exists on Windows only

        end = time.monotonic() + timeout
        while not msvcrt.kbhit():  # type: ignore[attr-defined,unused-ignore]
            if time.monotonic() >= end:
                return None
            time.sleep(0.01)
        key: str = msvcrt.getwch()  # type: ignore[attr-defined,unused-ignore]
        if key in "\x00\xe0":
            key = "\xe0" + msvcrt.getwch()  # type: ignore[attr-defined,unused-ignore]
        return _KEY_NAMES.get(key, key)


@contextlib.contextmanager
def keys() -> Iterator[Keys]:
    """Read single keys without echo, and restore the terminal on exit."""
    if not sys.stdin.isatty():
        yield _NoKeys()
        return
    try:
        import termios  # noqa: PLC0415 - not on Windows
        import tty  # noqa: PLC0415
    except ModuleNotFoundError:
        yield _WindowsKeys()
        return
    descriptor = sys.stdin.fileno()
    before = termios.tcgetattr(descriptor)
    tty.setcbreak(descriptor)
    try:
        yield _PosixKeys(descriptor)
    finally:
        termios.tcsetattr(descriptor, termios.TCSADRAIN, before)
