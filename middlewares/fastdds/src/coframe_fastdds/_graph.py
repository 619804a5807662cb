# SPDX-License-Identifier: Apache-2.0
"""The ROS graph over Fast DDS."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any, Final

from coframe.wire.rtps.graph import DdsGraph

if TYPE_CHECKING:
    from coframe.wire._backend import BackendReader
    from coframe.wire.graph import DiscoveredEndpoint
    from coframe_fastdds import _fastdds as native

_SERVER: Final = "known to the discovery server"
_PERIODIC_DISCOVERY: Final = "Fast DDS, announced every 3 s"
_DISCOVERY_TIME: Final = 3.2  # seconds in which every other participant has announced itself


class FastDdsGraph(DdsGraph):
    """The graph of a DDS domain. All implementations of DDS are understood, because both forms of requests are.

    Args:
        participant: The participant, which discovers endpoints.
        info_reader: Receives the messages of the topic ros_discovery_info.
        has_server: Whether participants are discovered through a server.
    """

    def __init__(self, participant: native.Participant, info_reader: BackendReader, *, has_server: bool) -> None:
        super().__init__(
            participant.guid,
            info_reader,
            _Changes(participant.take_writers),
            _Changes(participant.take_readers),
            _Changes(participant.take_participants),
        )

        self._expected = _SERVER if has_server else _PERIODIC_DISCOVERY
        self._deadline = time.monotonic() + _DISCOVERY_TIME

    def unnamed_participants(self) -> list[str]:
        """Return the implementations of participants whose nodes are not known.

        Participants on Fast DDS that miss the first announcements find each other by the next ones. Until then, one is
        expected if there is none.
        """
        if unnamed := super().unnamed_participants():
            return unnamed
        is_expected = time.monotonic() < self._deadline and not self.participants()
        return [self._expected] if is_expected else []

    def foreign_services(self, peer: DiscoveredEndpoint) -> str:
        """Return "": this process understands both forms of requests."""
        del peer
        return ""


class _Changes:
    """The writers, readers or participants that a participant discovers.

    Implements `coframe.wire.rtps.graph.EndpointReader`.
    """

    def __init__(self, take: Any) -> None:
        self.take = take

    def close(self) -> None:
        """Stop."""
        self.take = list
