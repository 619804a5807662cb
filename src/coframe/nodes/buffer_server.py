# SPDX-License-Identifier: Apache-2.0
"""The node tf2_buffer, which answers lookups of other nodes by the action tf2_buffer_server."""

from __future__ import annotations

from typing import Any

from coframe.nodes.program import program, spin_until_shutdown
from rclpy.duration import Duration
from rclpy.node import Node
from tf2_ros import Buffer, BufferServer, TransformListener

__all__ = ["BufferServerNode", "main"]


class BufferServerNode(Node):
    """Node with a buffer of the last `buffer_size` seconds, 120 by default, and a BufferServer."""

    def __init__(self, **options: Any) -> None:
        super().__init__("tf2_buffer", **options)
        seconds = float(self.declare_parameter("buffer_size", 120.0).value)
        self.__buffer = Buffer(cache_time=Duration(seconds=seconds))
        self.__listener = TransformListener(self.__buffer, self)
        self.__server = BufferServer(self.__buffer, self, "tf2_buffer_server")


def main(args: list[str] | None = None) -> None:
    """Run the node until shutdown."""
    program("buffer_server", args, lambda words, _: spin_until_shutdown(BufferServerNode, words, None))


if __name__ == "__main__":
    main()
