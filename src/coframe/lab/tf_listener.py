#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Listen to transforms and publish the pose of the end effector.

Try it:
    tf_listener --ros-args -p source_frame:=camera_link

Parameters:
    rate: the rate of the poses, in Hz
    target_frame: the frame that the pose is relative to
    source_frame: the frame whose pose is published
    pose_topic: the topic of the pose
"""

import sys
from collections.abc import Sequence
from typing import Any

import rclpy
from geometry_msgs.msg import PointStamped, PoseStamped
from rcl_interfaces.msg import SetParametersResult
from rclpy.duration import Duration
from rclpy.exceptions import NameValidationException, ParameterException
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.time import Time
from tf2_geometry_msgs import do_transform_point
from tf2_ros import Buffer, TransformException, TransformListener


class TransformListenerNode(Node):
    """A node that looks up transforms and publishes poses."""

    def __init__(self) -> None:
        super().__init__("tf_listener")
        rate = self.declare_parameter("rate", 10.0).value
        if not rate > 0.0:
            raise ValueError(f"parameter 'rate' must be greater than 0 Hz, but is {rate}")
        self.target_frame = self.declare_parameter("target_frame", "base_link").value
        self.source_frame = self.declare_parameter("source_frame", "end_effector").value

        self.tf_buffer = Buffer()
        self.tf_listener = TransformListener(self.tf_buffer, self)
        topic = self.declare_parameter("pose_topic", "/end_effector_pose").value
        self.pose_pub = self.create_publisher(PoseStamped, topic, 10)
        self.timer = self.create_timer(1.0 / rate, self.query_transforms)
        self.add_on_set_parameters_callback(self.change_parameters)
        self.get_logger().info("Transform listener started")

    def change_parameters(self, parameters: list[Any]) -> SetParametersResult:
        """Apply a new rate. Changes of other parameters are rejected, because the node reads them only at startup."""
        for parameter in parameters:
            if parameter.name == "rate" and not parameter.value > 0.0:
                return SetParametersResult(successful=False, reason="the rate must be greater than 0 Hz")
            if parameter.name not in {"rate", "use_sim_time"}:
                reason = f"'{parameter.name}' is read when the node starts: restart the node to change it"
                return SetParametersResult(successful=False, reason=reason)
        for parameter in parameters:
            if parameter.name == "rate":
                self.timer.timer_period_ns = int(1e9 / parameter.value)
        return SetParametersResult(successful=True)

    def query_transforms(self) -> None:
        """Publish the latest pose of the end effector.

        The lookup has no timeout, because a callback that waits blocks the other callbacks of the node. If it fails,
        the next timer callback tries again.
        """
        try:
            transform = self.tf_buffer.lookup_transform(self.target_frame, self.source_frame, Time())
        except TransformException as e:
            self.get_logger().warning(f"Transform lookup failed: {e}", throttle_duration_sec=2.0)
            return

        pose = PoseStamped()
        # The stamp of the transform is the time of the pose. The current time would be wrong.
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
        """Transform a point from one frame to another with the latest transform.

        Args:
            point: The point [x, y, z], expressed in `from_frame`.
            from_frame: The source frame.
            to_frame: The target frame.

        Returns:
            The point [x, y, z], expressed in `to_frame`, or None if the transform is not available within 0.1 s.
        """
        pt = PointStamped()
        pt.header.frame_id = from_frame
        pt.point.x, pt.point.y, pt.point.z = (float(value) for value in point)
        try:
            transform = self.tf_buffer.lookup_transform(to_frame, from_frame, Time(), timeout=Duration(seconds=0.1))
        except TransformException as e:
            self.get_logger().error(f"Point transform failed: {e}")
            return None
        result = do_transform_point(pt, transform).point
        return [result.x, result.y, result.z]


def main(args: list[str] | None = None) -> None:
    """Run the node until it is interrupted."""
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
