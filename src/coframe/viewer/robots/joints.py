# SPDX-License-Identifier: Apache-2.0
"""Publish the joint positions set by a page's sliders, like joint_state_publisher_gui."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

from coframe.time import SECOND

if TYPE_CHECKING:
    from collections.abc import Mapping

    from coframe.connection.connection import Connection
    from coframe.robots import Robot

__all__ = ["JOINT_STATES", "PERIOD", "JointPublisher"]

JOINT_STATES = "/joint_states"
PERIOD = 0.1
"""Seconds between messages: robot_state_publisher needs joint states repeatedly."""


class JointPublisher:
    """A publisher that repeats the last positions of one robot's joints.

    Args:
        connection: The connection on which the positions are published.
        robot: The robot whose joints are published.
        topic: The topic to publish on.
    """

    def __init__(self, connection: Connection, robot: Robot, topic: str = JOINT_STATES) -> None:
        # Imported here because only publishing needs the message classes.
        from coframe.messages import find  # noqa: PLC0415

        self._class = find("sensor_msgs/msg/JointState")
        self._publisher = connection.publisher(topic, self._class)
        self._robot = robot
        self._names: list[str] = []
        self._positions: list[float] = []
        self._due = 0.0

    def set(self, positions: Mapping[str, float]) -> None:
        """Set the published positions in radians or meters; mimic joints and omitted joints are added.

        Raises:
            ValueError: A joint does not exist, or a position is not a finite number.
        """
        full, _ = self._robot.positions(positions)
        single = {name: float(value) for name, value in full.items() if value.ndim == 0}
        self._names, self._positions = list(single), list(single.values())
        self._due = 0.0

    def publish_if_due(self) -> None:
        """Publish the positions if the last message was published long enough ago."""
        now = time.monotonic()
        if now < self._due:
            return
        self._due = now + PERIOD
        message = self._class(name=self._names, position=self._positions)
        message.header.stamp.sec, message.header.stamp.nanosec = divmod(time.time_ns(), SECOND)
        self._publisher.publish(message)

    def close(self) -> None:
        """Remove the publisher."""
        self._publisher.close()
