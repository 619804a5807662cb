# SPDX-License-Identifier: Apache-2.0
"""Warnings about requests and replies that were ignored."""

from __future__ import annotations

import time
import weakref
from typing import TYPE_CHECKING, Final

from coframe.wire.service_endpoints import ServiceSubscription

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from coframe.wire.endpoints import LocalEndpoint

_REPEAT_AFTER: Final = 10.0  # seconds


class IgnoredMessageMonitor:
    """Warns about requests and replies that were ignored, with their number, at most every 10 s for each service.

    Args:
        warn: Called with the text of each warning.
    """

    def __init__(self, warn: Callable[[str], None]) -> None:
        self._warn = warn
        self._warned_at: weakref.WeakKeyDictionary[ServiceSubscription, float] = weakref.WeakKeyDictionary()

    def check(self, endpoints: Iterable[LocalEndpoint]) -> None:
        """Warn about messages that `endpoints` have ignored since the last warning."""
        now = time.monotonic()
        for endpoint in endpoints:
            if not isinstance(endpoint, ServiceSubscription) or now < self._warned_at.get(endpoint, 0) + _REPEAT_AFTER:
                continue
            if text := endpoint.take_warning():
                self._warned_at[endpoint] = now
                self._warn(text)
