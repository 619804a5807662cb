"""Joint states that a tab's sliders send to the ROS graph, as joint_state_publisher_gui does."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Mapping

    from coframe.connection import Connection
    from coframe.robots import Robot

__all__ = ["JOINT_STATES", "PERIOD", "JointPublisher"]

JOINT_STATES = "/joint_states"
# Programs that turn joint states into transforms want them again and again, in seconds.
PERIOD = 0.1


class JointPublisher:
    """Sends the last positions of one robot again and again.

    Args:
        connection: Where to.
        robot: Whose joints they are.
        topic: Where they are told.
    """

    def __init__(self, connection: Connection, robot: Robot, topic: str = JOINT_STATES) -> None:
        from coframe.messages import find  # noqa: PLC0415 - only who publishes needs them

        self._class = find("sensor_msgs/msg/JointState")
        self._publisher = connection.publisher(topic, self._class)
        self._robot = robot
        self._names: list[str] = []
        self._positions: list[float] = []
        self._due = 0.0

    def set(self, positions: Mapping[str, Any]) -> None:
        """From now on sends these; joints that follow others and those that are left out among them.

        Raises:
            ValueError: There is no such joint, or a position is no finite number.
        """
        full, _ = self._robot.positions(positions)
        single = {name: float(value) for name, value in full.items() if value.ndim == 0}
        self._names, self._positions = list(single), list(single.values())
        self._due = 0.0

    def send_if_due(self) -> None:
        """Sends them, where the last time is long enough ago."""
        now = time.monotonic()
        if now < self._due:
            return
        self._due = now + PERIOD
        message = self._class(name=self._names, position=self._positions)
        message.header.stamp.sec, message.header.stamp.nanosec = divmod(time.time_ns(), 1_000_000_000)
        self._publisher.publish(message)

    def close(self) -> None:
        """Leaves the topic."""
        self._publisher.close()
