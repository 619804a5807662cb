"""Joining the ROS 2 graph over DDS. Needs the package cyclonedds, but only when somebody joins.

Example:
    >>> participant = Participant.get()                                      # doctest: +SKIP
    >>> node = participant.add_node("/", "my_node")                          # doctest: +SKIP
    >>> participant.tf_reader(node, "/tf", buffer, static=False)             # doctest: +SKIP
    >>> participant.close()                                                  # doctest: +SKIP
"""

from coframe.wire.endpoints import (
    GraphNode,
    Publisher,
    RawPublisher,
    Sample,
    Subscription,
    Tap,
    TappedMessages,
    TfReader,
)
from coframe.wire.graph import Endpoint
from coframe.wire.participant import Participant
from coframe.wire.qos import QoS
from coframe.wire.statics import StaticWriter

__all__ = [
    "Endpoint",
    "GraphNode",
    "Participant",
    "Publisher",
    "QoS",
    "RawPublisher",
    "Sample",
    "StaticWriter",
    "Subscription",
    "Tap",
    "TappedMessages",
    "TfReader",
]
