# SPDX-License-Identifier: Apache-2.0
"""Looks up odometry at the times of other messages."""

import message_filters
import rclpy
from nav_msgs.msg import Odometry
from rclpy.clock import ClockType
from rclpy.duration import Duration
from rclpy.time import Time
from sensor_msgs.msg import Imu

rclpy.init()
node = rclpy.create_node("odometry_cache")
cache = message_filters.Cache(message_filters.Subscriber(node, Odometry, "odom", qos_profile=10), 50)
results = []


def on_imu(imu):
    stamp = Time.from_msg(imu.header.stamp, clock_type=ClockType.ROS_TIME)
    before, after = cache.getElemBeforeTime(stamp), cache.getElemAfterTime(stamp)
    recent = cache.getInterval(stamp - Duration(seconds=1.0), stamp)
    if before is not None and after is not None and len(recent) > 3:
        results.append(before.header.stamp == imu.header.stamp == after.header.stamp)


node.create_subscription(Imu, "imu", on_imu, 10)
while not results:
    rclpy.spin_once(node)
print("cache", results[0], cache.getLast().child_frame_id)
rclpy.shutdown()
