# SPDX-License-Identifier: Apache-2.0
"""Warnings that are issued once."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable


class WarnOnce:
    """A function that passes on each warning the first time only.

    Args:
        warn: Called with the text of each new warning.
    """

    # The texts contain names from the network, so their number must have a limit.
    _LIMIT = 1000

    def __init__(self, warn: Callable[[str], None]) -> None:
        self._warn = warn
        self._keys: set[str] = set()

    def __call__(self, key: str, text: str) -> None:
        """Pass on `text`, unless it is empty or a warning with the same key was passed on before."""
        if text and key not in self._keys and len(self._keys) < self._LIMIT:
            self._keys.add(key)
            self._warn(text)
