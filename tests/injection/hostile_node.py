# SPDX-License-Identifier: Apache-2.0
"""Publishes frames, node names, types, texts, parameters and log messages that are hostile, until its input ends."""

import itertools
import sys
import threading

from hostile_names import ESCAPE, NAMES, NEWLINE

import coframe
import rclpy
from coframe.wire import QoS
from geometry_msgs.msg import TransformStamped
from rcl_interfaces.msg import Log, ParameterDescriptor, SetParametersResult
from rclpy.action import ActionServer
from rclpy.executors import SingleThreadedExecutor
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import String
from std_srvs.srv import Trigger
from tf2_msgs.action import LookupTransform
from tf2_msgs.msg import TFMessage

PERIOD = 0.2  # seconds
MAX_NODE_NAME_LENGTH = 200


def main():
    rclpy.init()
    node = rclpy.create_node("talker")
    node.declare_parameter("evil", ESCAPE, ParameterDescriptor(description=ESCAPE, additional_constraints=ESCAPE))
    node.add_on_set_parameters_callback(lambda _: SetParametersResult(successful=False, reason=f"{ESCAPE}{NEWLINE}"))
    latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    tf, tf_static = node.create_publisher(TFMessage, "/tf", 10), node.create_publisher(TFMessage, "/tf_static", latched)
    text, log = node.create_publisher(String, "/text", 10), node.create_publisher(Log, "/rosout", 10)
    description = node.create_publisher(String, "/robot_description", latched)
    description.publish(String(data=f"<robot name='{ESCAPE}'>"))
    tf_static.publish(message([f"static {name}" for name in NAMES[:3]], node))
    node.create_service(Trigger, "/refuse", refuse)
    ActionServer(node, LookupTransform, "/act", execute)
    other = coframe.connect("hostile")
    for number, name in enumerate(NAMES):
        own = other.participant.add_node("/", name[:MAX_NODE_NAME_LENGTH])
        # DDS accepts any name of a type, but only letters and digits in the name of a topic.
        other.participant.raw_publisher(own, f"/strange{number}", f"std_msgs/msg/{name[:MAX_NODE_NAME_LENGTH]}", QoS())
    other.participant.raw_publisher(own, f"/{'m' * 240}", "std_msgs/msg/String", QoS())

    def publish():
        tf.publish(message(NAMES, node))
        for name in NAMES:
            log.publish(Log(level=40, name=name[:1000], msg=name, file=name[:1000], function=name[:1000]))

    texts = itertools.cycle(NAMES)
    node.create_timer(PERIOD, publish)
    # One by one: a slow reader receives the last ten messages, and of bursts always the same ones.
    node.create_timer(PERIOD / len(NAMES), lambda: text.publish(String(data=next(texts))))
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    threading.Thread(target=executor.spin, daemon=True).start()
    print("ready", flush=True)
    sys.stdin.read()
    executor.shutdown()
    other.close()
    rclpy.shutdown()


def refuse(_, response):
    response.message = f"{ESCAPE}{NEWLINE}"
    return response


def execute(goal):
    goal.abort()
    result = LookupTransform.Result()
    result.error.error_string = result.transform.child_frame_id = f"{ESCAPE}{NEWLINE}"
    return result


def message(names, node):
    transforms = []
    for name in names:
        transform = TransformStamped(child_frame_id=name)
        transform.header.frame_id = "map"
        transform.header.stamp = node.get_clock().now().to_msg()
        transforms.append(transform)
    return TFMessage(transforms=transforms)


if __name__ == "__main__":
    main()
