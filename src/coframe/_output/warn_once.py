# SPDX-License-Identifier: Apache-2.0
"""Warnings that are issued once."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Hashable

__all__ = ["LAST_WARNING", "MAX_WARNINGS", "WarnOnce"]

MAX_WARNINGS = 1000
"""The maximum number of warnings per process, because they contain names from the network."""

LAST_WARNING = f"No more warnings are shown after the first {MAX_WARNINGS}. Check which node creates these names."


class WarnOnce:
    """Issues each warning only once, up to a maximum number of warnings.

    Args:
        warn: Called with each new warning.
        most: The maximum number of warnings.
        last: Issued once instead of the first warning beyond that number, or "" for none.
    """

    def __init__(self, warn: Callable[[str], object], limit: int = MAX_WARNINGS, last: str = LAST_WARNING) -> None:
        self._warn = warn
        self._max_warnings = limit
        self._last = last
        self._keys: set[Hashable] = set()

    def __call__(self, text: str, key: Hashable = None, warn: Callable[[str], object] | None = None) -> None:
        """Issue a warning unless it is empty or was already issued.

        Args:
            text: The warning.
            key: Identifies the warning, by default by its text. Warnings with the same key are issued once.
            warn: Called instead of the function given to the constructor.
        """
        key = text if key is None else key
        if not text or self.is_suppressed(key):
            return
        self._keys.add(key)
        shown = text if len(self._keys) <= self._max_warnings else self._last
        if shown:
            (warn or self._warn)(shown)

    def is_suppressed(self, key: Hashable) -> bool:
        """Return whether a warning with this key is suppressed: it was already issued, or there were too many."""
        return key in self._keys or len(self._keys) > self._max_warnings
