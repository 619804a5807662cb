# SPDX-License-Identifier: Apache-2.0
"""The side of the matrix that provides everything, with the rclpy of coframe or of ROS 2. Runs until it is killed."""

import os

from contents import (
    BEST_EFFORT,
    LATCHED,
    LIFECYCLE_NODE,
    LOG_LINE,
    NODE,
    STATIC,
    TYPES,
    message_of,
    topic_of,
)

import rclpy
from example_interfaces.action import Fibonacci
from example_interfaces.srv import AddTwoInts
from geometry_msgs.msg import TransformStamped
from rclpy.action import ActionServer, CancelResponse
from rclpy.executors import MultiThreadedExecutor
from rclpy.lifecycle import LifecycleNode
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage


def add(request, response):
    """Answer a request."""
    response.sum = request.a + request.b
    return response


def count(goal):
    """Execute a goal: a number and feedback every 50 ms."""
    feedback = Fibonacci.Feedback(sequence=[0, 1])
    for _ in range(goal.request.order):
        if goal.is_cancel_requested:
            goal.canceled()
            return Fibonacci.Result(sequence=feedback.sequence)
        feedback.sequence.append(feedback.sequence[-1] + feedback.sequence[-2])
        goal.publish_feedback(feedback)
        rate.sleep()
    goal.succeed()
    return Fibonacci.Result(sequence=feedback.sequence)


rclpy.init()
node, lifecycle = Node(NODE), LifecycleNode(LIFECYCLE_NODE)
rate = node.create_rate(20)
latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
node.create_publisher(String, LATCHED, latched).publish(String(data="latched"))
static = TransformStamped(child_frame_id="camera")
static.header.frame_id = "base"
node.create_publisher(TFMessage, STATIC, latched).publish(TFMessage(transforms=[static]))
messages = [message_of(name) for name in TYPES]
publishers = [
    node.create_publisher(type(message), topic_of(name), 5) for message, name in zip(messages, TYPES, strict=True)
]
best_effort = node.create_publisher(String, BEST_EFFORT, QoSProfile(depth=5, reliability=ReliabilityPolicy.BEST_EFFORT))
node.declare_parameter("speed", 1.5)
node.create_service(AddTwoInts, "~/add", add)
server = ActionServer(node, Fibonacci, "~/count", count, cancel_callback=lambda _: CancelResponse.ACCEPT)


def publish():
    """Publish everything that is published periodically."""
    for publisher, message in zip(publishers, messages, strict=True):
        publisher.publish(message)
    best_effort.publish(String(data="best effort"))
    node.get_logger().info(LOG_LINE)


node.create_timer(0.5, publish)
executor = MultiThreadedExecutor(4)
executor.add_node(node)
executor.add_node(lifecycle)
print("ready", flush=True)
try:
    executor.spin()
finally:
    os._exit(0)  # Ending the middleware is not part of the test.
