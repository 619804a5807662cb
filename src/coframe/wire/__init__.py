# SPDX-License-Identifier: Apache-2.0
"""Communication with the ROS 2 graph, over DDS or Zenoh.

The middleware is loaded when the process joins the graph, not when this package is imported.

Example:
    >>> participant = Participant.get()                                      # doctest: +SKIP
    >>> node = participant.add_node("/", "my_node")                          # doctest: +SKIP
    >>> participant.tf_reader(node, "/tf", buffer, static=False)             # doctest: +SKIP
    >>> participant.close()                                                  # doctest: +SKIP
"""

from coframe.wire.batch_subscription import BatchSubscription, MessageBatch
from coframe.wire.endpoints import GraphNode, Publisher, RawPublisher, Sample, Subscription
from coframe.wire.graph import EndpointInfo
from coframe.wire.participant import Participant
from coframe.wire.qos import QoS
from coframe.wire.static_broadcaster import StaticBroadcaster
from coframe.wire.tf_reader import TfReader, WriterStatistics

__all__ = [
    "BatchSubscription",
    "EndpointInfo",
    "GraphNode",
    "MessageBatch",
    "Participant",
    "Publisher",
    "QoS",
    "RawPublisher",
    "Sample",
    "StaticBroadcaster",
    "Subscription",
    "TfReader",
    "WriterStatistics",
]
