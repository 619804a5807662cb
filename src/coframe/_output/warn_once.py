# SPDX-License-Identifier: Apache-2.0
"""Warnings that are issued once."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Hashable

__all__ = ["LAST_WARNING", "MAX_WARNINGS", "WarnOnce"]

MAX_WARNINGS = 1000
"""The maximum number of warnings per process, because they contain names from the network."""

LAST_WARNING = f"No more warnings are shown: there were {MAX_WARNINGS}. Check which node creates these names."


class WarnOnce:
    """Passes on each warning only the first time, and at most a number of warnings in total.

    Args:
        warn: Called with each new warning.
        most: The maximum number of warnings.
        last: Passed on in place of the first one beyond that number; "": nothing.
    """

    def __init__(self, warn: Callable[[str], object], most: int = MAX_WARNINGS, last: str = LAST_WARNING) -> None:
        self._warn = warn
        self._most = most
        self._last = last
        self._keys: set[Hashable] = set()

    def __call__(self, text: str, key: Hashable = None, warn: Callable[[str], object] | None = None) -> None:
        """Pass on a warning unless it is empty or was already passed on.

        Args:
            text: The warning.
            key: What it is about; None: its text. Warnings with the same key are the same.
            warn: Called in place of the function of the constructor.
        """
        key = text if key is None else key
        if not text or self.knows(key):
            return
        self._keys.add(key)
        shown = text if len(self._keys) <= self._most else self._last
        if shown:
            (warn or self._warn)(shown)

    def knows(self, key: Hashable) -> bool:
        """Return whether a warning about something is not passed on: it was already, or there were too many."""
        return key in self._keys or len(self._keys) > self._most
