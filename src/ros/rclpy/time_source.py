# SPDX-License-Identifier: Apache-2.0
"""Source of simulated time, which sets the clocks of a node from the topic /clock."""

# The modules of rclpy share attributes named `_Coframe__x`, the form of mangled names.
# ruff: noqa: SLF001

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

import rosgraph_msgs.msg
from rclpy import _absent
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.clock import ROSClock
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rclpy.time import Time

if TYPE_CHECKING:
    from rclpy.node import Node
    from rclpy.subscription import Subscription

CLOCK_TOPIC = "/clock"
USE_SIM_TIME_NAME = "use_sim_time"


class TimeSource:
    """Source of simulated time. While active, it sets the attached ROS clocks from /clock.

    It is active while the parameter `use_sim_time` of its node is true.

    Args:
        node: Node that subscribes to /clock. None: `attach_node` sets it.
    """

    def __init__(self, *, node: Node | None = None) -> None:
        self._node: Node | None = None
        self._clocks: list[ROSClock] = []
        self._subscription: Subscription | None = None
        self._last_time = Time()
        # A separate group, so that a busy callback of the node does not stop the clock for other threads.
        self._group = MutuallyExclusiveCallbackGroup()
        if node is not None:
            self.attach_node(node)

    @property
    def ros_time_is_active(self) -> bool:
        """Whether the clocks use the time of /clock."""
        return self._subscription is not None

    @ros_time_is_active.setter
    def ros_time_is_active(self, enabled: bool) -> None:
        if enabled == self.ros_time_is_active or self._node is None:
            return
        if enabled:
            qos = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
            self._subscription = self._node.create_subscription(
                rosgraph_msgs.msg.Clock, CLOCK_TOPIC, self.clock_callback, qos, callback_group=self._group
            )
        elif self._subscription is not None:
            self._node.destroy_subscription(self._subscription)
            self._subscription = None
        for clock in self._clocks:
            clock._set_ros_time_is_active(enabled)
        self._node.context._Coframe__wakeup.set()

    def attach_node(self, node: Node) -> None:
        """Follow the parameter `use_sim_time` of another node from now on, and subscribe to /clock with it."""
        self.detach_node()
        self._node = node
        node._Coframe__time_sources.append(self)
        if node.has_parameter(USE_SIM_TIME_NAME):
            self.ros_time_is_active = node.get_parameter(USE_SIM_TIME_NAME).value is True

    def detach_node(self) -> None:
        """Unsubscribe from /clock, and ignore the parameter."""
        self.ros_time_is_active = False
        if self._node is not None:
            self._node._Coframe__time_sources.remove(self)
            self._node = None

    def attach_clock(self, clock: Any) -> None:
        """Add a clock that this time source sets.

        Raises:
            ValueError: The clock is not a ROS clock.
        """
        if not isinstance(clock, ROSClock):
            raise ValueError("Only clocks with type ROS_TIME can be attached.")  # noqa: TRY004 - as upstream
        clock.set_ros_time_override(self._last_time)
        clock._set_ros_time_is_active(self.ros_time_is_active)
        self._clocks.append(clock)

    def clock_callback(self, msg: rosgraph_msgs.msg.Clock) -> None:
        """Set the attached clocks to the time of a message."""
        self._last_time = Time.from_msg(msg.clock)
        for clock in self._clocks:
            clock.set_ros_time_override(self._last_time)


__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports
