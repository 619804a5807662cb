"""Single keys as they are pressed, where standard input is a terminal."""

from __future__ import annotations

import contextlib
import importlib
import os
import re
import select
import sys
import time
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

__all__ = ["keys"]

# What terminals send for the arrows, and what Windows gives for them after the first byte.
_ARROWS = {"\x1b[A": "up", "\x1b[B": "down", "\x1b[C": "right", "\x1b[D": "left"}
_KEY = re.compile(r"\x1b\[[A-D]|.", re.DOTALL)
_WINDOWS_ARROWS = {"H": "up", "P": "down", "M": "right", "K": "left"}


@contextlib.contextmanager
def keys() -> Iterator[Callable[[float], str]]:
    """What gives the next key within so many seconds: "up", "right", a character, or "" if there was none."""
    if not sys.stdin.isatty():
        yield _none
    elif os.name == "nt":
        yield _windows_key
    else:
        with _unbuffered():
            yield _PosixKeys()


def _none(timeout: float) -> str:
    time.sleep(timeout)
    return ""


@contextlib.contextmanager
def _unbuffered() -> Iterator[None]:
    termios: Any = importlib.import_module("termios")
    tty: Any = importlib.import_module("tty")
    before = termios.tcgetattr(sys.stdin)
    tty.setcbreak(sys.stdin)
    try:
        yield
    finally:
        termios.tcsetattr(sys.stdin, termios.TCSADRAIN, before)


class _PosixKeys:
    """What was typed, key by key: several may come at once."""

    def __init__(self) -> None:
        self._typed: list[str] = []

    def __call__(self, timeout: float) -> str:
        if not self._typed and select.select([sys.stdin], [], [], timeout)[0]:
            text = os.read(sys.stdin.fileno(), 64).decode("utf-8", "replace")
            self._typed = _KEY.findall(text)
            if not text:  # the terminal has gone
                time.sleep(timeout)
        key = self._typed.pop(0) if self._typed else ""
        return _ARROWS.get(key, key)


def _windows_key(timeout: float) -> str:
    msvcrt: Any = importlib.import_module("msvcrt")
    end = time.monotonic() + timeout
    while not msvcrt.kbhit():
        if time.monotonic() >= end:
            return ""
        time.sleep(0.02)
    key: str = msvcrt.getwch()
    return _WINDOWS_ARROWS.get(msvcrt.getwch(), "") if key in {"\0", "\xe0"} else key
