# SPDX-License-Identifier: Apache-2.0
"""The quality of service that a user requests for a display."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from coframe.viewer.protocol.common import Durability, Reliability

__all__ = ["AUTOMATIC", "RequestedQuality"]


@dataclass(frozen=True)
class RequestedQuality:
    """The quality of service that a user requests.

    Attributes:
        reliability: Whether lost messages are sent again; "automatic" if all publishers offer it.
        durability: Whether earlier messages are received; "automatic" if a publisher keeps them.
        depth: The number of messages that are kept until they are taken.
    """

    reliability: Reliability = "automatic"
    durability: Durability = "automatic"
    depth: int = 10

    @property
    def wants_earlier_messages(self) -> bool:
        """Whether earlier messages are requested from publishers that keep them, which requires reliable delivery."""
        if self.durability == "automatic":
            return self.reliability != "best_effort"
        return self.durability == "transient_local"


AUTOMATIC = RequestedQuality()
