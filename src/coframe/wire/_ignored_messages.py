# SPDX-License-Identifier: Apache-2.0
"""Warnings about requests and replies that were ignored."""

from __future__ import annotations

import time
import weakref
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from coframe.wire.endpoints import LocalEndpoint

_COLLECTION_TIME: Final = 1.0  # seconds to wait after the first one, so that the warning contains the total number
_REPEAT_AFTER: Final = 10.0  # seconds


class IgnoredMessageMonitor:
    """Warns about ignored requests and replies, with their number, at most every 10 s per service.

    Args:
        warn: Called with each warning.
    """

    def __init__(self, warn: Callable[[str], None]) -> None:
        self._warn = warn
        # When the next warning about an endpoint may be issued.
        self._due: weakref.WeakKeyDictionary[LocalEndpoint, float] = weakref.WeakKeyDictionary()

    def check(self, endpoints: Iterable[LocalEndpoint]) -> None:
        """Warn about messages that `endpoints` ignored since the last warning."""
        now = time.monotonic()
        for endpoint in endpoints:
            if not endpoint.has_warning:
                continue
            if now >= self._due.setdefault(endpoint, now + _COLLECTION_TIME):
                self._due[endpoint] = now + _REPEAT_AFTER
                self._warn(endpoint.take_warning())
