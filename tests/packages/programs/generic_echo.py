# SPDX-License-Identifier: Apache-2.0
"""Prints the first message of any topic as YAML or CSV."""

import argparse

import rclpy
from rclpy.node import Node
from rosidl_runtime_py import message_to_csv, message_to_ordereddict, message_to_yaml
from rosidl_runtime_py.utilities import get_message

parser = argparse.ArgumentParser()
parser.add_argument("topic")
parser.add_argument("--csv", action="store_true")
parser.add_argument("--truncate-length", type=int, default=128)
options = parser.parse_args()


class Echo(Node):
    def __init__(self):
        super().__init__("generic_echo")
        self.subscription = None
        self.done = False
        self.create_timer(0.1, self.look)

    def look(self):
        types = dict(self.get_topic_names_and_types()).get(options.topic)
        if types and self.subscription is None:
            self.subscription = self.create_subscription(get_message(types[0]), options.topic, self.show, 10)

    def show(self, msg):
        if self.done:
            return
        if options.csv:
            print(message_to_csv(msg, truncate_length=options.truncate_length))
        else:
            print(message_to_yaml(msg, truncate_length=options.truncate_length, no_arr=True))
            print("keys", *message_to_ordereddict(msg))
        self.done = True


rclpy.init()
node = Echo()
while not node.done:
    rclpy.spin_once(node)
rclpy.shutdown()
