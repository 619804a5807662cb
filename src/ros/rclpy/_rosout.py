# SPDX-License-Identifier: Apache-2.0
"""Publisher of log messages on the topic /rosout."""

# The modules of rclpy share attributes named `_Coframe__x`, the form of mangled names.
# ruff: noqa: SLF001

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from coframe.messages import codec
from rcl_interfaces.msg import Log
from rclpy.constants import S_TO_NS
from rclpy.impl.console import Record, console
from rclpy.time import Time

if TYPE_CHECKING:
    from coframe.wire.endpoints import GraphNode
    from coframe.wire.participant import Participant
    from rclpy.qos import QoSProfile

_END_OF_STAMPS: Final = 2**31 * S_TO_NS


class RosoutPublisher:
    """Publisher of the messages that a node's logger and its child loggers log.

    Args:
        participant: The participant that creates the publisher.
        graph_node: The participant's graph entry of the node.
        logger_name: Name of the node's logger.
        qos: QoS profile of the publisher.
    """

    def __init__(self, participant: Participant, graph_node: GraphNode, logger_name: str, qos: QoSProfile) -> None:
        self._publisher = participant.publisher(graph_node, "/rosout", Log, qos._Coframe__to_wire())
        self._logger_name = logger_name
        # The bound method is stored, because `close` compares it by identity.
        self._sink = self._publish
        console.sinks[logger_name] = self._sink

    def close(self) -> None:
        """Stop publishing. If another node has the same name, that node continues to publish."""
        if console.sinks.get(self._logger_name) is self._sink:
            del console.sinks[self._logger_name]
        self._publisher.close()

    def _publish(self, record: Record) -> None:
        if self._publisher.closed:  # When the process exits, the participant is closed before the last log message.
            return
        if not 0 <= record.stamp < _END_OF_STAMPS:  # The system clock is wrong; the terminal shows the message.
            return
        message = Log(
            stamp=Time(nanoseconds=record.stamp).to_msg(),
            level=int(record.severity),
            name=record.name,
            msg=record.message,
            file=record.code.co_filename,
            function=record.code.co_name,
            line=record.line,
        )
        self._publisher.write(codec.serialize(message))
