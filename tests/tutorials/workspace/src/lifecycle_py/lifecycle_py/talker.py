# SPDX-License-Identifier: Apache-2.0
"""A talker whose publisher is active only in the state active."""

import rclpy
from rclpy.lifecycle import Node, State, TransitionCallbackReturn
from std_msgs.msg import String


class LifecycleTalker(Node):
    def __init__(self, node_name, **kwargs):
        self._count = 0
        self._pub = None
        self._timer = None
        super().__init__(node_name, **kwargs)

    def publish(self):
        msg = String()
        msg.data = "Lifecycle HelloWorld #" + str(self._count)
        self._count += 1
        if self._pub is not None:
            self._pub.publish(msg)

    def on_configure(self, state: State) -> TransitionCallbackReturn:
        self._pub = self.create_lifecycle_publisher(String, "lifecycle_chatter", 10)
        self._timer = self.create_timer(0.05, self.publish)
        return TransitionCallbackReturn.SUCCESS

    def on_cleanup(self, state: State) -> TransitionCallbackReturn:
        self.destroy_timer(self._timer)
        self.destroy_publisher(self._pub)
        return TransitionCallbackReturn.SUCCESS


def main():
    rclpy.init()
    node = LifecycleTalker("lc_talker")
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    node.destroy_node()
    rclpy.try_shutdown()
