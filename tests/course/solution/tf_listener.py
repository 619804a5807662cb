# SPDX-License-Identifier: Apache-2.0
"""Step 3: the pose of the end effector."""

import rclpy
from geometry_msgs.msg import PoseStamped
from rclpy.node import Node
from rclpy.time import Time
from tf2_ros import Buffer, TransformException, TransformListener


class TransformListenerNode(Node):
    def __init__(self):
        super().__init__("tf_listener")
        self.buffer = Buffer()
        self.listener = TransformListener(self.buffer, self)
        self.publisher = self.create_publisher(PoseStamped, "/end_effector_pose", 10)
        self.create_timer(0.1, self.publish_pose)

    def publish_pose(self):
        try:
            transform = self.buffer.lookup_transform("base_link", "end_effector", Time())
        except TransformException as error:
            self.get_logger().warning(str(error), throttle_duration_sec=2.0)
            return
        pose = PoseStamped(header=transform.header)
        pose.pose.position.x = transform.transform.translation.x
        pose.pose.position.y = transform.transform.translation.y
        pose.pose.position.z = transform.transform.translation.z
        pose.pose.orientation = transform.transform.rotation
        self.publisher.publish(pose)


def main():
    rclpy.init()
    node = TransformListenerNode()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass


if __name__ == "__main__":
    main()
