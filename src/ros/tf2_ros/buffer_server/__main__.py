# SPDX-License-Identifier: Apache-2.0
"""Node with a buffer server: ``python -m tf2_ros.buffer_server --ros-args -p buffer_size:=60.0``."""

import rclpy
from rclpy.duration import Duration
from rclpy.executors import ExternalShutdownException
from tf2_ros.buffer import Buffer
from tf2_ros.buffer_server import BufferServer
from tf2_ros.transform_listener import TransformListener


def main(args: list[str] | None = None) -> None:
    """Run the node `tf_buffer` with the action server `tf2_buffer_server` until shutdown.

    The parameter `buffer_size` is the cache time of the buffer in seconds. The default is 120.

    Args:
        args: Command line. None: `sys.argv`.
    """
    with rclpy.init(args=args):
        node = rclpy.create_node("tf_buffer")
        try:
            size = node.declare_parameter("buffer_size", 120.0).value
            buffer = Buffer(Duration(seconds=size))
            TransformListener(buffer, node)
            BufferServer(buffer, node, "tf2_buffer_server")
            rclpy.spin(node)
        except (KeyboardInterrupt, ExternalShutdownException):
            pass
        finally:
            node.destroy_node()


if __name__ == "__main__":
    main()
