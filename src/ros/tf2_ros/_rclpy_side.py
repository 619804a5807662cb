# SPDX-License-Identifier: Apache-2.0
"""What tf2_ros needs from rclpy beyond its public API, for the rclpy of this process: coframe's or a sourced ROS's."""

from coframe.ros_side import tf2_is_replaced

# Two imports of the same names: a type checker compares the signatures of both sides.
if tf2_is_replaced():
    from tf2_ros._side_sourced import (
        direct_sender,
        on_cancel,
        open_subscriptions,
        profile,
        refusal,
        static_publisher,
        wait_for,
        wake_executors,
    )
else:
    from tf2_ros._side_coframe import (
        direct_sender,
        on_cancel,
        open_subscriptions,
        profile,
        refusal,
        static_publisher,
        wait_for,
        wake_executors,
    )

__all__ = [
    "direct_sender",
    "on_cancel",
    "open_subscriptions",
    "profile",
    "refusal",
    "static_publisher",
    "wait_for",
    "wake_executors",
]
