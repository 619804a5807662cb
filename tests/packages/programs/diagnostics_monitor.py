# SPDX-License-Identifier: Apache-2.0
"""Prints the diagnostics that are not OK."""

import rclpy
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from rclpy.node import Node

LEVELS = {DiagnosticStatus.OK: "OK", DiagnosticStatus.WARN: "WARN", DiagnosticStatus.ERROR: "ERROR"}


class Monitor(Node):
    def __init__(self):
        super().__init__("monitor")
        self.create_subscription(DiagnosticArray, "/diagnostics", self.callback, 10)
        self.seen = {}

    def callback(self, msg):
        for status in msg.status:
            if status.message != "Node starting up":
                values = {pair.key: pair.value for pair in status.values}
                self.seen[status.name] = (LEVELS[status.level], status.message, status.hardware_id, values)


rclpy.init()
node = Monitor()
while len(node.seen) < 2 or node.seen["driver: /temperature topic status"][0] != "OK":
    rclpy.spin_once(node)
level, message, hardware, values = node.seen["driver: Temperature"]
print("diagnostics", level, message, hardware, values["temperature"])
print("rate", *node.seen["driver: /temperature topic status"][:2])
rclpy.shutdown()
