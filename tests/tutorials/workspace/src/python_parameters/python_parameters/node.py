# SPDX-License-Identifier: Apache-2.0
"""Greets a parameter, and sets it back to "world"."""

import rclpy
import rclpy.node
from rcl_interfaces.msg import ParameterDescriptor


class MinimalParam(rclpy.node.Node):
    def __init__(self):
        super().__init__("minimal_param_node")
        descriptor = ParameterDescriptor(description="This parameter is mine!")
        self.declare_parameter("my_parameter", "world", descriptor)
        self.timer = self.create_timer(0.1, self.timer_callback)

    def timer_callback(self):
        my_param = self.get_parameter("my_parameter").get_parameter_value().string_value
        self.get_logger().info("Hello %s!" % my_param)
        my_new_param = rclpy.parameter.Parameter("my_parameter", rclpy.Parameter.Type.STRING, "world")
        self.set_parameters([my_new_param])


def main():
    rclpy.init()
    try:
        rclpy.spin(MinimalParam())
    except KeyboardInterrupt:
        pass
    rclpy.try_shutdown()
