# SPDX-License-Identifier: Apache-2.0
"""Updates, and the interface of the feeds that yield them. See :mod:`coframe.viewer.clients._feeds`."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple, Protocol

if TYPE_CHECKING:
    from collections.abc import Callable, Hashable, Iterator

__all__ = ["Feed", "Update"]


class Update(NamedTuple):
    """The newest message about one subject.

    Attributes:
        key: The subject, or None for a message that is sent in any case.
        version: A value that changes with the message.
        encode: Return the message.
    """

    key: Hashable
    version: object
    encode: Callable[[], str | bytes | bytearray]


class Feed(Protocol):
    """A source of updates for one client.

    Attributes:
        due: When the feed is to be checked for updates again, on the monotonic clock.
    """

    due: float

    def updates(self, now: float) -> Iterator[Update]:
        """Yield the newest messages at a time of the monotonic clock."""
