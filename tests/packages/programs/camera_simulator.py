# SPDX-License-Identifier: Apache-2.0
"""A stereo camera with depth: a red square moves in front of it."""

import numpy as np

import rclpy
from cv_bridge import CvBridge
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import CameraInfo, Image


class CameraSimulator(Node):
    def __init__(self):
        super().__init__("camera_simulator")
        self.bridge = CvBridge()
        self.declare_parameter("distance", 2.0)
        self.images = {
            name: self.create_publisher(Image, f"{name}/image_raw", qos_profile_sensor_data)
            for name in ("left", "right", "depth")
        }
        self.infos = {
            name: self.create_publisher(CameraInfo, f"{name}/camera_info", qos_profile_sensor_data)
            for name in ("left", "right")
        }
        self.count = 0
        self.create_timer(0.05, self.publish)

    def publish(self):
        distance = self.get_parameter("distance").value
        stamp = self.get_clock().now().to_msg()
        column = 100 + self.count % 40
        self.count += 1
        for name, offset in (("left", 0), ("right", round(200 * 0.1 / distance))):
            image = np.full((120, 160, 3), 30, np.uint8)
            image[50:70, column - offset : column - offset + 20] = (0, 0, 255)
            message = self.bridge.cv2_to_imgmsg(image, encoding="bgr8")
            message.header.stamp, message.header.frame_id = stamp, "camera_optical_frame"
            self.images[name].publish(message)
            info = CameraInfo(header=message.header, width=160, height=120, distortion_model="plumb_bob")
            info.k = [200.0, 0.0, 80.0, 0.0, 200.0, 60.0, 0.0, 0.0, 1.0]
            info.r = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]
            info.p = [200.0, 0.0, 80.0, -20.0 if name == "right" else 0.0, 0.0, 200.0, 60.0, 0.0, 0.0, 0.0, 1.0, 0.0]
            self.infos[name].publish(info)
        depth = self.bridge.cv2_to_imgmsg(np.full((120, 160), round(distance * 1000), np.uint16), "16UC1")
        depth.header = message.header
        self.images["depth"].publish(depth)


def main():
    rclpy.init()
    node = CameraSimulator()
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, rclpy.executors.ExternalShutdownException):
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
