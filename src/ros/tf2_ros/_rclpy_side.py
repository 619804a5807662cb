# SPDX-License-Identifier: Apache-2.0
"""Functions that tf2_ros needs from the rclpy of this process (coframe's or a sourced ROS's) beyond its public API."""

from coframe.workspace.ros_side import tf2_is_replaced

# Two imports of the same names: a type checker compares the signatures of both sides.
if tf2_is_replaced():
    from tf2_ros._side_sourced import (
        IS_SOURCED,
        direct_sender,
        domain_and_middleware,
        on_cancel,
        profile,
        receiving_wire,
        refusal,
        reporter,
        static_publisher,
        to_wire,
        wait_for,
        wake_executors,
    )
else:
    from tf2_ros._side_coframe import (
        IS_SOURCED,
        direct_sender,
        domain_and_middleware,
        on_cancel,
        profile,
        receiving_wire,
        refusal,
        reporter,
        static_publisher,
        to_wire,
        wait_for,
        wake_executors,
    )

__all__ = [
    "IS_SOURCED",
    "direct_sender",
    "domain_and_middleware",
    "on_cancel",
    "profile",
    "receiving_wire",
    "refusal",
    "reporter",
    "static_publisher",
    "to_wire",
    "wait_for",
    "wake_executors",
]
