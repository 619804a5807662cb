#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Transform laser scans into the base frame and publish them as point clouds.

A scan usually arrives before the transforms with its stamp. Therefore, each scan waits for its own transform until a
deadline. A scan that waits does not delay the scans after it.

Try it:
    sensor_transform --ros-args -p target_frame:=odom

Parameters:
    target_frame: the frame of the clouds
    wait: the maximum time that a scan waits for its transform, in seconds
    queue_size: the maximum number of waiting scans
    scan_topic, cloud_topic: the topics of the scans and of the clouds
"""

import sys
from array import array
from collections import deque
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

import rclpy
from geometry_msgs.msg import TransformStamped
from rcl_interfaces.msg import SetParametersResult
from rclpy.duration import Duration
from rclpy.exceptions import NameValidationException, ParameterException
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rclpy.time import Time
from sensor_msgs.msg import LaserScan, PointCloud2, PointField
from std_msgs.msg import Header
from tf2_ros import Buffer, TransformException, TransformListener

Array = NDArray[np.float64]

# Seconds between two attempts to transform the waiting scans. This is well below the period of the transforms.
RETRY_PERIOD = 0.005


class WaitingScan(NamedTuple):
    """A scan whose transform is not available yet."""

    scan: LaserScan
    deadline: Time


class SensorTransformNode(Node):
    """A node that transforms scans to the target frame."""

    def __init__(self) -> None:
        super().__init__("sensor_transform")
        self.target_frame = self.declare_parameter("target_frame", "base_link").value
        self.wait = Duration(seconds=self.declare_parameter("wait", 0.2).value)
        self.queue_size = max(1, self.declare_parameter("queue_size", 50).value)

        self.tf_buffer = Buffer()
        self.tf_listener = TransformListener(self.tf_buffer, self)

        self.waiting: deque[WaitingScan] = deque()
        self.received = 0
        self.dropped = 0
        # The timer runs only while scans wait.
        self.retry_timer = self.create_timer(RETRY_PERIOD, self.process_waiting)
        self.retry_timer.cancel()

        # Many lidar drivers publish with best-effort reliability, which a reliable subscription does not match.
        qos = QoSProfile(depth=10, reliability=ReliabilityPolicy.BEST_EFFORT)
        scan_topic = self.declare_parameter("scan_topic", "/scan").value
        self.scan_sub = self.create_subscription(LaserScan, scan_topic, self.scan_callback, qos)
        cloud_topic = self.declare_parameter("cloud_topic", "/scan_base_frame").value
        self.points_pub = self.create_publisher(PointCloud2, cloud_topic, 10)
        self.add_on_set_parameters_callback(self.reject_change)
        self.get_logger().info("Sensor transform node started")

    def reject_change(self, parameters: list[Any]) -> SetParametersResult:
        """Reject parameter changes, because the node reads its parameters only at startup."""
        for parameter in parameters:
            if parameter.name != "use_sim_time":
                reason = f"'{parameter.name}' is read when the node starts: restart the node to change it"
                return SetParametersResult(successful=False, reason=reason)
        return SetParametersResult(successful=True)

    def scan_callback(self, msg: LaserScan) -> None:
        """Add a scan to the queue, then process the queue."""
        self.received += 1
        if len(self.waiting) == self.queue_size:
            self.drop(f"more than {self.queue_size} scans are waiting for their transforms")
            self.waiting.popleft()
        self.waiting.append(WaitingScan(msg, self.get_clock().now() + self.wait))
        self.process_waiting()

    def process_waiting(self) -> None:
        """Publish the scans whose transform is available, and drop scans that have waited too long."""
        now = self.get_clock().now()
        still_waiting: deque[WaitingScan] = deque()
        for waiting in self.waiting:
            header = waiting.scan.header
            try:
                transform = self.tf_buffer.lookup_transform(
                    self.target_frame, header.frame_id, Time.from_msg(header.stamp)
                )
            except TransformException as e:
                if now < waiting.deadline:
                    still_waiting.append(waiting)
                else:
                    self.drop(str(e))
                continue
            self.points_pub.publish(self.make_cloud(waiting.scan, transform))
        self.waiting = still_waiting
        if still_waiting:
            self.retry_timer.reset()
        else:
            self.retry_timer.cancel()

    def drop(self, reason: str) -> None:
        """Count a dropped scan and log the reason, at most every two seconds."""
        self.dropped += 1
        self.get_logger().warning(
            f"Scan transform failed: {reason} (dropped {self.dropped} of {self.received} scans so far)",
            throttle_duration_sec=2.0,
        )

    def make_cloud(self, scan: LaserScan, transform: TransformStamped) -> PointCloud2:
        """Convert a scan to a point cloud in the target frame, with the stamp of the scan."""
        ranges = np.asarray(scan.ranges, dtype=np.float64)
        # A beam without an echo is infinite, NaN or out of range. Comparisons with NaN are false.
        valid = np.isfinite(ranges) & (ranges >= scan.range_min) & (ranges <= scan.range_max)
        angles = scan.angle_min + scan.angle_increment * np.arange(len(ranges))
        points_sensor = np.zeros((np.count_nonzero(valid), 3))
        points_sensor[:, 0] = ranges[valid] * np.cos(angles[valid])
        points_sensor[:, 1] = ranges[valid] * np.sin(angles[valid])

        names = ["x", "y", "z"]
        columns = [self.transform_points(points_sensor, transform)]
        if len(scan.intensities) == len(ranges):
            names.append("intensity")
            columns.append(np.asarray(scan.intensities, dtype=np.float64)[valid, np.newaxis])
        header = Header(stamp=scan.header.stamp, frame_id=self.target_frame)
        return self.float32_cloud(header, names, np.hstack(columns))

    @staticmethod
    def float32_cloud(header: Header, names: list[str], values: NDArray[Any]) -> PointCloud2:
        """Create a cloud with float32 fields from an array with one column for each field."""
        cloud = PointCloud2()
        cloud.header = header
        cloud.height = 1
        cloud.width = len(values)
        cloud.fields = [
            PointField(name=name, offset=4 * number, datatype=PointField.FLOAT32, count=1)
            for number, name in enumerate(names)
        ]
        cloud.is_bigendian = False
        cloud.point_step = 4 * len(names)
        cloud.row_step = cloud.point_step * cloud.width
        cloud.is_dense = True
        cloud.data = array("B", values.astype("<f4").tobytes())
        return cloud

    def transform_points(self, points: Array, transform: TransformStamped) -> Array:
        """Transform an array of points.

        Args:
            points: The points, (N, 3).
            transform: The transform to apply.

        Returns:
            The transformed points, (N, 3).
        """
        translation = transform.transform.translation
        q = transform.transform.rotation
        t = np.array([translation.x, translation.y, translation.z])
        rotation = self.quaternion_to_matrix(np.array([q.w, q.x, q.y, q.z]))
        # p' = R @ p + t. The points are rows, so the product is transposed.
        return np.asarray(points @ rotation.T + t)

    @staticmethod
    def quaternion_to_matrix(q: Array) -> Array:
        """Convert a quaternion [w, x, y, z] to a rotation matrix."""
        w, x, y, z = q / np.linalg.norm(q)
        return np.array(
            [
                [1 - 2 * y**2 - 2 * z**2, 2 * x * y - 2 * w * z, 2 * x * z + 2 * w * y],
                [2 * x * y + 2 * w * z, 1 - 2 * x**2 - 2 * z**2, 2 * y * z - 2 * w * x],
                [2 * x * z - 2 * w * y, 2 * y * z + 2 * w * x, 1 - 2 * x**2 - 2 * y**2],
            ]
        )


def main(args: list[str] | None = None) -> None:
    """Run the node until it is interrupted."""
    node = None
    try:
        rclpy.init(args=args)
        node = SensorTransformNode()
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    except (RuntimeError, NameValidationException, ParameterException, ValueError) as error:
        sys.exit(f"sensor_transform: {error}")
    finally:
        if node is not None:
            node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
