# SPDX-License-Identifier: Apache-2.0
"""Step 4: scans as clouds in base_link."""

import numpy as np
import rclpy
from rclpy.duration import Duration
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from rclpy.time import Time
from sensor_msgs.msg import LaserScan, PointCloud2
from sensor_msgs_py import point_cloud2
from std_msgs.msg import Header
from tf2_ros import Buffer, TransformException, TransformListener

TARGET = "base_link"


class SensorTransformNode(Node):
    def __init__(self):
        super().__init__("sensor_transform")
        self.buffer = Buffer()
        self.listener = TransformListener(self.buffer, self)
        self.publisher = self.create_publisher(PointCloud2, "/scan_base_frame", 10)
        self.create_subscription(LaserScan, "/scan", self.transform, 10)

    def transform(self, scan):
        header = scan.header
        stamp = Time.from_msg(header.stamp)
        try:
            transform = self.buffer.lookup_transform(TARGET, header.frame_id, stamp, timeout=Duration(seconds=0.2))
        except TransformException as error:
            self.get_logger().warning(str(error))
            return
        ranges = np.array(scan.ranges)
        angles = scan.angle_min + scan.angle_increment * np.arange(len(ranges))
        valid = np.isfinite(ranges) & (ranges >= scan.range_min) & (ranges <= scan.range_max)
        ranges, angles = ranges[valid], angles[valid]
        points = np.column_stack([ranges * np.cos(angles), ranges * np.sin(angles), np.zeros(len(ranges))])
        moved, q = transform.transform.translation, transform.transform.rotation
        x, y, z, w = q.x, q.y, q.z, q.w
        rotation = np.array(
            [
                [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
            ]
        )
        points = points @ rotation.T + [moved.x, moved.y, moved.z]
        self.publisher.publish(
            point_cloud2.create_cloud_xyz32(Header(stamp=header.stamp, frame_id=TARGET), points.astype(np.float32))
        )


def main():
    rclpy.init()
    node = SensorTransformNode()
    try:
        rclpy.spin(node, executor=MultiThreadedExecutor())
    except KeyboardInterrupt:
        pass


if __name__ == "__main__":
    main()
