"""Log messages on the topic /rosout."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe.messages import codec
from rcl_interfaces.msg import Log

from rclpy.impl.console import Record, console
from rclpy.qos import qos_profile_rosout_default
from rclpy.time import Time

if TYPE_CHECKING:
    from coframe.wire import GraphNode, Participant


class RosoutPublisher:
    """Publishes what a node's logger and its children log.

    Args:
        wire: The DDS participant.
        graph_node: The node in it.
        logger_name: Name of the node's logger.
    """

    def __init__(self, wire: Participant, graph_node: GraphNode, logger_name: str) -> None:
        self._publisher = wire.publisher(graph_node, "/rosout", Log, qos_profile_rosout_default._to_wire())
        self._logger_name = logger_name
        # Bound once: it is compared by identity when it is taken back.
        self._sink = self._publish
        console.sinks[logger_name] = self._sink

    def close(self) -> None:
        """Ends the publishing; of two nodes of one name, the other's goes on."""
        if console.sinks.get(self._logger_name) is self._sink:
            del console.sinks[self._logger_name]
        self._publisher.close()

    def _publish(self, record: Record) -> None:
        if self._publisher.closed:  # at the end of the process DDS is gone before the last log message
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
