# SPDX-License-Identifier: Apache-2.0
"""A node that looks up transforms with coframe's tf2 on the rclpy of a sourced ROS, and checks what it gets.

    listener.py WIRE [ROS ARGUMENTS]

If the environment variable TF2 is ``coframe.ros2``, it imports tf2 from there. Otherwise it imports tf2_ros, and must
be run by ``python -m coframe.ros2``.
"""

# ruff: noqa: E402 - The module that provides tf2 is imported first.

import contextlib
import os
import sys
from importlib import import_module

import rclpy
from rclpy.duration import Duration
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.time import Time

tf2 = import_module(os.environ.get("TF2", "tf2_ros"))

import tf2_geometry_msgs
import tf2_py
import tf2_ros
from coframe.workspace import ros_folders
from geometry_msgs.msg import PointStamped

ours = str(ros_folders.ros_folder())
assert not rclpy.__file__.startswith(ours), rclpy.__file__
assert not tf2_geometry_msgs.__file__.startswith(ours), tf2_geometry_msgs.__file__
assert tf2_ros.__file__.startswith(ours), tf2_ros.__file__
assert tf2.Buffer is tf2_ros.Buffer

rclpy.init(args=sys.argv)
node = Node("listener")
executor = SingleThreadedExecutor()
executor.add_node(node)
buffer = tf2.Buffer(node=node)
listener = tf2.TransformListener(buffer, node)
with contextlib.suppress(tf2_py.LookupException):
    buffer.lookup_transform("odom", "nowhere", Time())
    sys.exit("the lookup of an unknown frame succeeded")


def wait_for(frame, time):
    """Wait in a coroutine of the executor, which has nothing else to do."""

    async def wait():
        return await buffer.wait_for_transform_async("odom", frame, time)

    task = executor.create_task(wait())
    executor.spin_until_future_complete(task, timeout_sec=20)
    return task.result()


result = wait_for("lidar", Time())
assert result.transform.translation.x == 3.0, result
# coframe's classes are in geometry_msgs.msg.
assert type(result).__module__.startswith("geometry_msgs.msg._"), type(result).__module__

point = PointStamped()
point.header.frame_id = "lidar"
moved = buffer.transform(point, "odom")
assert moved.point.x == 3.0, moved
assert type(moved) is PointStamped
assert type(buffer.get_latest_common_time("odom", "base")) is Time

native = sys.argv[1] == "native"
shared = native and os.environ.get("COFRAME_SHARED") == "1"


def hidden():
    """Return whether there is a node of this listener's own."""
    return "_listener_coframe_tf" in [name for name, _ in node.get_node_names_and_namespaces()]


assert hidden() is (native and not shared)
assert buffer._Coframe__buffer._following is shared
# A change by the program ends the sharing, and the listener continues to receive.
result.child_frame_id = "own"
buffer.set_transform(result, "program")
assert not buffer._Coframe__buffer._following
assert buffer.can_transform("odom", "own", Time())
now = node.get_clock().now()
assert Time.from_msg(wait_for("base", now).header.stamp) == now
assert not native or hidden()
listener.unregister()
buffer.clear()
assert not buffer.can_transform("odom", "base", Time(), Duration(seconds=0.2))
print("passed", flush=True)
