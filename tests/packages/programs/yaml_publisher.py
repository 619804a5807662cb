# SPDX-License-Identifier: Apache-2.0
"""Publishes a message that is given as YAML, like `ros2 topic pub`."""

import sys

import yaml

import rclpy
from rosidl_runtime_py import set_message_fields
from rosidl_runtime_py.utilities import get_message

topic, type_name, values = sys.argv[1:4]
rclpy.init()
node = rclpy.create_node("yaml_publisher")
message = get_message(type_name)()
stamps = set_message_fields(message, yaml.safe_load(values), expand_header_auto=True, expand_time_now=True)
publisher = node.create_publisher(type(message), topic, 10)


def publish():
    for set_stamp in stamps:
        set_stamp(node.get_clock().now().to_msg())
    publisher.publish(message)


node.create_timer(0.1, publish)
try:
    rclpy.spin(node)
except KeyboardInterrupt:
    pass
rclpy.try_shutdown()
