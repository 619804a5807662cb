# SPDX-License-Identifier: Apache-2.0
"""Warnings that are issued once."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable


MAX_WARNINGS = 1000
"""The most warnings of a process: their texts contain names from the network, of which there can be any number."""

LAST_WARNING = f"Further warnings are not shown: there were {MAX_WARNINGS}. Check which node creates these names."


class WarnOnce:
    """A function that passes on each warning the first time only, and at most `MAX_WARNINGS`.

    Args:
        warn: Called with the text of each new warning.
    """

    def __init__(self, warn: Callable[[str], None]) -> None:
        self._warn = warn
        self._keys: set[str] = set()

    def __call__(self, key: str, text: str) -> None:
        """Pass on `text`, unless it is empty or a warning with the same key was passed on before."""
        if not text or key in self._keys or len(self._keys) > MAX_WARNINGS:
            return
        self._keys.add(key)
        self._warn(text if len(self._keys) <= MAX_WARNINGS else LAST_WARNING)
