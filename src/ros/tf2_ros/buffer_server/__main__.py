"""A node that answers look-ups for others: ``python -m tf2_ros.buffer_server --ros-args -p buffer_size:=60.0``."""

import rclpy
from rclpy.duration import Duration
from rclpy.executors import ExternalShutdownException
from tf2_ros.buffer import Buffer
from tf2_ros.buffer_server import BufferServer
from tf2_ros.transform_listener import TransformListener


def main(args: list[str] | None = None) -> None:
    """Run the node `tf_buffer`, which serves the action `tf2_buffer_server`, until it is stopped.

    Its parameter `buffer_size` says for how many seconds transforms are kept, 120 by default.

    Args:
        args: The command line; None takes `sys.argv`.
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
