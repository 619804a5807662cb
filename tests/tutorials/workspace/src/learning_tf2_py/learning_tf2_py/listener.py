# SPDX-License-Identifier: Apache-2.0
"""Spawns a second turtle, which follows the first one by its transform."""

import math

import rclpy
from geometry_msgs.msg import Twist
from rclpy.node import Node
from tf2_ros import TransformException
from tf2_ros.buffer import Buffer
from tf2_ros.transform_listener import TransformListener
from turtlesim.srv import Spawn


class FrameListener(Node):
    def __init__(self):
        super().__init__("turtle_tf2_frame_listener")
        self.target_frame = self.declare_parameter("target_frame", "turtle1").get_parameter_value().string_value
        self.tf_buffer = Buffer()
        self.tf_listener = TransformListener(self.tf_buffer, self)
        self.spawner = self.create_client(Spawn, "spawn")
        self.turtle_spawning_service_ready = False
        self.turtle_spawned = False
        self.publisher = self.create_publisher(Twist, "turtle2/cmd_vel", 1)
        self.timer = self.create_timer(0.1, self.on_timer)

    def on_timer(self):
        if not self.turtle_spawning_service_ready:
            if self.spawner.service_is_ready():
                request = Spawn.Request()
                request.name = "turtle2"
                request.x, request.y, request.theta = 4.0, 2.0, 0.0
                self.result = self.spawner.call_async(request)
                self.turtle_spawning_service_ready = True
            return
        if not self.turtle_spawned:
            if self.result.done():
                self.get_logger().info(f"Successfully spawned {self.result.result().name}")
                self.turtle_spawned = True
            return
        try:
            t = self.tf_buffer.lookup_transform("turtle2", self.target_frame, rclpy.time.Time())
        except TransformException as ex:
            self.get_logger().info(f"Could not transform: {ex}")
            return
        msg = Twist()
        msg.angular.z = math.atan2(t.transform.translation.y, t.transform.translation.x)
        msg.linear.x = 0.5 * math.hypot(t.transform.translation.x, t.transform.translation.y)
        self.publisher.publish(msg)


def main():
    rclpy.init()
    try:
        rclpy.spin(FrameListener())
    except KeyboardInterrupt:
        pass
    rclpy.try_shutdown()
