# SPDX-License-Identifier: Apache-2.0
"""Warnings that are issued once."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable


MAX_WARNINGS = 1000
"""The maximum number of warnings per process, because they contain names from the network."""

LAST_WARNING = f"No more warnings are shown: there were {MAX_WARNINGS}. Check which node creates these names."


class WarnOnce:
    """Passes on each warning only the first time, and at most `MAX_WARNINGS` in total.

    Args:
        warn: Called with each new warning.
    """

    def __init__(self, warn: Callable[[str], None]) -> None:
        self._warn = warn
        self._keys: set[str] = set()

    def __call__(self, key: str, text: str) -> None:
        """Pass on `text` unless it is empty or a warning with the same key was already passed on."""
        if not text or key in self._keys or len(self._keys) > MAX_WARNINGS:
            return
        self._keys.add(key)
        self._warn(text if len(self._keys) <= MAX_WARNINGS else LAST_WARNING)
