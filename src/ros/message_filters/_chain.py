# SPDX-License-Identifier: Apache-2.0
"""A filter that consists of other filters. Each filter receives the output of the previous one."""

from __future__ import annotations

from typing import Any

from message_filters._filters import SimpleFilter


class Chain(SimpleFilter):
    """A chain of filters. The callbacks receive the output of the last one.

    Args:
        *filters: The filters. Each but the first has a method `connectInput`.
    """

    def __init__(self, *filters: Any) -> None:
        super().__init__()
        self._filters: list[Any] = []
        for filter_ in filters:
            self.addFilter(filter_)

    def addFilter(self, filter_: Any) -> int:
        """Add a filter at the end, and return its index."""
        if self._filters:
            filter_.connectInput(self._filters[-1])
        self._filters.append(filter_)
        filter_.registerCallback(self._pass_on, len(self._filters) - 1)
        return len(self._filters) - 1

    def getFilter(self, index: int) -> Any:
        """Return the filter with an index, or None if there is none."""
        return self._filters[index] if 0 <= index < len(self._filters) else None

    def connectInput(self, f: SimpleFilter) -> None:
        """Pass the messages of a filter to the first filter of the chain."""
        self._filters[0].connectInput(f)

    def add(self, *messages: Any) -> None:
        """Pass a message to the first filter of the chain."""
        first = self._filters[0]
        (first.add if hasattr(first, "add") else first.signalMessage)(*messages)

    def _pass_on(self, *words: Any) -> None:
        *messages, index = words
        if index == len(self._filters) - 1:
            self.signalMessage(*messages)
