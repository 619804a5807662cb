#!/usr/bin/env python3
"""Listens to transforms and publishes the pose of the end effector.

Try it:
    tf_listener --ros-args -p source_frame:=camera_link

Parameters:
    rate: poses per second
    target_frame: frame the pose is expressed in
    source_frame: frame whose pose it is
    pose_topic: where the pose is published
"""

import sys
from collections.abc import Sequence

import rclpy
from geometry_msgs.msg import PointStamped, PoseStamped
from rclpy.duration import Duration
from rclpy.exceptions import NameValidationException, ParameterException
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.time import Time
from tf2_geometry_msgs import do_transform_point
from tf2_ros import Buffer, TransformException, TransformListener


class TransformListenerNode(Node):
    """Listen to transforms and compute poses."""

    def __init__(self) -> None:
        super().__init__("tf_listener")
        rate = self.declare_parameter("rate", 10.0).value
        if not rate > 0.0:
            raise ValueError(f"parameter 'rate' must be more than 0 per second, but is {rate}")
        self.target_frame = self.declare_parameter("target_frame", "base_link").value
        self.source_frame = self.declare_parameter("source_frame", "end_effector").value

        self.tf_buffer = Buffer()
        self.tf_listener = TransformListener(self.tf_buffer, self)
        topic = self.declare_parameter("pose_topic", "/end_effector_pose").value
        self.pose_pub = self.create_publisher(PoseStamped, topic, 10)
        self.timer = self.create_timer(1.0 / rate, self.query_transforms)
        self.get_logger().info("Transform listener started")

    def query_transforms(self) -> None:
        """Publish the newest pose of the end effector.

        It does not wait for one: the next query comes soon, and a callback that waits keeps others waiting.
        """
        try:
            transform = self.tf_buffer.lookup_transform(self.target_frame, self.source_frame, Time())
        except TransformException as e:
            self.get_logger().warning(f"Transform lookup failed: {e}", throttle_duration_sec=2.0)
            return

        pose = PoseStamped()
        # The stamp says when the arm was there, which is not now.
        pose.header = transform.header
        pose.pose.position.x = transform.transform.translation.x
        pose.pose.position.y = transform.transform.translation.y
        pose.pose.position.z = transform.transform.translation.z
        pose.pose.orientation = transform.transform.rotation
        self.pose_pub.publish(pose)

        position = pose.pose.position
        self.get_logger().info(
            f"EE position: [{position.x:.3f}, {position.y:.3f}, {position.z:.3f}]", throttle_duration_sec=1.0
        )

    def transform_point(self, point: Sequence[float], from_frame: str, to_frame: str) -> list[float] | None:
        """Transform a point between frames, with the newest transform.

        Args:
            point: [x, y, z] in from_frame.
            from_frame: Source frame.
            to_frame: Target frame.

        Returns:
            Transformed [x, y, z], or None if the transform is not known within 0.1 s.
        """
        pt = PointStamped()
        pt.header.frame_id = from_frame
        pt.point.x, pt.point.y, pt.point.z = (float(value) for value in point)
        try:
            transform = self.tf_buffer.lookup_transform(to_frame, from_frame, Time(), timeout=Duration(seconds=0.1))
        except TransformException as e:
            self.get_logger().error(f"Point transform failed: {e}")
            return None
        moved = do_transform_point(pt, transform).point
        return [moved.x, moved.y, moved.z]


def main(args: list[str] | None = None) -> None:
    """Run the node until it is stopped."""
    node = None
    try:
        rclpy.init(args=args)
        node = TransformListenerNode()
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    except (RuntimeError, NameValidationException, ParameterException, ValueError) as error:
        sys.exit(f"tf_listener: {error}")
    finally:
        if node is not None:
            node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
