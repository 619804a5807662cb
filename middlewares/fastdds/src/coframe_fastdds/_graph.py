# SPDX-License-Identifier: Apache-2.0
"""The ROS graph over Fast DDS."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from coframe.wire.rtps.graph import DdsGraph

if TYPE_CHECKING:
    from coframe.wire._backend import BackendReader
    from coframe.wire.graph import DiscoveredEndpoint
    from coframe_fastdds import _fastdds as native


class FastDdsGraph(DdsGraph):
    """The graph of a DDS domain. All implementations of DDS are understood, because both forms of requests are.

    Args:
        participant: The participant, which discovers endpoints.
        info_reader: Receives the messages of the topic ros_discovery_info.
    """

    def __init__(self, participant: native.Participant, info_reader: BackendReader) -> None:
        super().__init__(info_reader, _Changes(participant.take_writers), _Changes(participant.take_readers))

    def foreign_services(self, peer: DiscoveredEndpoint) -> str:
        """Return "": this process understands both forms of requests."""
        del peer
        return ""


class _Changes:
    """The writers or the readers that a participant discovers. Implements `coframe.wire.rtps.graph.EndpointReader`."""

    def __init__(self, take: Any) -> None:
        self.take = take

    def close(self) -> None:
        """Stop."""
        self.take = list
