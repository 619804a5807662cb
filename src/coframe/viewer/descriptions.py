"""Which robots there are: one of a file, and those that topics tell of."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from coframe.errors import DecodeError, RobotDescriptionError
from coframe.robots import parse_urdf
from coframe.viewer.robots import describe

if TYPE_CHECKING:
    from coframe.robots import Robot
    from coframe.viewer.messages import Messages
    from coframe.viewer.meshes import MeshTable
    from coframe.viewer.sources import Source

__all__ = ["ROBOT_DESCRIPTION", "Descriptions"]

ROBOT_DESCRIPTION = "/robot_description"
_LARGEST = 16 << 20


class Descriptions:
    """The robots, as they become known; used by one thread.

    Args:
        robot: One that is there from the start.
        topics: Where descriptions are told, as std_msgs/msg/String.
        meshes: Where their meshes are.
    """

    def __init__(self, robot: Robot | None, topics: list[str], meshes: MeshTable) -> None:
        self.robots: dict[int, Robot] = {}
        self.told: dict[int, dict[str, Any]] = {}
        self.problems: dict[str, tuple[str, str]] = {}
        self._meshes = meshes
        self._watched: dict[str, Messages | None] = dict.fromkeys(topics)
        self._seen: dict[str, int] = {}
        self._numbers = {topic: number for number, topic in enumerate(topics, 1)}
        if robot is not None:
            self._note(robot, 0, str(robot.path or "a file"), None)

    def refresh(self, source: Source, at: int = 0) -> None:
        """Takes in what topics tell by now."""
        for topic, watched in list(self._watched.items()):
            messages = watched
            if messages is None:
                messages = self._watched[topic] = source.open(topic)
            sighting = None if messages is None else messages.at(at)
            if sighting is None or self._seen.get(topic) == sighting.key:
                continue
            self._seen[topic] = sighting.key
            self.problems.pop(topic, None)
            try:
                text = sighting.message().data
                if not text.strip():  # robot_state_publisher's successors send an empty one first
                    continue
                if len(text) > _LARGEST:
                    raise RobotDescriptionError(f"it has more than {_LARGEST >> 20} MiB")
                self._note(parse_urdf(text), self._numbers[topic], topic, topic)
            except (RobotDescriptionError, DecodeError) as error:
                self.problems[topic] = (f"{topic} tells of no robot: {error}", error.hint)

    def close(self) -> None:
        """Leaves the topics."""
        for messages in self._watched.values():
            if messages is not None:
                messages.close()

    def _note(self, robot: Robot, number: int, source: str, topic: str | None) -> None:
        self.robots[number] = robot
        self.told[number] = describe(robot, number, source, topic, self._meshes)
