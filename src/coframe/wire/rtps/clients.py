# SPDX-License-Identifier: Apache-2.0
"""Which endpoints of a service belong to one client.

rmw_cyclonedds_cpp puts an identifier of the client into the user data of its two endpoints, as coframe does. Endpoints
without one belong to the same client if they belong to the same participant.
"""

from __future__ import annotations

import os
import re
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Iterable

    from coframe.wire.graph import DiscoveredEndpoint

_SIZE: Final = 16  # bytes of an identifier
_CLIENT = re.compile(rb"(?:^|;)clientid=([^;]*);")


def client_user_data() -> str:
    """Return user data for the two endpoints of a new client."""
    return f"clientid={os.urandom(_SIZE).hex('.')};"


def receives_replies(readers: Iterable[DiscoveredEndpoint], writer: DiscoveredEndpoint | None) -> bool:
    """Return whether the subscription to replies of a client is among some readers.

    Args:
        readers: The readers.
        writer: The client's writer of requests. If it is not known, any reader may be that of the client.
    """
    if writer is None:
        return any(True for _ in readers)
    client = _client_of(writer)
    return any(
        reader.participant == writer.participant and (client is None or _client_of(reader) in (None, client))
        for reader in readers
    )


def _client_of(endpoint: DiscoveredEndpoint) -> bytes | None:
    found = _CLIENT.search(endpoint.user_data)
    return found[1] if found else None
