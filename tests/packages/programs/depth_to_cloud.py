# SPDX-License-Identifier: Apache-2.0
"""Combines color and depth to a colored cloud."""

import numpy as np

import message_filters
import rclpy
import ros2_numpy as rnp
from cv_bridge import CvBridge
from image_geometry import PinholeCameraModel
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import CameraInfo, Image, PointCloud2


class DepthToCloud(Node):
    def __init__(self):
        super().__init__("depth_to_cloud")
        self.bridge = CvBridge()
        self.pub = self.create_publisher(PointCloud2, "points", 10)
        subs = [
            message_filters.Subscriber(self, kind, topic, qos_profile=qos_profile_sensor_data)
            for kind, topic in (
                (Image, "left/image_raw"),
                (Image, "depth/image_raw"),
                (CameraInfo, "left/camera_info"),
            )
        ]
        self.sync = message_filters.ApproximateTimeSynchronizer(subs, queue_size=10, slop=0.02)
        self.sync.registerCallback(self.on_images)

    def on_images(self, color, depth, info):
        model = PinholeCameraModel()
        model.fromCameraInfo(info)
        rgb = self.bridge.imgmsg_to_cv2(color, "rgb8")
        z = self.bridge.imgmsg_to_cv2(depth, desired_encoding="passthrough").astype(np.float32) / 1000.0
        v, u = np.indices(z.shape)
        points = np.zeros(z.shape, [(n, np.float32) for n in "xyz"] + [(n, np.uint8) for n in "rgb"])
        points["x"] = (u - model.cx()) * z / model.fx()
        points["y"] = (v - model.cy()) * z / model.fy()
        points["z"] = z
        for i, name in enumerate("rgb"):
            points[name] = rgb[..., i]
        cloud = rnp.point_cloud2.merge_rgb_fields(points)
        msg = rnp.msgify(PointCloud2, cloud)
        msg.header = color.header
        self.pub.publish(msg)


def main(args=None):
    rclpy.init(args=args)
    node = DepthToCloud()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        node.get_logger().info("stopped")
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
